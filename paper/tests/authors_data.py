"""Compares runs with the numbers that the authors of the paper published (paper/authors_data.py).
Their files are not part of this repository. The folder is ../shared/authors_data, next to this tree
or to the tree of which it is a clone, or a clone of github.com/jpryan1/rotation-sim that the
environment variable AUTHORS_DATA names. Without it, this test is skipped."""

import math
import os
import subprocess
import sys
import tempfile
import unittest

SOURCE = os.environ["SWIRL_SOURCE"]
ORIGIN = subprocess.run(
    ["git", "-C", SOURCE, "remote", "get-url", "origin"], capture_output=True, text=True
).stdout.strip()
FOLDERS = (
    [os.environ["AUTHORS_DATA"]]
    if "AUTHORS_DATA" in os.environ
    else [
        os.path.normpath(os.path.join(tree, "..", "shared", "authors_data"))
        for tree in (SOURCE, ORIGIN)
        if tree
    ]
)
AUTHORS = next(filter(os.path.isdir, FOLDERS), None)
if AUTHORS is None:
    print("skipped: the authors' data are not at", *FOLDERS)
    sys.exit(77)

from paper import authors_data

SEEDS = 2
NUMBERS = range(8, 45, 6)
COVER = authors_data.R**2  # discs that would cover the container


def largest_rms(count):
    """No rms of `count` independent values of z is larger, but with a probability of 10⁻⁶: the
    quantile of χ² by the formula of Wilson and Hilferty."""
    part = 2 / (9 * count)
    return math.sqrt((1 - part + 4.753 * math.sqrt(part)) ** 3)


class AuthorsData(unittest.TestCase):
    def rms_of_curve(self, name, *parameters):
        with tempfile.TemporaryDirectory() as out:
            rows = authors_data.curve(AUTHORS, out, name, *parameters, numbers=NUMBERS)
        self.assertEqual(len(rows), len(NUMBERS))
        return authors_data.rms([row["z"] for row in rows])[0]

    # The errors are from the scatter of three seeds at three to five N, and the variance of
    # Student's t with six degrees of freedom is 6/4.
    LARGEST = largest_rms(len(NUMBERS)) * math.sqrt(6 / 4)

    def test_curves(self):
        for entry in authors_data.CURVES:
            with self.subTest(entry[0]):
                self.assertLess(self.rms_of_curve(*entry), self.LARGEST)

    def test_a_wrong_inertia_is_found(self):
        self.assertGreater(self.rms_of_curve("both 1", 1, 1, 1), self.LARGEST)

    def rms_of_maps(self, discs):
        runs = [authors_data.averages(discs, seed) for seed in range(1, SEEDS + 1)]
        return {
            kind: authors_data.rms(authors_data.compare(AUTHORS, kind, discs, runs)[2])[0]
            for kind in ("density", "flow", "profile")
        }

    # The position of one disc is in many cells: as many values are independent as discs would cover
    # the container, or its outer ring for the profile. The errors are from 20 blocks, and the
    # variance of Student's t with 19 degrees of freedom is 19/17.
    LARGEST_OF_MAPS = {
        "density": largest_rms(COVER),
        "flow": largest_rms(COVER),
        "profile": largest_rms(math.pi * math.sqrt(COVER)),
    }

    def test_maps_and_profiles(self):
        for discs in (28, 48):
            for kind, found in self.rms_of_maps(discs).items():
                with self.subTest(kind, discs=discs):
                    self.assertLess(found, self.LARGEST_OF_MAPS[kind] * math.sqrt(19 / 17))


if __name__ == "__main__":
    unittest.main()
