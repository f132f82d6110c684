"""Programs without some parts compile, run, list all subcommands, and report what is missing: the
one that the first ./swirl builds (no studies, no drawing, no camera), and one without camera
support only."""

import os
import subprocess
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

    def test_commands_that_read_videos_name_the_packages_to_install(self):
        for which, *call in (
            (FIRST, "track"),
            (WITHOUT_CAMERA, "track"),
            (WITHOUT_CAMERA, "experiment", "--no-simulation"),
        ):
            self.assert_missing(
                which, "libopencv-core-dev", *call, "video.mp4", "--out", self.path("tracks")
            )

    def test_commands_that_draw_name_the_package_to_install(self):
        for call in (("image",), ("movie",), ("synthetic-video",)):
            self.assert_missing(FIRST, "libcairo2-dev", *call, "--out", self.path("drawn"))
        self.assertEqual(os.listdir(self.folder), [])

    def test_without_cairo_and_opencv_cmake_says_what_the_build_lacks(self):
        done = subprocess.run(
            [
                "cmake",
                "-S",
                program.SOURCE,
                "-B",
                self.path("build"),
                "-DSWIRL_TESTS=OFF",
                "-DCMAKE_IGNORE_PATH=/usr/include/opencv4",
            ],
            capture_output=True,
            text=True,
            env=dict(os.environ, PKG_CONFIG_LIBDIR=self.folder),
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        for library in ("cairo", "OpenCV"):
            self.assertIn(f"-- {library} was not found", done.stdout)

    def test_commands_of_a_part_name_the_option_of_the_build(self):
        out = self.path("folder")
        for option, *call in (
            ("SWIRL_EXPERIMENT", "experiment", "video.mp4", "--out", out),
            ("SWIRL_STUDY", "sweep", "--discs", "5", "--out", out),
            ("SWIRL_STUDY", "collect", out),
            ("SWIRL_STUDY", "crossing"),
            ("SWIRL_STUDY", "map", "--x", "mu=0:1", "--out", out),
        ):
            self.assert_missing(FIRST, option, *call)
            self.assert_missing(FIRST, f"./swirl {call[0]}", *call)
        self.assertEqual(os.listdir(self.folder), [])

    def test_every_subcommand_is_listed(self):
        help_of_all = swirl("--help").stdout
        for program.SWIRL in (FIRST, WITHOUT_CAMERA):
            self.assertEqual(swirl("--help").stdout, help_of_all)

    def test_runs_equal_those_of_the_full_build(self):
        call = ("--discs", "28", "--mu", "1", "--events", "5000", "--seed", "3")
        full = result_of(*call)["state_hash"]
        for program.SWIRL in (FIRST, WITHOUT_CAMERA):
            self.assertEqual(result_of(*call)["state_hash"], full)


if __name__ == "__main__":
    unittest.main()
