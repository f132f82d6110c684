"""swirl track --motion-out: the motion of a container in a video, and a run on it."""

import csv
import json
import math
import os
import re

from program import InFolder, main, some, swirl

# Twenty discs of radius 12 pixels in a container of 6.5 radii; 48 frames per period.
SCALE, FRAMES = 12, 48
VIDEO = [
    "--discs",
    20,
    "--container-radius",
    6.5,
    "--scale",
    SCALE,
    "--width",
    240,
    "--height",
    240,
    "--frames-per-period",
    FRAMES,
    "--noise",
    2,
    "--quality",
    14,
    "--seed",
    3,
    "--fps",
    60,
]
NUMBER = r"[\d.]+"


class Recorded:
    """A file of swirl track --motion-out: its points, and the errors that its comments state."""

    def __init__(self, file):
        with open(file, encoding="utf-8") as opened:
            self.text = opened.read()
        rows = csv.DictReader(line for line in self.text.splitlines() if not line.startswith("#"))
        self.points = [(float(row["t"]), float(row["x"]), float(row["y"])) for row in rows]

    def stated(self, before, after):
        """(value, error) between two texts of a comment."""
        found = re.search(rf"{before} ({NUMBER}) ± ({NUMBER}) {after}", self.text)
        return float(found[1]), float(found[2])

    def number(self, before, after):
        return float(re.search(rf"{before} ({NUMBER}) {after}", self.text)[1])

    def extent(self, column):
        values = [point[column] for point in self.points]
        return 0.5 * (max(values) - min(values))


class RecordedPath(InFolder):
    def video(self, *more, name="shaker.mp4", length=3.2):
        done = swirl(
            "synthetic-video",
            *VIDEO,
            "--periods",
            length,
            "--out",
            self.path(name),
            "--quiet",
            *more,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.path(name)

    def record(self, video, *more, name="path.csv"):
        done = swirl("track", video, "--motion-out", self.path(name), *more)
        if "no camera support" in done.stderr:
            self.skipTest("this build has no camera support")
        self.assertEqual(done.returncode, 0, done.stderr)
        return Recorded(self.path(name)), done

    def rotation(self, *options):
        done = swirl("run", "--discs", 20, "--periods", 300, *options, "--json", "-", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        rate = json.loads(done.stdout)["rotation"]["mean_by_time"]
        return rate["mean"], rate["error"]

    def test_a_circle_has_its_radius_centre_and_period_and_gives_its_rotation(self):
        path, done = self.record(self.video("--motion", "circle"))
        self.assertEqual(len(path.points), 121)
        self.assertEqual(path.points[0][1:], path.points[-1][1:])
        point_error = path.number("standard error of a coordinate", "disc radii")
        radius_error = path.number("scale error", "%") / 100.0
        # Within three of the stated errors: of the points, and of the disc radius in pixels.
        radii = [math.hypot(x, y) for _, x, y in path.points[:-1]]
        self.assertLess(
            abs(sum(radii) / 120 - 1.892), 3 * math.hypot(point_error, radius_error * 1.892)
        )
        self.assertLess(max(radii) - min(radii), 10 * point_error)
        for column in (1, 2):
            self.assertLess(abs(sum(point[column] for point in path.points[:-1]) / 120), 1e-6)
        self.assertLess(point_error, 0.05)  # the error of the lens dominates
        period, error = path.stated("period", "s")
        self.assertLess(abs(period - FRAMES / 60), 3 * error + 0.5e-4)  # the rounding of its digits
        # A run on it rotates as on the circle, within the errors of the two averages and that of
        # the scale. ϖ changes by less than 0.4 per unit of the amplitude here, and of the
        # container's radius.
        self.assertIn(
            f"swirl run --motion {self.path('path.csv')} --container-radius R", done.stdout
        )
        options = "--motion", self.path("path.csv"), "--container-radius", 6.5
        ours, circle = self.rotation(*options), self.rotation(
            "--motion", "circle", "--container-radius", 6.5
        )
        self.assertLess(
            abs(ours[0] - circle[0]), 3 * math.hypot(ours[1], circle[1]) + 0.4 * 8.4 * radius_error
        )
        # The tracks of the same video have the same motion.
        both, done = self.record(
            self.path("shaker.mp4"), "--out", self.path("tracks.csv"), name="both.csv"
        )
        self.assertIn("both.csv: motion of the container", done.stdout)
        wall = float(re.search(rf"--container-radius ({NUMBER})", done.stdout)[1])
        self.assertLess(abs(wall / 6.5 - 1), 3 * radius_error)
        with open(self.path("tracks.camera.json"), encoding="utf-8") as opened:
            found = json.load(opened)["camera"]
        self.assertLess(abs(both.extent(1) / found["amplitude"] - 1), 0.005)

    def test_lines_and_ellipses(self):
        # An ellipse is recorded in test_a_recorded_path_is_seen_from_above, too.
        for name, shape, ratio in some((("line", "line", 0.0), ("ellipse", "ellipse:0.4", 0.4)), 1):
            with self.subTest(shape):
                path, _ = self.record(
                    self.video("--motion", shape, name=f"{name}.mp4"), name=f"{name}.csv"
                )
                error = 3 * math.hypot(
                    path.number("standard error of a coordinate", "disc radii"),
                    path.number("scale error", "%") / 100.0 * 1.892,
                )
                self.assertLess(abs(path.extent(1) - 1.892), error)
                self.assertLess(abs(path.extent(2) - ratio * 1.892), error)
                done = swirl(
                    "run",
                    "--motion",
                    self.path(f"{name}.csv"),
                    "--container-radius",
                    6.5,
                    "--discs",
                    20,
                    "--periods",
                    5,
                    "--quiet",
                )
                self.assertEqual(done.returncode, 0, done.stderr)
        # Discs in such a container cannot be tracked.
        done = swirl(
            "track",
            self.path("line.mp4"),
            "--out",
            self.path("t.csv"),
            "--motion-out",
            self.path("p.csv"),
        )
        self.assertEqual(done.returncode, 1)
        self.assertIn("does not move along a circle", done.stderr)
        self.assertIn("--motion", done.stderr)
        self.assertFalse(os.path.exists(self.path("p.csv")))

    def test_a_recorded_path_is_seen_from_above(self):
        # The ellipse is clockwise and begins elsewhere; y is up.
        path, _ = self.record(
            self.video("--motion", "ellipse:0.5", "--direction", "clockwise", "--start-angle", 90)
        )
        area = sum(a[1] * b[2] - b[1] * a[2] for a, b in zip(path.points, path.points[1:]))
        self.assertLess(area, 0.0)
        self.assertLess(abs(path.points[0][1]), 0.05)
        self.assertLess(path.points[0][2], -0.8)

    def test_what_cannot_be_recorded(self):
        skipped = ",".join(
            f"{FRAMES * k + 20}-{FRAMES * k + 31}" for k in range(2)
        )  # a quarter of each period
        moving = self.video(length=2.2)
        self.record(moving)
        for video, more, says in (
            (self.video("--camera-on-container", name="still.mp4", length=1.3), (), "stands still"),
            (self.video(length=1.3, name="short.mp4"), (), "at least two"),
            (moving, ("--ignore-frames", skipped), "gap"),
        ):
            self.assert_fails(
                1, "track", video, "--motion-out", self.path("p.csv"), *more, says=(says, "hint:")
            )
            self.assertFalse(os.path.exists(self.path("p.csv")))
        for more, code, says in (
            (("--motion-out", self.path("p.txt")), 2, ".csv"),
            ((), 2, "--motion-out"),
            (("--motion-out", self.path("p.csv"), "--json", "-"), 2, "--out"),
            (("--motion-out", self.path("p.csv"), "--spin"), 2, "--out"),
        ):
            done = swirl("track", moving, *more)
            self.assertEqual(done.returncode, code)
            self.assertIn(says, done.stderr)
        self.assert_fails(
            1, "track", moving, "--motion-out", self.path("path.csv"), says="--overwrite"
        )


if __name__ == "__main__":
    main()
