"""The engine gives the same bits whoever compiles it: builds it, baseline vectors only, with the
compilers found here, at several levels of optimisation, and compares the hashes of a few
trajectories.

By default the extremes, -O0 of one and -O2 of the other; with --every-level all of -O0 to -O3 of
both. The levels that we ship are held to the golden hashes by golden_hash_test.cpp."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = os.environ.get("SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(
    os.path.abspath(__file__)))))
# One translation unit, so that the standard headers are read once.
PARTS = ("src/swirl/engine/placement.cpp", "src/swirl/engine/simulation.cpp",
         "src/swirl/engine/simd/event_loop_baseline.cpp", "tests/engine/compilers/baseline_only.cpp",
         "tests/engine/compilers/print_hashes.cpp")

EVERY_LEVEL = "--every-level" in sys.argv


def compiler(*names):
    return next((path for path in map(shutil.which, names) if path), None)


def hashes(folder, cxx, level):
    unit = os.path.join(folder, "unit.cpp")
    with open(unit, "w") as f:
        f.writelines(f'#include "{SOURCE}/{part}"\n' for part in PARTS)
    program = os.path.join(folder, "print_hashes")
    subprocess.run([cxx, "-std=c++20", level, "-ffp-contract=off", "-w",
                    f"-I{SOURCE}/src", f"-I{SOURCE}/tests", unit, "-o", program], check=True)
    return subprocess.run([program], check=True, capture_output=True, text=True).stdout


class Compilers(unittest.TestCase):
    def test_all_give_the_same_hashes(self):
        gcc, clang = compiler("g++"), compiler("clang++-19", "clang++")
        if EVERY_LEVEL:
            builds = [(c, f"-O{n}") for c in (gcc, clang) for n in range(4)]
        else:
            builds = [(gcc, "-O0"), (clang, "-O2")]
        if not gcc or not clang:
            print("skipped: this test needs g++ and clang++")
            sys.exit(77)
        with tempfile.TemporaryDirectory() as folder:
            first = hashes(folder, *builds[0])
            self.assertEqual(len(first.splitlines()), 9)
            self.assertEqual(len(set(first.splitlines())), 9)
            for build in builds[1:]:
                with self.subTest(build=build):
                    self.assertEqual(hashes(folder, *build), first)


if __name__ == "__main__":
    unittest.main(argv=[a for a in sys.argv if a != "--every-level"])
