"""The page's memory does not grow in ten minutes at full speed in a real browser
(web/test/memory.mjs). Slow; an argument sets another number of minutes."""

import os
import shutil
import subprocess
import sys
import unittest

from program import HANG, SOURCE, made_of_the_web

LAB = os.path.join(SOURCE, "web", "lab.sh")
CHROMIUM = shutil.which("chromium")
MINUTES = int(sys.argv.pop()) if sys.argv[-1].isdigit() else 10


class Memory(unittest.TestCase):
    def test_it_does_not_grow(self):
        if not CHROMIUM:
            self.skipTest("this test needs chromium")
        page = made_of_the_web(type(self), LAB, "laboratory.html")
        done = subprocess.run(
            [
                "node",
                os.path.join(SOURCE, "web", "test", "memory.mjs"),
                page,
                CHROMIUM,
                str(MINUTES),
            ],
            capture_output=True,
            text=True,
            timeout=HANG,
        )
        print(done.stdout)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
