"""swirl track on films that were made without it (other_videos.py): other dynamics, other looks, other
faults. What is found is near the truth, or the film is refused with the cause."""

import csv
import json
import math
import sys
import unittest

try:
    import numpy
    import other_videos
except ImportError:
    print("skipped: numpy is not installed; Debian's package python3-numpy provides it.")
    sys.exit(77)

from program import InFolder, swirl


class OtherFilms(InFolder):
    def call(self, *more, **faults):
        path = self.path("film.mp4")
        film = other_videos.make(path, **faults)
        done = swirl("track", path, "--out", self.path("tracks.csv"), "--overwrite", *more)
        if "has no eyes" in done.stderr:
            self.skipTest("this build was made without OpenCV")
        return film, done

    def found(self, most, amplitude=0.3, **faults):
        """All balls in all pictures, under the same names, within `most` pixels rms."""
        film, done = self.call(**faults)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("tracks.camera.json"), encoding="utf-8") as file:
            camera = json.load(file)
        here = {}
        with open(self.path("tracks.csv"), encoding="utf-8") as file:
            for row in csv.DictReader(file):
                here.setdefault(int(row["frame"]), []).append(
                    (float(row["x"]), float(row["y"]), int(row["particle"])))
        self.assertEqual(camera["discs"], len(film.radii))
        self.assertEqual(camera["path"]["clockwise"], film.clockwise)
        names, off = {}, []
        for frame, places in enumerate(film.places):
            seen = numpy.array([p[:2] for p in here[frame]])
            self.assertEqual(len(seen), len(places), frame)
            for ball, place in enumerate(places):
                d = seen - place
                nearest = int(numpy.hypot(d[:, 0], d[:, 1]).argmin())
                self.assertLess(math.hypot(*d[nearest]), 0.5 * film.radii[ball])
                name = here[frame][nearest][2]
                self.assertEqual(names.setdefault(ball, name), name)
                off.append(d[nearest])
        self.assertLess(math.sqrt(numpy.mean(numpy.square(off))), most)
        omega = camera["path"]["omega"] / camera["fps"] * film.per_swirl / (2.0 * math.pi)
        self.assertLess(abs(omega - 1.0), 1e-3)
        self.assertLess(math.dist(camera["path"]["centre"], film.centre), 0.3)
        self.assertLess(abs(camera["path"]["amplitude"] - film.amplitude), amplitude)
        return camera, done.stdout

    # A hundredth of a radius is what edges can tell; balls in patches err by twice that.
    def test_bright_balls_among_things_that_lie_about(self):
        self.found(0.3, clutter=50, label=True, vignette=0.5, codec=("libx264", "-crf", "24"))

    def test_dark_balls_that_go_round_clockwise_in_a_tall_picture(self):
        camera, _ = self.found(0.2, floor=205, ball=60, rim=90, table=150, clockwise=True,
                               size=(280, 420), middle=(0, 60))
        self.assertEqual(camera["discs_are"], "dark")

    def test_balls_without_texture_do_not_pass_for_a_lens(self):
        camera, _ = self.found(0.25, texture="none")
        self.assertEqual(camera["lens"]["distortion"], 0.0)

    def test_pictures_that_are_lost_or_there_twice_are_told(self):
        for word, faults in (("missing", {"drop": (20, 41, 42)}),
                             ("there twice", {"double": (20, 41, 60)}),
                             ("there twice", {"double": tuple(range(84)), "fps": "60"})):
            _, done = self.call(**faults)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn(word, done.stderr)
            self.assertIn("cut the film", done.stderr)
            self.assertEqual(self.left_behind(), ["film.mp4"])

    def test_a_shaking_camera_is_reported_and_no_frame_is_there_twice(self):
        film, done = self.call(shake=1.7)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("shakes by", done.stdout)
        self.assertNotIn("twice", done.stdout)
        with open(self.path("tracks.camera.json"), encoding="utf-8") as file:
            camera = json.load(file)
        self.assertAlmostEqual(camera["dish"]["shake"], 1.7, delta=0.5)  # of 84 frames
        self.assertEqual(camera["discs"], len(film.radii))
        omega = 2.0 * math.pi / film.per_swirl * camera["fps"]
        self.assertLess(abs(camera["path"]["omega"] - omega), 3.0 * camera["path"]["omega_error"])


if __name__ == "__main__":
    unittest.main()
