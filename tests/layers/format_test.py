"""Every C++ file is formatted as .clang-format says, by the version of Debian 12. Others differ in details."""

import os
import re
import shutil
import subprocess
import unittest

SOURCE = os.environ.get("SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(
    os.path.abspath(__file__)))))
VERSION = "14"


def version():
    """Main version of clang-format, or None."""
    if not shutil.which("clang-format"):
        return None
    done = subprocess.run(["clang-format", "--version"], capture_output=True, text=True)
    return re.search(r"version (\d+)", done.stdout)[1]


def files():
    for top in ("src", "track", "bindings", "tests", "bench", "examples"):
        for folder, _, names in os.walk(os.path.join(SOURCE, top)):
            for name in names:
                if name.endswith((".hpp", ".cpp")):
                    yield os.path.join(folder, name)


class Format(unittest.TestCase):
    @unittest.skipUnless(version() == VERSION, f"clang-format {VERSION} is not installed")
    def test_every_file_is_formatted(self):
        names = sorted(files())
        self.assertTrue(names)
        done = subprocess.run(["clang-format", "--dry-run", "-Werror", *names],
                              capture_output=True, text=True)
        wrong = sorted({line.split(":")[0] for line in done.stderr.splitlines()
                        if "code should be clang-formatted" in line})
        self.assertEqual(done.returncode, 0,
                         "clang-format -i " + " ".join(os.path.relpath(f, SOURCE) for f in wrong))


if __name__ == "__main__":
    unittest.main()
