"""swirl track on videos made by independent code (other_videos.py), with other dynamics, appearance and
faults. Tracks match the ground truth, or the video is rejected with the cause."""

import csv
import json
import math
import sys

try:
    import numpy
    import other_videos
except ImportError:
    print("skipped: numpy is not installed; Debian's package python3-numpy provides it.")
    sys.exit(77)

from program import InFolder, main, slow, some, swirl


class OtherVideos(InFolder):
    def call(self, *more, **faults):
        path = self.path("video.mp4")
        video = other_videos.make(path, **faults)
        done = swirl("track", path, "--out", self.path("tracks.csv"), "--overwrite", *more)
        if "no camera support" in done.stderr:
            self.skipTest("this build has no camera support")
        return video, done

    def check_tracks(self, max_rms, amplitude=0.3, **faults):
        """All spheres are tracked in all frames, without identity swaps, within max_rms pixels."""
        video, done = self.call(**faults)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("tracks.camera.json"), encoding="utf-8") as file:
            camera = json.load(file)
        here = {}
        with open(self.path("tracks.csv"), encoding="utf-8") as file:
            for row in csv.DictReader(file):
                here.setdefault(int(row["frame"]), []).append(
                    (float(row["x"]), float(row["y"]), int(row["particle"])))
        self.assertEqual(camera["discs"], len(video.radii))
        self.assertEqual(camera["path"]["clockwise"], video.clockwise)
        tracks, off = {}, []
        for frame, positions in enumerate(video.positions):
            seen = numpy.array([p[:2] for p in here[frame]])
            self.assertEqual(len(seen), len(positions), frame)
            for sphere, position in enumerate(positions):
                d = seen - position
                nearest = int(numpy.hypot(d[:, 0], d[:, 1]).argmin())
                self.assertLess(math.hypot(*d[nearest]), 0.5 * video.radii[sphere])
                track = here[frame][nearest][2]
                self.assertEqual(tracks.setdefault(sphere, track), track)
                off.append(d[nearest])
        self.assertLess(math.sqrt(numpy.mean(numpy.square(off))), max_rms)
        omega = camera["path"]["omega"] / camera["fps"] * video.frames_per_period / (2.0 * math.pi)
        self.assertLess(abs(omega - 1.0), 1e-3)
        self.assertLess(math.dist(camera["path"]["centre"], video.centre), 0.3)
        self.assertLess(abs(camera["path"]["amplitude"] - video.amplitude), amplitude)
        return camera, done.stdout

    # Edges give positions to 1/100 of a radius; patches of texture double the error.
    def test_bright_spheres_with_clutter(self):
        self.check_tracks(0.3, clutter=50, label=True, vignette=0.5, codec=("libx264", "-crf", "24"))

    @slow("dark discs are in track_test.py too")
    def test_dark_spheres_clockwise_in_a_portrait_video(self):
        camera, _ = self.check_tracks(0.2, floor=205, ball=60, rim=90, table=150, clockwise=True,
                               size=(280, 420), middle=(0, 60))
        self.assertEqual(camera["discs_are"], "dark")

    @slow("the bright spheres above check the lens too; texture only makes that harder")
    def test_spheres_without_texture_do_not_imply_lens_distortion(self):
        camera, _ = self.check_tracks(0.25, texture="none")
        self.assertEqual(camera["lens"]["distortion"], 0.0)

    def test_dropped_and_duplicated_frames_are_rejected(self):
        for word, faults in some((("missing", {"drop": (20, 41, 42)}),
                                  ("duplicated", {"double": (20, 41, 60)}),
                                  ("duplicated", {"double": tuple(range(84)), "fps": "60"})), 2):
            _, done = self.call(**faults)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn(word, done.stderr)
            self.assertIn("cut the video", done.stderr)
            self.assertEqual(self.left_behind(), ["video.mp4"])

    def test_camera_shake_is_reported_but_not_as_duplicated_frames(self):
        video, done = self.call(shake=1.7)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("shakes by", done.stderr)
        self.assertNotIn("duplicated", done.stderr)
        with open(self.path("tracks.camera.json"), encoding="utf-8") as file:
            camera = json.load(file)
        self.assertAlmostEqual(camera["container"]["shake"], 1.7, delta=0.5)  # of 84 frames
        self.assertEqual(camera["discs"], len(video.radii))
        omega = 2.0 * math.pi / video.frames_per_period * camera["fps"]
        self.assertLess(abs(camera["path"]["omega"] - omega), 3.0 * camera["path"]["omega_error"])


if __name__ == "__main__":
    main()
