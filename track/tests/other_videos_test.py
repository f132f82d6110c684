"""swirl track on videos made by independent code (other_videos.py), with other dynamics, appearance
and faults. Tracks match the ground truth, or the video is rejected with the cause."""

import csv
import math
import os
import re
import sys

try:
    import numpy
    import other_videos
except ImportError:
    print("skipped: numpy is not installed; Debian's package python3-numpy provides it.")
    sys.exit(77)

from program import InFolder, main, slow, some, swirl
from track_test import calibration


class OtherVideos(InFolder):
    def call(self, *more, **faults):
        path = self.path("video.mp4")
        video = other_videos.make(path, **faults)
        done = swirl(
            "track", path, "--out", self.path("tracks.csv"), "--overwrite", "--verbose", *more
        )
        if "no camera support" in done.stderr:
            self.skipTest("this build has no camera support")
        return video, done

    def check_tracks(self, max_rms, amplitude=0.3, **faults):
        """All spheres are tracked in all frames, without identity swaps, within max_rms pixels."""
        video, done = self.call(**faults)
        self.assertEqual(done.returncode, 0, done.stderr)
        camera = calibration(self.path("tracks.csv"))
        here = {}
        with open(self.path("tracks.csv"), encoding="utf-8") as file:
            for row in csv.DictReader(file):
                here.setdefault(int(row["frame"]), []).append(
                    (float(row["x"]), float(row["y"]), int(row["particle"]))
                )
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

    def error_in_frame(self, video):
        """The rms distance of a coordinate to the nearest sphere, in the frames as they are."""
        off = []
        with open(self.path("tracks.csv"), encoding="utf-8") as file:
            for row in csv.DictReader(file):
                d = video.positions[int(row["frame"])] - numpy.array(
                    [float(row["x_seen"]), float(row["y_seen"])]
                )
                off.append(d[numpy.hypot(d[:, 0], d[:, 1]).argmin()])
        return math.sqrt(numpy.mean(numpy.square(off)))

    # Edges give positions to 1/100 of a radius; patches of texture double the error.
    def test_bright_spheres_with_clutter(self):
        # What moves on the table, as the shadows of leaves do, is no motion of the camera: 1.6
        # pixels if it were.
        camera, _ = self.check_tracks(
            0.3, clutter=50, sway=2.0, label=True, vignette=0.5, codec=("libx264", "-crf", "24")
        )
        self.assertIsNone(camera["camera_motion"]["source"])

    @slow("dark discs are in track_test.py too")
    def test_dark_spheres_clockwise_in_a_portrait_video(self):
        camera, _ = self.check_tracks(
            0.2,
            floor=205,
            ball=60,
            rim=90,
            table=150,
            clockwise=True,
            size=(280, 420),
            middle=(0, 60),
        )
        self.assertEqual(camera["discs_are"], "dark")

    @slow("the bright spheres above check the lens too; texture only makes that harder")
    def test_spheres_without_texture_do_not_imply_lens_distortion(self):
        camera, _ = self.check_tracks(0.25, texture="none")
        self.assertEqual(camera["lens"]["distortion"], 0.0)

    @slow("dark and bright discs are in track_test.py too")
    def test_spheres_of_both_brightnesses_are_tracked(self):
        # Light from one side shifts dark and bright spheres in opposite directions: 1.1 pixels; the
        # limit is a tenth of the radius.
        camera, _ = self.check_tracks(
            1.4,
            floor=120.0,
            ball=180.0,
            colours=((225, 225, 225), (25, 25, 25)),
            texture="none",
            gloss=0.0,
            seed=2,
        )
        self.assertEqual(camera["discs_are"], "dark and bright")
        self.assertGreater(camera["quality"]["position_error"], 0.7)

    def test_spheres_of_two_colours_are_tracked(self):
        # In grey the red spheres hardly differ from the floor, and 18 of 20 are counted. Colours
        # are recorded with half the resolution of grey.
        camera, _ = self.check_tracks(
            0.4, floor=52.0, colours=((170, 25, 30), (225, 190, 60)), seed=4
        )
        self.assertEqual(camera["discs_are"], "coloured")

    def test_dropped_and_duplicated_frames_are_rejected(self):
        for word, faults in some(
            (
                ("missing", {"drop": (20, 41, 42)}),
                ("duplicated", {"double": (20, 41, 60)}),
                ("duplicated", {"double": tuple(range(84)), "fps": "60"}),
            ),
            1,
        ):
            _, done = self.call(**faults)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn(word, done.stderr)
            self.assertIn(
                "--correct-frames " + word.replace("duplicated", "duplicates"), done.stderr
            )
            self.assertEqual(self.left_behind(), ["video.mp4"])

    def test_accepted_duplicates_and_missing_frames_are_corrected(self):
        faults = ({"double": (20, 41, 60)}, "duplicates"), ({"drop": (20, 41, 42)}, "missing")
        for fault, word in some(faults, 1):
            video, done = self.call("--correct-frames", word, **fault)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("accepted", done.stderr)
            camera = calibration(self.path("tracks.csv"))
            omega = 2.0 * math.pi / video.frames_per_period * camera["fps"]
            self.assertLess(abs(camera["path"]["omega"] / omega - 1.0), 1e-3)  # 3 % without

    def test_parts_of_a_video(self):
        video, done = self.call(
            "--first-frame", 20, "--last-frame", 79, "--ignore-frames", "30,40-41"
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("tracks.csv"), encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual({int(row["frame"]) for row in rows}, set(range(20, 80)))
        self.assertEqual({int(row["frame"]) for row in rows if row["seen"] == "0"}, {30, 40, 41})
        for row in rows:
            d = numpy.array(video.positions[int(row["frame"])]) - [float(row["x"]), float(row["y"])]
            self.assertLess(numpy.hypot(d[:, 0], d[:, 1]).min(), 2.0)  # filled in by straight lines
        for call in (
            ("--first-frame", -1),
            ("--first-frame", 9, "--last-frame", 8),
            ("--ignore-frames", "4-"),
            ("--correct-frames", "all"),
            ("--last-frame", 9, "--max-frames", 9),
        ):
            done = swirl("track", self.path("video.mp4"), "--out", self.path("no.csv"), *call)
            self.assertEqual(done.returncode, 2, done.stderr)

    def test_camera_shake_is_removed(self):
        # As accurate as without shake: 0.19 pixels. The second video has no pattern on the table.
        for faults, source in some(
            (({"shake": 5.0, "clutter": 50}, "background"), ({"shake": 3.0}, "rim")), 1
        ):
            video, done = self.call(**faults)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotIn("duplicated", done.stderr)
            self.assertIn(f"removed, from the {source}", done.stdout)
            camera = calibration(self.path("tracks.csv"))
            self.assertEqual(camera["camera_motion"]["source"], source)
            shake = faults["shake"]
            self.assertAlmostEqual(camera["camera_motion"]["shake"], shake, delta=0.3 * shake)
            self.assertEqual(camera["discs"], len(video.radii))
            self.assertLess(self.error_in_frame(video), 0.3)
            if source == "background":
                omega = 2.0 * math.pi / video.frames_per_period * camera["fps"]
                self.assertLess(abs(camera["path"]["omega"] / omega - 1.0), 1e-3)

    def test_the_centre_of_a_path_by_hand_may_wander(self):
        video, done = self.call(frames_per_period=16, wander=9.0)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("the centre of the container's path wanders by", done.stderr)
        self.assertEqual(calibration(self.path("tracks.csv"))["discs"], len(video.radii))
        self.assertLess(self.error_in_frame(video), 0.5)

    def test_a_rejection_names_its_cause_with_a_number(self):
        for faults, cause in some(
            (
                ({"filter": "scale=iw:trunc(ih*0.4)*2"}, r"inclined by about 3[5-9] degrees"),
                (
                    {"filter": "drawbox=w=iw/2:t=fill"},
                    r"(4[5-9]|5\d) % of the container's rim shows no edge",
                ),
                ({"filter": "crop=320:200:0:0"}, r"3\d % of the container's rim lies outside"),
                ({"drop": tuple(range(6, 84))}, r"the video has 6 frames, too few"),
                (
                    {"frames_per_period": 8, "amplitude": 34.0, "exposure": 0.5},
                    r"at 8\.0 frames per period there",
                ),
                (
                    {"exposure": 1.6, "frames_per_period": 12, "amplitude": 34.0},
                    "1.8 times as wide",
                ),
            ),
            2,
        ):
            _, done = self.call(**faults)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertRegex(done.stderr, cause)

    def test_who_follows_the_hint_of_a_rejection_gets_all_discs(self):
        # Each hint with options is tried. A part that is too short for tracking is not proposed.
        sixth, eighth = tuple(range(5, 84, 6)), tuple(range(20, 60, 8))
        cover = "drawbox=t=fill:enable='gte(n,40)'"
        for given, faults, problem, hints in some(
            (
                (
                    (),
                    {"filter": cover},
                    "in frames 40 to 83 no disc is visible",
                    ["--last-frame 39"],
                ),
                (
                    (),
                    {"double": sixth},
                    "14 frames are duplicated",
                    ["--correct-frames duplicates"],
                ),
                (
                    (),
                    {"drop": eighth},
                    "frames are missing before",
                    ["--correct-frames missing", "--first-frame 48 --last-frame 78"],
                ),
                (("--discs", 23), {}, "--discs is 23, but the video shows 20", ["omit --discs"]),
            ),
            2,
        ):
            video, done = self.call(*given, **faults)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn(problem, done.stderr)
            hint = done.stderr.partition("hint: ")[2]
            option = r"--(?:first-frame|last-frame|correct-frames) \S+"
            tried = re.findall(rf"omit --discs|{option}(?: {option})*", hint)
            self.assertEqual(tried, hints, hint)
            for options in tried:
                words = () if options.startswith("omit") else options.split()
                video, done = self.call(*words, **faults)
                self.assertEqual(done.returncode, 0, (options, done.stderr))
                self.assertEqual(calibration(self.path("tracks.csv"))["discs"], len(video.radii))
        # The first of these videos, whose frames have their numbers.
        video, done = self.call("--last-frame", 39, filter=cover)
        self.assertLess(self.error_in_frame(video), 0.3)

    @slow("two videos of 256 frames, which are not in the repository")
    def test_real_textures_with_soft_edges(self):
        # Balls cut from footage of a laboratory, moved as discs of a run. True R/r: 8.600.
        folder = os.path.join(os.environ["SWIRL_SOURCE"], "..", "shared", "real_textures")
        if not os.path.isdir(folder):
            self.skipTest("there is no folder ../shared/real_textures")
        for name, radius, container, max_rms in (
            ("discs", 27.50, 236.5, 0.1),
            ("hydrogel", 20.224, 173.92, 0.3),
        ):
            video = os.path.join(folder, f"hybrid_{name}_36")
            done = swirl("track", video + ".mp4", "--out", self.path("tracks.csv"), "--overwrite")
            self.assertEqual(done.returncode, 0, done.stderr)
            camera = calibration(self.path("tracks.csv"))
            self.assertEqual(camera["discs"], 36)
            self.assertLess(abs(camera["species"][0]["radius"] / radius - 1.0), 0.01)
            self.assertLess(abs(camera["container"]["radius"] / container - 1.0), 0.005)
            true = {}
            with open(video + ".truth.csv", encoding="utf-8") as file:
                for row in csv.DictReader(file):
                    true.setdefault(int(row["frame"]), []).append(
                        (float(row["x"]), float(row["y"]))
                    )
            off = []
            with open(self.path("tracks.csv"), encoding="utf-8") as file:
                for row in csv.DictReader(file):
                    d = numpy.array(true[int(row["frame"])]) - [
                        float(row["x_seen"]),
                        float(row["y_seen"]),
                    ]
                    off.append(d[numpy.hypot(d[:, 0], d[:, 1]).argmin()])
            rms = math.sqrt(numpy.mean(numpy.square(off)))
            self.assertLess(rms, max_rms)
            claimed = camera["quality"]["position_error"] / rms
            self.assertTrue(0.7 < claimed < 1.5, claimed)


if __name__ == "__main__":
    main()
