"""Every C++ file is formatted as .clang-format says."""

import os
import shutil
import subprocess
import unittest

SOURCE = os.environ.get("SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(
    os.path.abspath(__file__)))))


def files():
    for top in ("src", "bindings", "tests", "bench", "examples"):
        for folder, _, names in os.walk(os.path.join(SOURCE, top)):
            for name in names:
                if name.endswith((".hpp", ".cpp")):
                    yield os.path.join(folder, name)


class Format(unittest.TestCase):
    @unittest.skipUnless(shutil.which("clang-format"), "clang-format is not installed")
    def test_every_file_is_formatted(self):
        names = sorted(files())
        self.assertTrue(names)
        done = subprocess.run(["clang-format", "--dry-run", "-Werror", *names],
                              capture_output=True, text=True, timeout=160)
        wrong = sorted({line.split(":")[0] for line in done.stderr.splitlines()
                        if "code should be clang-formatted" in line})
        self.assertEqual(done.returncode, 0,
                         "clang-format -i " + " ".join(os.path.relpath(f, SOURCE) for f in wrong))


if __name__ == "__main__":
    unittest.main()
