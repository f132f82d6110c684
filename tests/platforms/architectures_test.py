"""Other processors give bitwise identical trajectories: compiles the engine for aarch64 and s390x
(big-endian) with baseline vectors, runs it in an emulator, and compares the hashes with those of this
machine. A control with fused multiplications must differ, so the comparison can fail."""

import os
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "engine"))
from compilers_test import hashes

PROCESSORS = {"aarch64": ("aarch64-linux-gnu-g++", "qemu-aarch64-static"),
              "s390x": ("s390x-linux-gnu-g++", "qemu-s390x-static")}


class Architectures(unittest.TestCase):
    def test_all_give_the_same_hashes(self):
        def there(processor, contract):
            compiler, emulator = PROCESSORS[processor]
            return hashes(folder, compiler, "-O2", f"-ffp-contract={contract}", "-static",
                          emulator=[emulator])
        with tempfile.TemporaryDirectory() as folder:
            here = hashes(folder, "g++", "-O2").splitlines()
            self.assertEqual(len(set(here)), 9)
            for processor in PROCESSORS:
                with self.subTest(processor):
                    self.assertEqual(there(processor, "off").splitlines(), here)
            fused = there("aarch64", "fast").splitlines()
            self.assertEqual(len(fused), 9)
            self.assertNotEqual(fused, here)


if __name__ == "__main__":
    for tool in ["g++", *(tool for pair in PROCESSORS.values() for tool in pair)]:
        if not shutil.which(tool):
            print("skipped: this test needs", tool)
            sys.exit(77)
    unittest.main()
