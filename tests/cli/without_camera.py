"""A build without OpenCV, as the first ./swirl makes it: it compiles, runs and names what is missing."""

import os
import unittest

import program
from program import InFolder, result_of, swirl

WITHOUT = os.environ["SWIRL_WITHOUT_CAMERA"]


class WithoutCamera(InFolder):
    def setUp(self):
        super().setUp()
        with_camera = program.SWIRL
        self.addCleanup(setattr, program, "SWIRL", with_camera)
        program.SWIRL = WITHOUT

    def test_track_names_the_packages_to_install(self):
        done = swirl("track", "video.mp4", "--out", os.path.join(self.folder, "tracks.csv"))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("libopencv-core-dev", done.stderr)

    def test_experiment_names_the_packages_to_install(self):
        done = swirl("experiment", "video.mp4", "--no-simulation", "--out",
                     os.path.join(self.folder, "report"))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("libopencv-core-dev", done.stderr)

    def test_runs_equal_those_of_the_full_build(self):
        call = ("--discs", "28", "--mu", "1", "--events", "5000", "--seed", "3")
        without = result_of(*call)["state_hash"]
        program.SWIRL = os.environ["SWIRL"]
        self.assertEqual(without, result_of(*call)["state_hash"])


if __name__ == "__main__":
    unittest.main()
