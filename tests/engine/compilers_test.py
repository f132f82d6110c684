"""Every compiler gives bitwise identical trajectories and averages: compiles the engine with
baseline vectors by g++ and clang++ at -O0 to -O3. Compares the hashes of a few trajectories, and
the rotation rates of their clusters with standard errors.

golden_hash_test.cpp checks the levels that are shipped."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = os.environ.get(
    "SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
)
# One translation unit, so that the standard headers are read once.
PARTS = (
    "src/swirl/engine/placement.cpp",
    "src/swirl/engine/neighbors/choose_search.cpp",
    "src/swirl/engine/neighbors/search_setup.cpp",
    "src/swirl/engine/simulation_storage.cpp",
    "src/swirl/engine/simulation.cpp",
    "src/swirl/engine/simd/event_loop_baseline.cpp",
    "tests/engine/compilers/print_hashes.cpp",
)
# These are compiled by themselves: the event loop without friction in one kind of contact has its
# own settings.
SEPARATE_PARTS = (
    "src/swirl/engine/simd/event_loop_partial_friction.cpp",
    "src/swirl/measure/cluster_rotation.cpp",
)

# Lines that print_hashes.cpp prints.
HASHES, AVERAGES = 9, 9


def compiler(*names):
    return next((path for path in map(shutil.which, names) if path), None)


def hashes(folder, cxx, level, *flags, emulator=()):
    unit = os.path.join(folder, "unit.cpp")
    with open(unit, "w") as f:
        f.writelines(f'#include "{SOURCE}/{part}"\n' for part in PARTS)
    more = [os.path.join(SOURCE, part) for part in SEPARATE_PARTS]
    program = os.path.join(folder, "print_hashes")
    subprocess.run(
        [
            cxx,
            "-std=c++20",
            level,
            "-ffp-contract=off",
            "-DSWIRL_BASELINE_ONLY",
            "-w",
            f"-I{SOURCE}/src",
            f"-I{SOURCE}/tests",
            *flags,
            unit,
            *more,
            "-o",
            program,
        ],
        check=True,
    )
    return subprocess.run([*emulator, program], check=True, capture_output=True, text=True).stdout


class Compilers(unittest.TestCase):
    def test_all_give_the_same_hashes(self):
        gcc, clang = compiler("g++"), compiler("clang++-19", "clang++")
        builds = [(c, f"-O{n}") for c in (gcc, clang) for n in range(4)]
        if not gcc or not clang:
            print("skipped: this test needs g++ and clang++")
            sys.exit(77)
        with tempfile.TemporaryDirectory() as folder:
            first = hashes(folder, *builds[0])
            self.assertEqual(len(set(first.splitlines())), HASHES + AVERAGES)
            for build in builds[1:]:
                with self.subTest(build=build):
                    self.assertEqual(hashes(folder, *build), first)


if __name__ == "__main__":
    unittest.main()
