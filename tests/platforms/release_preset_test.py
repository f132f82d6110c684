"""The commands of the README for any Linux work literally in a new clone: `cmake --preset release`,
`cmake --build --preset release`, and then the program runs. Builds the whole program."""

import os
import subprocess
import tempfile
import unittest

SOURCE = os.environ.get("SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(
    os.path.abspath(__file__)))))
COMMANDS = "cmake --preset release && cmake --build --preset release"


class ReleasePreset(unittest.TestCase):
    def test_a_new_clone_builds_and_runs(self):
        with open(os.path.join(SOURCE, "README.md"), encoding="utf-8") as file:
            self.assertIn(f"`{COMMANDS}`", file.read())
        with tempfile.TemporaryDirectory() as folder:
            clone = os.path.join(folder, "swirl")
            subprocess.run(["git", "clone", "--quiet", SOURCE, clone], check=True)

            def output_of(command):
                done = subprocess.run(command, shell=True, cwd=clone, stdin=subprocess.DEVNULL,
                                      capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                return done.stdout
            output_of(COMMANDS)
            self.assertIn("48 discs counterrotate", output_of("build/release/swirl run --discs 48"))
            # The clone has the commit, and the build changes no tracked file.
            commit = output_of("git rev-parse --short=7 HEAD").strip()
            self.assertIn(commit, output_of("build/release/swirl --version"))
            self.assertEqual(output_of("git status --porcelain"), "")


if __name__ == "__main__":
    unittest.main()
