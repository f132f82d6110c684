"""swirl camera: whether a camera would do."""

import os
import re

from program import InFolder, main, slow, swirl

SMALL = ["--size", "320x240", "--discs", 12, "--quiet"]


class Rehearsal(InFolder):
    def answer(self, *more):
        """The share that is found, in per cent, and the error in pixels."""
        done = swirl("camera", *SMALL, *more)
        if "no camera support" in done.stderr or "was not found" in done.stderr:
            self.skipTest("this build has no camera support")
        self.assertEqual(done.returncode, 0, done.stderr)
        return (
            float(re.search(r"found +([\d.]+) %", done.stdout)[1]),
            float(re.search(r"error +([\d.]+) pixels", done.stdout)[1]),
            done.stdout,
        )

    def test_a_usual_camera_gives_its_error_and_keeps_its_video(self):
        video = self.path("dish.mp4")
        found, error, text = self.answer("--video", video)
        self.assertGreater(found, 95.0)
        self.assertLess(error, 1.0)
        # 15 frames per period.
        self.assertRegex(text, "rotation +needs 16 frames per period")
        for name in ("dish.mp4", "dish.truth.csv"):
            self.assertTrue(os.path.exists(self.path(name)))
        again = swirl("camera", *SMALL, "--video", video)
        self.assertEqual(again.returncode, 1, again.stdout)
        self.assertRegex(again.stderr, "already exists.*\nhint: use --overwrite")
        self.assertEqual(self.answer("--video", video, "--overwrite")[2], text)

    @slow("two more videos")
    def test_dim_light_is_worse(self):
        bright, dim = (self.answer("--fps", 60, "--light", light)[1] for light in ("bright", "dim"))
        self.assertGreater(dim, bright)

    def test_a_camera_that_is_too_slow_is_rejected_with_the_reason(self):
        done = swirl("camera", *SMALL, "--fps", 10)
        if "no camera support" in done.stderr or "was not found" in done.stderr:
            self.skipTest("this build has no camera support")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(done.stderr, r"\Aerror: a video by this camera is rejected: ")

    def test_values_that_no_camera_has_are_rejected(self):
        for option, value in (
            ("--size", "320"),
            ("--size", "321x240"),
            ("--size", "20x20"),
            ("--light", "moon"),
            ("--fps", 0),
            ("--period", -1),
            ("--period", 0.01),
            ("--discs", 0),
            ("--discs", 56),
            ("--video", "dish.avi"),
        ):
            done = swirl("camera", option, value)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(f"{option} is ", done.stderr)


if __name__ == "__main__":
    main()
