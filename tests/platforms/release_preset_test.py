"""The commands of the README for any Linux work literally in a new clone: `cmake --preset release`,
`cmake --build --preset release`, and then the program runs. Builds the whole program."""

import os
import re
import subprocess
import tempfile
import unittest

SOURCE = os.environ.get(
    "SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
)
COMMANDS = "cmake --preset release && cmake --build --preset release"


class ReleasePreset(unittest.TestCase):
    def test_a_new_clone_builds_and_runs(self):
        with open(os.path.join(SOURCE, "README.md"), encoding="utf-8") as file:
            self.assertIn(f"`{COMMANDS}`", file.read())
        with tempfile.TemporaryDirectory() as folder:
            clone = os.path.join(folder, "swirl")
            subprocess.run(["git", "clone", "--quiet", SOURCE, clone], check=True)

            def output_of(command):
                done = subprocess.run(
                    command,
                    shell=True,
                    cwd=clone,
                    stdin=subprocess.DEVNULL,
                    capture_output=True,
                    text=True,
                )
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                return done.stdout

            output_of(COMMANDS)
            self.assertIn(
                "48 discs rotate against the swirl", output_of("build/release/swirl run --discs 48")
            )
            # The clone has the commit, and the build changes no tracked file.
            commit = output_of("git rev-parse --short=7 HEAD").strip()
            self.assertIn(commit, output_of("build/release/swirl --version"))
            self.assertEqual(output_of("git status --porcelain"), "")

    def test_a_build_for_one_machine_has_at_most_one_loop_of_wide_vectors(self):
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            flags = set(file.read().split())
        avx512 = {"avx512f", "avx512vl", "avx512dq", "avx512bw"} <= flags
        widest = ["avx512"] if avx512 else ["avx2"] if "avx2" in flags else []
        for only, widths in (("ON", widest), ("OFF", ["avx2", "avx512"])):
            with tempfile.TemporaryDirectory() as folder:
                for command in (
                    ["cmake", "--preset", "release", "-B", folder, f"-DSWIRL_ONLY_WIDEST={only}"],
                    ["ninja", "-C", folder, "-t", "commands", "swirl"],
                ):
                    done = subprocess.run(command, cwd=SOURCE, capture_output=True, text=True)
                    self.assertEqual(done.returncode, 0, done.stderr)
                for file in ("event_loop", "cluster_rotation"):
                    self.assertEqual(
                        sorted(set(re.findall(rf"{file}_(avx\d+)\.cpp\.o -c", done.stdout))),
                        sorted(widths),
                    )
                self.assertIn("event_loop_baseline.cpp.o -c", done.stdout)


if __name__ == "__main__":
    unittest.main()
