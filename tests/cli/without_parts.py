"""Programs without some parts compile, run, list all subcommands, and report what is missing: the one
that the first ./swirl builds (no figures, no camera), and one without camera support only."""

import os
import unittest

import program
from program import InFolder, result_of, swirl

FULL = program.SWIRL
FIRST = os.environ["SWIRL_FIRST"]
WITHOUT_CAMERA = os.environ["SWIRL_WITHOUT_CAMERA"]


class WithoutParts(InFolder):
    def tearDown(self):
        program.SWIRL = FULL
        super().tearDown()

    def assert_missing(self, which, names, *call):
        program.SWIRL = which
        done = swirl(*call)
        self.assertEqual((done.returncode, done.stdout), (1, ""), done.stderr)
        self.assertIn(names, done.stderr)

    def test_track_names_the_packages_to_install(self):
        for which in (FIRST, WITHOUT_CAMERA):
            self.assert_missing(which, "libopencv-core-dev", "track", "video.mp4", "--out",
                                self.path("tracks.csv"))

    def test_experiment_names_the_packages_to_install(self):
        self.assert_missing(WITHOUT_CAMERA, "libopencv-core-dev", "experiment", "video.mp4",
                            "--no-simulation", "--out", self.path("report"))

    def test_paper_and_experiment_name_the_option_of_the_build(self):
        for call in (["paper", "--quick"], ["experiment", "video.mp4"]):
            self.assert_missing(FIRST, "SWIRL_PAPER", *call, "--out", self.path("report"))
            self.assertFalse(os.path.exists(self.path("report")))
            self.assert_missing(FIRST, f"./swirl {call[0]}", *call, "--out", self.path("report"))

    def test_every_subcommand_is_listed(self):
        help_of_all = swirl("--help").stdout
        for program.SWIRL in (FIRST, WITHOUT_CAMERA):
            self.assertEqual(swirl("--help").stdout, help_of_all)

    def test_figures_are_listed_with_the_layer_and_not_without(self):
        listed = swirl("paper", "--help").stdout
        program.SWIRL = WITHOUT_CAMERA
        self.assertEqual(swirl("paper", "--help").stdout, listed)
        program.SWIRL = FIRST
        first = swirl("paper", "--help").stdout
        self.assertIn("Figures: `./swirl paper --help` lists them.", first)
        self.assertEqual(first.split("Figures:")[0], listed.split("Groups of figures:")[0])

    def test_runs_equal_those_of_the_full_build(self):
        call = ("--discs", "28", "--mu", "1", "--events", "5000", "--seed", "3")
        full = result_of(*call)["state_hash"]
        for program.SWIRL in (FIRST, WITHOUT_CAMERA):
            self.assertEqual(result_of(*call)["state_hash"], full)


if __name__ == "__main__":
    unittest.main()
