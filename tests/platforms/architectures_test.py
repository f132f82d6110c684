"""Other processors give bitwise identical trajectories and averages: compiles the engine and the
rotation rates for aarch64 (g++ and clang) and s390x (big-endian) with baseline vectors, runs them
in an emulator, and compares hashes and averages with those of this machine. A control with fused
multiplications must differ, so the comparison can fail."""

import os
import shutil
import sys
import tempfile
import unittest

sys.path.insert(
    0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "engine")
)
from compilers_test import AVERAGES, HASHES, hashes

# Compiler with the flags that choose its target, and emulator.
BUILDS = {
    "aarch64, g++": (["aarch64-linux-gnu-g++"], "qemu-aarch64-static"),
    "aarch64, clang": (["clang++-19", "--target=aarch64-linux-gnu"], "qemu-aarch64-static"),
    "s390x, g++": (["s390x-linux-gnu-g++"], "qemu-s390x-static"),
}


class Architectures(unittest.TestCase):
    def there(self, build, contract):
        (compiler, *target), emulator = BUILDS[build]
        with tempfile.TemporaryDirectory() as folder:
            return hashes(
                folder,
                compiler,
                "-O2",
                *target,
                f"-ffp-contract={contract}",
                "-static",
                emulator=[emulator],
            ).splitlines()

    def test_all_give_the_same_hashes_and_averages(self):
        with tempfile.TemporaryDirectory() as folder:
            here = hashes(folder, "g++", "-O2").splitlines()
        self.assertEqual(len(set(here)), HASHES + AVERAGES)
        for build in BUILDS:
            with self.subTest(build):
                self.assertEqual(self.there(build, "off"), here)
        fused = self.there("aarch64, g++", "fast")
        self.assertEqual(len(fused), HASHES + AVERAGES)
        for there, line in zip(fused, here):
            self.assertEqual(there.partition(":")[0], line.partition(":")[0])
        # Not every short run meets a product whose rounding matters; most do.
        different = sum(there != line for there, line in zip(fused, here))
        self.assertGreater(different, HASHES)


if __name__ == "__main__":
    for tool in [
        "g++",
        *(tool for words, emulator in BUILDS.values() for tool in (words[0], emulator)),
    ]:
        if not shutil.which(tool):
            print("skipped: this test needs", tool)
            sys.exit(77)
    unittest.main()
