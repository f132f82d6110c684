"""swirl synthetic-video and swirl track: from videos with known ground truth to ϖ.

    track_test.py            tests with small videos, a sample of them
    track_test.py --all      all of them
"""

import csv
import json
import math
import os
import re
import shutil
import subprocess

from program import ALL, InFolder, main, slow, some, swirl

# Twenty discs of radius 12 pixels in a container of 6.5 radii, 64 frames per period.
SMALL = [
    "--discs",
    20,
    "--container-radius",
    6.5,
    "--scale",
    12,
    "--width",
    240,
    "--height",
    240,
    "--frames-per-period",
    64,
    "--noise",
    2,
    "--quality",
    14,
    "--seed",
    3,
]
# The same with discs of radius 16 pixels.
LARGER = [
    "--discs",
    20,
    "--container-radius",
    6.5,
    "--scale",
    16,
    "--width",
    340,
    "--height",
    340,
    "--frames-per-period",
    64,
    "--noise",
    2,
    "--quality",
    14,
    "--seed",
    3,
]


def rows(path):
    with open(path, encoding="utf-8") as file:
        yield from csv.DictReader(file)


def calibration(tracks):
    with open(os.path.splitext(tracks)[0] + ".camera.json", encoding="utf-8") as file:
        return json.load(file)


def positions(path, x="x", y="y"):
    """{frame: {particle: (x, y)}} without interpolated positions."""
    found = {}
    for row in rows(path):
        if row.get("seen", "1") == "1":
            found.setdefault(int(row["frame"]), {})[int(row["particle"])] = (
                float(row[x]),
                float(row[y]),
            )
    return found


class Score:
    """Tracks against the ground truth, each as {frame: {id: (x, y)}}: rms error and identity
    swaps."""

    def __init__(self, truth, found, about):
        radius = about["scale"]
        errors, owner = [], {}
        self.full, self.swapped = 0, []  # swapped: frame, track before and after
        for frame, discs in truth.items():
            hits = 0
            for disc, (x, y) in discs.items():
                near = min(
                    (
                        (math.hypot(u - x, v - y), track)
                        for track, (u, v) in found.get(frame, {}).items()
                    ),
                    default=(1e9, -1),
                )
                if near[0] > 0.5 * radius:
                    continue
                hits += 1
                errors.append(near[0])
                if owner.get(disc, near[1]) != near[1]:
                    self.swapped.append((frame, owner[disc], near[1]))
                owner[disc] = near[1]
            self.full += hits == len(discs)
        self.frames, self.swaps = len(truth), len(self.swapped)
        self.complete = self.full / self.frames
        self.rms = math.sqrt(sum(e * e for e in errors) / len(errors) / 2.0)
        periods = self.frames * about["omega"] / (2.0 * math.pi)
        self.swaps_per_thousand = 1000.0 * self.swaps / (about["discs"] * periods)


class Truth:
    """The ground truth next to a video."""

    def __init__(self, video):
        with open(video[: -len(".mp4")] + ".truth.json", encoding="utf-8") as file:
            self.about = json.load(file)


class Comparison(Score):
    """Tracks against the ground truth of a video."""

    def __init__(self, video, tracks):
        self.truth = Truth(video).about
        self.found = calibration(tracks)
        super().__init__(
            positions(video[: -len(".mp4")] + ".truth.csv", "x_ideal", "y_ideal"),
            positions(tracks),
            self.truth,
        )
        fps = self.found["fps"]
        self.omega = self.found["path"]["omega"] / fps / self.truth["omega"] - 1.0
        self.centre = math.dist(self.found["path"]["centre"], self.truth["centre"])
        self.amplitude = self.found["path"]["amplitude"] - self.truth["amplitude"]
        self.radius = self.found["species"][0]["radius"] / self.truth["scale"] - 1.0


class SpinComparison:
    """Spins in tracks against the ground truth, in Ω."""

    def __init__(self, video, tracks):
        stem = video[: -len(".mp4")]
        with open(stem + ".truth.json", encoding="utf-8") as file:
            truth = json.load(file)
        found = calibration(tracks)
        step, omega = found["spins"]["step"], found["path"]["omega"]
        turns, here = {}, {}
        for row in rows(stem + ".truth.csv"):
            frame, disc = int(row["frame"]), int(row["particle"])
            turns[frame, disc] = float(row["spin_z"])
            here.setdefault(frame, []).append((float(row["x_ideal"]), float(row["y_ideal"]), disc))
        self.pairs = []  # true and measured
        for row in rows(tracks):
            frame = int(row["frame"])
            if row["seen"] != "1" or not row["texture_match"] or float(row["texture_match"]) == 0.0:
                continue
            position = float(row["x"]), float(row["y"])
            distance, disc = min((math.dist(position, (x, y)), disc) for x, y, disc in here[frame])
            steps = range(frame - step + 1, frame + step + 1)
            if (
                distance > 0.3 * truth["scale"]
                or any((k, disc) not in turns for k in steps)
                or frame < step
            ):
                continue
            true = sum(turns[k, disc] for k in steps) / (2 * step) / truth["omega"]
            self.pairs.append((true, float(row["spin"]) / omega))

    def slope(self, minimum=0.0, maximum=1e9):
        """Slope of estimate against truth, through zero."""
        part = [pair for pair in self.pairs if minimum <= abs(pair[0]) < maximum]
        return sum(p[0] * p[1] for p in part) / max(sum(p[0] ** 2 for p in part), 1e-300)

    def rms(self):
        return math.sqrt(sum((p[1] - p[0]) ** 2 for p in self.pairs) / len(self.pairs))


class TrackTest(InFolder):
    def video(self, *more, name="video.mp4", length=1.15, of=tuple(SMALL)):
        path = self.path(name)
        done = swirl("synthetic-video", *of, "--periods", length, "--out", path, "--quiet", *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        return path

    def track(self, video, *more, name="tracks.csv"):
        out = self.path(name)
        done = swirl("track", video, "--out", out, "--verbose", *more)
        if "no camera support" in done.stderr:
            self.skipTest("this build has no camera support")
        self.assertEqual(done.returncode, 0, done.stderr)
        return out, done.stdout + done.stderr

    def standard(self):
        """The standard video next to its ground truth, which tests share."""

        def make(folder):
            os.mkdir(folder)
            self.video(name=os.path.join(folder, "video.mp4"))

        return os.path.join(self.shared("standard", make), "video.mp4")

    def standard_tracks(self):
        """The standard video and a folder with its tracks, result, report and messages, which tests
        share."""
        video = self.standard()

        def make(folder):
            os.mkdir(folder)
            _, said = self.track(
                video,
                "--json",
                os.path.join(folder, "found.json"),
                "--report",
                os.path.join(folder, "report"),
                name=os.path.join(folder, "tracks.csv"),
            )
            with open(os.path.join(folder, "said"), "w", encoding="utf-8") as file:
                file.write(said)

        return video, self.shared("tracked", make)

    def assert_rejected(self, code, *words, call):
        if "no camera support" in call.stderr:
            self.skipTest("this build has no camera support")
        self.assertEqual(call.returncode, code, call.stdout + call.stderr)
        for word in words:
            self.assertIn(word, call.stderr)
        self.assertFalse(os.path.exists(self.path("tracks.csv")))

    def assert_true_rotation(self, video, tracks, truth):
        """The rotation from the tracks equals that from the true positions."""
        with open(self.path("truth.csv"), "w", encoding="utf-8") as table:
            table.write("frame,particle,x,y\n")
            for row in rows(video[:-4] + ".truth.csv"):
                table.write(f"{row['frame']},{row['particle']},{row['x_ideal']},{row['y_ideal']}\n")
        of_truth = swirl(
            "measure",
            self.path("truth.csv"),
            "--camera-fps",
            1,
            "--scale",
            truth["scale"],
            "--omega",
            truth["omega"],
            "--centre",
            "%r,%r" % tuple(truth["centre"]),
            "--phase",
            truth["phase"],
            "--amplitude",
            truth["amplitude"] / truth["scale"],
            "--container-radius",
            truth["container_radius"] / truth["scale"],
            "--json",
            "-",
        )
        of_video = swirl(
            "measure", tracks, "--json", "-"
        )  # the calibration next to the tracks is used
        values = []
        for done in (of_truth, of_video):
            self.assertEqual(done.returncode, 0, done.stderr)
            values.append(json.loads(done.stdout)["rotation"]["rigid_by_time"]["mean"])
        self.assertLess(abs(values[0] - values[1]), 0.02)  # of Ω, in little more than one period

    def test_tilt_is_measured_and_corrected(self):
        # 8 degrees need the correction most. Without tilt none may be found, see
        # test_rotation_from_a_video.
        for degrees in some((8, 0, 3), 1):
            with self.subTest(degrees=degrees):
                video = self.video(
                    "--tilt",
                    degrees,
                    "--tilt-towards",
                    250,
                    length=1.1,
                    of=LARGER,
                    name=f"tilt{degrees}.mp4",
                )
                tracks, said = self.track(video, name=f"tilt{degrees}.csv")
                result = Comparison(video, tracks)
                lens = result.found["lens"]
                if degrees == 0:
                    self.assertEqual(lens["tilt"], 0.0)
                    self.assertIn("no tilt found, below", said)
                else:
                    self.assertLess(abs(lens["tilt"] - degrees), 3.0 * lens["tilt_error"])
                    self.assertLess(lens["tilt_error"], 0.6)
                    self.assertLess(
                        abs(lens["tilt_towards"] - 250.0), 3.0 * lens["tilt_towards_error"]
                    )
                # As accurate as from above.
                self.assertEqual(result.complete, 1.0)
                self.assertLess(result.rms, 0.2)
                self.assertLess(result.centre, 0.2)
                self.assertLess(abs(result.amplitude), 0.3)
                self.assertLess(abs(result.omega), 5e-4)
                self.assert_true_rotation(video, tracks, result.truth)
        # A given tilt is used, and none with --tilt 0. (Without a correction, the limits above
        # fail, too.)
        video = self.path("tilt8.mp4")
        given, _ = self.track(video, "--tilt", "8,250", "--quiet", name="given.csv")
        self.assertLess(Comparison(video, given).rms, 0.2)
        if ALL:
            none, _ = self.track(video, "--tilt", 0, "--quiet", name="none.csv")
            self.assertGreater(Comparison(video, none).rms, 0.5)

    def test_rotation_from_a_video(self):
        video, folder = self.standard_tracks()
        with open(os.path.join(folder, "said"), encoding="utf-8") as file:
            self.assertIn("20 discs", file.read())
        with open(os.path.join(folder, "report/report.html"), encoding="utf-8") as file:
            report = file.read()
        for part in (
            "Results",
            "20, bright",
            "frames with all discs",
            "Over time",
            "counter-clockwise",
            "data:image/png;base64,",
            "swirl track",
        ):
            self.assertIn(part, report)
        for row in rows(os.path.join(folder, "report/frames.csv")):
            self.assertLessEqual(int(row["seen"]) + int(row["filled"]) + int(row["missing"]), 20)
        tracks = os.path.join(folder, "tracks.csv")
        result = Comparison(video, tracks)
        self.assertEqual((result.found["discs"], result.found["discs_are"]), (20, "bright"))
        self.assertEqual(result.found["quality"]["possible_swaps"], [])
        self.assertFalse(result.found["path"]["clockwise"])
        self.assertEqual(result.found["lens"]["tilt"], 0.0)
        self.assertGreater(result.complete, 0.95)
        self.assertEqual(result.swaps, 0)
        self.assertLess(result.rms, 0.4)  # a thirtieth of a radius
        self.assertLess(abs(result.omega), 5e-4)
        self.assertLess(result.centre, 0.3)
        self.assertLess(abs(result.amplitude), 0.3)
        self.assertLess(abs(result.radius), 0.04)
        self.assert_true_rotation(video, tracks, result.truth)

    def test_each_fault_of_a_camera_changes_the_images_and_not_the_ground_truth(self):
        def made(*more):
            video = self.video("--frame-count", 3, "--overwrite", *more)
            with open(video, "rb") as images, open(video[:-4] + ".truth.csv", "rb") as truth:
                return images.read(), truth.read()

        images, truth = made()
        self.assertEqual(made(), (images, truth))
        for option in (
            ("--rolling-shutter", 0.5),
            ("--interlaced",),
            ("--auto-exposure", 0.3),
            ("--hand-time", 0.02),
            ("--floor-pattern", 40),
            ("--disc-variation", 0.2),
            ("--transparency", 0.5),
            ("--flat",),
        ):
            with self.subTest(option):
                changed = made(*option)
                self.assertEqual(changed[1], truth)
                self.assertNotEqual(changed[0], images)
        for option, value in (
            ("--rolling-shutter", 2),
            ("--transparency", -0.1),
            ("--hand-time", 100),
        ):
            done = swirl("synthetic-video", option, value, "--out", self.path("wrong.mp4"))
            self.assertEqual(done.returncode, 2)
            self.assertIn(option, done.stderr)

    def test_interlaced_video_is_tracked_at_the_time_of_its_first_fields(self):
        # Each frame has the even rows of one frame of a faster video, and the odd rows of the next.
        fast = list(SMALL)
        fast[fast.index("--frames-per-period") + 1] = 128
        made = self.video(of=fast)
        faster = positions(made[:-4] + ".truth.csv", "x_ideal", "y_ideal")
        about = dict(Truth(made).about)
        about["omega"] *= 2.0  # per frame of the interlaced video
        for first, rows_ in some((("top", "odd"), ("bottom", "even")), 1):
            with self.subTest(first=first):
                video = self.path(first + ".mp4")
                subprocess.run(
                    [
                        "ffmpeg",
                        "-v",
                        "error",
                        "-i",
                        made,
                        "-vf",
                        f"tinterlace=interleave_{first}",
                        "-crf",
                        "14",
                        video,
                    ],
                    check=True,
                )
                tracks, said = self.track(video, name=first + ".csv")
                self.assertIn(f"the video is interlaced: the {rows_} rows", said)
                score = Score(
                    {k // 2: discs for k, discs in faster.items() if k % 2 == 0},
                    positions(tracks),
                    about,
                )
                self.assertGreater(score.complete, 0.95)
                self.assertEqual(score.swaps, 0)
                # The limit of test_rotation_from_a_video. The fields are 1.1 pixels apart.
                self.assertLess(score.rms, 0.4)

    def test_hdf5_and_csv_tracks_give_equal_results(self):
        video, folder = self.standard_tracks()
        recording = self.path("same.h5")
        with open(recording, "w", encoding="utf-8") as file:
            file.write("another file")
        again = swirl("track", video, "--out", recording)
        self.assertEqual(again.returncode, 1, again.stdout)
        self.assertRegex(again.stderr, "already exists.*\nhint: .*--overwrite")
        self.track(video, "--quiet", "--overwrite", name="same.h5")
        results = []
        for tracks in (os.path.join(folder, "tracks.csv"), recording):
            done = swirl(
                "measure", tracks, "--measure", "density,temperature,pinned", "--json", "-"
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            results.append(
                {key: value for key, value in json.loads(done.stdout).items() if key != "file"}
            )
        self.assertEqual(*results)
        self.assert_rejected(
            2,
            "must end with .csv or .h5",
            call=swirl("track", video, "--out", self.path("tracks.txt")),
        )
        os.truncate(recording, os.path.getsize(recording) // 2)
        self.assertEqual(swirl("measure", recording).returncode, 1)

    def test_spins_match_the_ground_truth(self):
        video = self.video(
            of=[
                "--discs",
                20,
                "--container-radius",
                6.5,
                "--scale",
                16,
                "--width",
                300,
                "--height",
                300,
                "--frames-per-period",
                64,
                "--noise",
                2,
                "--quality",
                0,
                "--seed",
                3,
            ],
            length=1.1,
        )
        tracks, _ = self.track(video, "--spin")
        spins = SpinComparison(video, tracks)
        self.assertGreater(len(spins.pairs), 800)
        # With discs of 16 pixels, registration errs by less than 5 %.
        self.assertLess(abs(spins.slope() - 1.0), 0.05)
        self.assertLess(spins.rms(), 0.1)
        # `swirl measure` uses them: discs at the wall spin, but slower than 1.5 Ω.
        done = swirl("measure", tracks, "--measure", "frustration", "--json", "-")
        self.assertEqual(done.returncode, 0, done.stderr)
        wall = json.loads(done.stdout)["measured"]["frustration"]["wall_spin"]["mean"]
        self.assertGreater(wall, 0.05)
        self.assertLess(wall, 1.5)

    def test_low_contrast_video_needs_the_appearance_template(self):
        # Low contrast, noise, blur and compression.
        video = self.video(of=["--camera", "bad", "--discs", 28, "--quality", 26], length=1.5)
        tracks, _ = self.track(video)
        result = Comparison(video, tracks)
        self.assertEqual(result.found["discs"], 28)
        self.assertGreaterEqual(result.complete, 0.9)
        self.assertLessEqual(result.swaps, 2)
        self.assertLess(result.rms, 0.65)  # pixels; 0.96 without the template

    def mean_shift(self, video, tracks):
        """Mean of tracked minus true positions, each near half a radius."""
        true, found = positions(video[:-4] + ".truth.csv", "x_ideal", "y_ideal"), positions(tracks)
        shifts = []
        for frame, discs in true.items():
            for x, y in discs.values():
                u, v = min(
                    found[frame].values(), key=lambda p, x=x, y=y: math.hypot(p[0] - x, p[1] - y)
                )
                if math.hypot(u - x, v - y) < 8.0:
                    shifts.append((u - x, v - y))
        return [sum(s[k] for s in shifts) / len(shifts) for k in (0, 1)]

    @slow("four periods; wall_bounces_test.cpp has the shift towards the light")
    def test_light_from_one_side_does_not_shift_discs(self):
        # Four periods. In two, the error of the shift is a half of it.
        video = self.video(
            "--light-from",
            135,
            "--light-elevation",
            45,
            "--light-share",
            0.8,
            "--gloss",
            60,
            of=LARGER,
            length=4,
        )
        tracks, said = self.track(video)
        self.assertIn("from one side; shifts discs by", said)
        result = Comparison(video, tracks)
        self.assertEqual(result.found["discs"], 20)
        light = result.found["light"]
        # The shift is towards the light, up and left in the image.
        self.assertLess(light["shift"][0], 0.0)
        self.assertLess(light["shift"][1], 0.0)
        # At least half of the shift is removed. The rest is within four of the reported standard
        # errors.
        left = math.hypot(*self.mean_shift(video, tracks))
        self.assertLess(left, 0.5 * math.hypot(*light["shift"]))
        self.assertLess(left, 4.0 * light["shift_error"])
        # What remains of the shift is in the claimed error; the range is that of all scored videos.
        claimed = result.found["quality"]["position_error"] / result.rms
        self.assertGreater(claimed, 0.7)
        self.assertLess(claimed, 1.5)
        # The container is as large as with light from above.
        self.assertLess(
            abs(result.found["container"]["radius"] / result.truth["container_radius"] - 1.0), 0.01
        )

    @slow("shading_detection_test.cpp has balls of this contrast; a bad video is tracked above")
    def test_low_contrast_with_strong_compression_gives_no_tiny_discs(self):
        # Contrast 1.3:1. Compression leaves texture of 4 pixels, which once gave 211 discs.
        video = self.video(
            of=[
                "--discs",
                28,
                "--width",
                640,
                "--height",
                480,
                "--scale",
                15,
                "--frames-per-period",
                64,
                "--floor-level",
                100,
                "--contrast",
                1.3,
                "--rim-level",
                110,
                "--gloss",
                10,
                "--texture",
                0.2,
                "--light-elevation",
                45,
                "--noise",
                3,
                "--quality",
                29,
            ],
            length=1.1,
        )
        # Edges do not show these balls, but their shading does.
        for percent in re.findall(r"([0-9.]+) %", self.track(video)[1]):
            self.assertLessEqual(float(percent), 100.0)
        result = Comparison(video, self.path("tracks.csv"))
        self.assertEqual(result.found["discs"], 28)
        self.assertGreater(result.complete, 0.9)
        self.assertLess(result.rms, 2.0)  # 2.9 by edges and with a given number
        self.assertLess(abs(result.radius), 0.1)
        if not ALL:
            return
        # With their number, the size is found from the contact distance.
        done = swirl("track", video, "--out", self.path("tracks.csv"), "--discs", 28, "--overwrite")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = calibration(self.path("tracks.csv"))
        # Fewer contacts than in a longer video, and outlines that err by the shading: within 8 %.
        self.assertLess(abs(found["species"][0]["radius"] / 15.0 - 1.0), 0.08)

    @slow("tilt_test.cpp has the rolling shutter, with and without a tilt")
    def test_rolling_shutter_is_measured_and_removed(self):
        # 32 frames per period: discs move by up to 2 pixels while the frame is read.
        of = list(LARGER)
        of[of.index("--frames-per-period") + 1] = 32
        for readout, seed in some(((0.8, 3), (0.4, 5)), 1):
            with self.subTest(readout=readout):
                video = self.video(
                    "--rolling-shutter", readout, of=[*of[:-1], seed], length=2, name=f"{seed}.mp4"
                )
                tracks, said = self.track(video, name=f"{seed}.csv")
                self.assertRegex(
                    said, r"reads a frame in 0\.\d+ ± 0\.\d+ of a frame interval; corrected"
                )
                result = Comparison(video, tracks)
                lens = result.found["lens"]
                self.assertLess(abs(lens["readout"] - readout), 4.0 * lens["readout_error"])
                self.assertLess(lens["readout_error"], 0.05)
                self.assertEqual((result.complete, result.swaps, lens["tilt"]), (1.0, 0, 0.0))
                self.assertLess(result.rms, 0.4)  # pixels, the limit of test_rotation_from_a_video
                self.assertLess(
                    abs(
                        result.found["container"]["radius"] / result.truth["container_radius"] - 1.0
                    ),
                    0.01,
                )
                self.assert_true_rotation(video, tracks, result.truth)

    @slow("a video of the size of a phone's; floor_pattern_test.cpp has the pattern alone")
    def test_pattern_of_the_floor_is_removed(self):
        # As a student's video: 15 frames per period; two periods show all of the floor.
        video = self.video(
            "--floor-pattern",
            60,
            "--disc-variation",
            0.25,
            length=2,
            of=["--camera", "student", "--discs", 28, "--seed", 4, "--quality", 23],
        )
        tracks, printed = self.track(video)
        self.assertIn("the floor of the container has a pattern", printed)
        result = Comparison(video, tracks)
        self.assertEqual((result.found["discs"], result.swaps), (28, 0))
        self.assertGreater(result.complete, 0.9)
        self.assertLess(result.rms, 1.0)  # pixels, a twentieth of a radius; 0.66 measured
        self.assertLess(abs(result.radius), 0.03)
        self.assertLess(
            abs(result.found["container"]["radius"] / result.truth["container_radius"] - 1.0), 0.02
        )
        # A number that the frames contradict is rejected.
        rejected = swirl("track", video, "--discs", 40, "--out", self.path("none.csv"))
        self.assertEqual(rejected.returncode, 1, rejected.stderr)
        self.assertRegex(
            rejected.stderr, r"--discs is 40, but (the video shows|most frames show) \d+"
        )
        self.assertFalse(os.path.exists(self.path("none.csv")))

    def test_a_number_that_the_video_contradicts_is_rejected_with_both(self):
        video = self.standard()
        for given in some((40, 9), 1):
            self.assert_rejected(
                1,
                f"--discs is {given}",
                "20",
                call=swirl("track", video, "--discs", given, "--out", self.path("tracks.csv")),
            )

    def test_shade_of_steel_balls_is_no_lens(self):
        # Their circles are 2 % too large, and their sizes imply k = -0.013 ± 0.004. With that lens
        # the error was 0.48 pixels, and by edges alone 0.26.
        video = self.video(
            *["--disc-level", 60, "--floor-level", 200, "--gloss", 200, "--texture", 0.1],
            of=["--camera", "student", "--discs", 28, "--seed", 4, "--quality", 23],
            length=2,
        )
        tracks, _ = self.track(video)
        score = Comparison(video, tracks)
        self.assertEqual(score.found["lens"]["distortion"], 0.0)
        self.assertEqual(score.swaps, 0)
        self.assertLess(score.rms, 0.15)
        claimed = score.found["quality"]["position_error"] / score.rms
        self.assertTrue(0.6 < claimed < 1.6, claimed)

    def test_discs_outside_the_frame_are_not_overlooked(self):
        # Cut by 30 pixels, the container is whole in a part of each period; by 90, never. Then 19
        # of 20 discs are found.
        whole = self.standard()

        def cut(width):
            subprocess.run(
                [
                    "ffmpeg",
                    "-v",
                    "error",
                    "-i",
                    whole,
                    "-vf",
                    f"crop={width}:240:0:0",
                    "-qp",
                    "14",
                    self.path(f"{width}.mp4"),
                ],
                check=True,
            )
            return self.path(f"{width}.mp4")

        tracks, said = self.track(cut(210), name="210.csv")
        self.assertEqual(calibration(tracks)["discs"], 20)
        self.assertIn("not entirely in the frame", said)
        cut(150)
        for given in ([], ["--discs", 20]):
            self.assert_rejected(
                1,
                "others may be outside the frame",
                "of the container's rim lies outside",
                call=swirl("track", self.path("150.mp4"), "--out", self.path("tracks.csv"), *given),
            )

    @slow("a video of the size of a phone's; link_test.cpp has discs that a hand hides")
    def test_possible_identity_swaps_are_named(self):
        # A hand covers discs at the beginning. What swaps is named with its frame; without a hand,
        # nothing is.
        student = ["--camera", "student", "--discs", 28, "--quality", 23]
        for seed in some((4, 5, 6), 1):
            video = self.video(
                "--hand-time", 0.7, "--seed", seed, of=student, length=2, name=f"hand{seed}.mp4"
            )
            tracks, said = self.track(video, name=f"hand{seed}.csv")
            score = Comparison(video, tracks)
            possible = score.found["quality"]["possible_swaps"]
            for frame, *discs in score.swapped:
                # Links go to both ends of the video, so a swap is in one of the frames next to a
                # gap of up to three.
                self.assertTrue(
                    any(
                        set(discs) & set(swap["discs"]) and abs(swap["frame"] - frame) <= 4
                        for swap in possible
                    ),
                    (seed, frame, discs),
                )
            self.assertLessEqual(len(possible), 10)
            self.assertIn(
                "{} and {} in frame {}".format(*possible[0]["discs"], possible[0]["frame"]), said
            )

    def test_discs_that_fly_fast_are_tracked_where_they_bounce(self):
        # At up to four times the container's speed, 15 frames per period. A bounce is no outlier,
        # and no disc is on the floor where it would be without one.
        video = self.video(
            "--discs",
            3,
            "--scale",
            12,
            "--width",
            280,
            "--height",
            280,
            "--frames-per-period",
            15,
            "--noise",
            2,
            "--quality",
            14,
            "--seed",
            4,
            of=[],
            length=2,
        )
        tracks, said = self.track(video)
        score = Comparison(video, tracks)
        # No contacts between discs show the radius; free flights show the error.
        self.assertIn("discs touch each other too seldom to confirm their radius", said)
        claimed = score.found["quality"]["position_error"] / score.rms
        self.assertTrue(0.7 < claimed < 1.5, claimed)
        self.assertEqual((score.found["discs"], score.swaps), (3, 0))
        self.assertGreater(score.complete, 0.95)  # 0.80 without bounces
        self.assertLess(score.rms, 0.4)  # pixels, the limit of test_rotation_from_a_video

    def test_a_container_moved_by_hand(self):
        # At rest at first, then with a speed that varies by a fourth, and a stop in the middle.
        video = self.video("--rest", 0.7, "--pause", 0.6, "--speed-variation", 0.25, length=4.3)
        tracks, said = self.track(video)
        self.assertRegex(said, r"moves unevenly: its period changes from \d\.\d+ to \d\.\d+ s")
        self.assertRegex(said, r"rests in frames 0 to \d+, \d+ to \d+, which are not measured")
        score = Comparison(video, tracks)
        self.assertEqual((score.found["discs"], score.swaps), (20, 0))
        self.assertTrue(score.found["times_by_phase"])
        self.assert_true_phase(video, tracks, score)
        done = swirl("measure", tracks, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)

    @slow(
        "two videos of 300 frames; a container that rests twice is in "
        "test_a_container_moved_by_hand"
    )
    def test_a_container_that_rests_in_most_frames(self):
        # 15 frames per period, of which one in three shows the container moving.
        few = list(SMALL)
        few[few.index("--frames-per-period") + 1] = 15
        rests = ["--rest", 4, "--pause", 3.4, "--speed-variation", 0.25]
        video = self.video(*rests, of=few, length=12.4)
        tracks, said = self.track(video, name="moving.csv")
        self.assertIn("which are not measured", said)
        self.assertNotIn("the video shows", said)
        score = Comparison(video, tracks)
        self.assertEqual((score.found["discs"], score.swaps), (20, 0))
        self.assertGreater(score.complete, 0.95)
        self.assertLess(
            score.rms, 0.6
        )  # pixels, a twentieth of a radius; 0.45 measured, 0.40 claimed
        # One in five is too few, also to learn the floor: discs at rest look like its pattern.
        video = self.video(*rests, of=few, length=9.4, name="floor.mp4")
        self.assert_rejected(
            1,
            "the frames contradict that",
            "hint: ",
            call=swirl("track", video, "--out", self.path("none.csv")),
        )
        self.assertFalse(os.path.exists(self.path("none.csv")))

    def test_dark_and_bright_discs_are_tracked_together(self):
        video = self.video(
            "--disc-level", 40, "--other-level", 215, "--floor-level", 125, "--gloss", 0, of=LARGER
        )
        tracks, said = self.track(video)
        self.assertNotIn("not tracked", said)
        score = Comparison(video, tracks)
        self.assertEqual(
            (score.found["discs"], score.found["discs_are"], score.swaps),
            (20, "dark and bright", 0),
        )
        self.assertGreater(score.complete, 0.9)
        self.assertLess(
            score.rms, 0.8
        )  # pixels, a twentieth of a radius; 0.58 measured: light shifts them apart
        self.assertLess(abs(score.radius), 0.02)

    def assert_true_phase(self, video, tracks, score):
        """The phase in each frame is that of the true container."""
        truth, path = score.truth, score.found["path"]
        times = {int(row["frame"]): float(row["time"]) for row in rows(tracks)}
        start, worst = math.radians(path["phase"]), 0.0
        for row in rows(video[:-4] + ".container.csv"):
            frame = int(row["frame"])
            x = float(row["x_ideal"]) - truth["centre"][0]
            y = truth["centre"][1] - float(row["y_ideal"])
            found = start + path["omega"] * (times[frame] - times[min(times)])
            worst = max(worst, abs(math.remainder(math.atan2(y, x) - found, 2.0 * math.pi)))
        # The rim is known to 0.1 pixels, and the amplitude is 23 pixels; the error of one frame of
        # 275 may be four standard deviations, 0.02 rad. The phase changes by 0.1 rad per frame.
        self.assertLess(worst, 0.03)

    def test_a_phantom_is_named_with_its_frame(self):
        # A circle next to disc 0, which is no disc. No option was given, so none is wrong.
        tracks = os.path.join(self.standard_tracks()[1], "tracks.csv")
        with open(tracks, encoding="utf-8") as file:
            lines = file.read().splitlines()
        columns = lines[0].split(",")
        for row in [dict(zip(columns, line.split(","))) for line in lines[1:]]:
            if row["particle"] == "0":
                row.update(particle="20", x=str(float(row["x"]) + 9.0))
                lines.append(",".join(row[name] for name in columns))
        with open(tracks, "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")
        call = swirl("measure", tracks)
        self.assertEqual(call.returncode, 1, call.stderr)
        self.assertIn("discs 0 and 20 in frame", call.stderr)
        self.assertNotIn("--scale", call.stderr)

    def test_pixels_that_are_not_square(self):
        # Frames of three quarters of the width, as camcorders record them; the file gives the
        # ratio.
        video = self.video(of=LARGER)
        anamorphic = self.path("anamorphic.mp4")
        subprocess.run(
            [
                "ffmpeg",
                "-v",
                "error",
                "-i",
                video,
                "-vf",
                "scale=256:340,setsar=85/64",
                "-qp",
                "10",
                anamorphic,
            ],
            check=True,
        )
        tracks, _ = self.track(anamorphic)
        found, truth = calibration(tracks), Truth(video).about
        self.assertEqual((found["size"], found["discs"]), ([340, 340], 20))
        self.assertLess(abs(found["container"]["radius"] / truth["container_radius"] - 1.0), 0.01)
        score = Score(
            positions(video[:-4] + ".truth.csv", "x_ideal", "y_ideal"), positions(tracks), truth
        )
        self.assertLess(score.rms, 0.3)  # pixels; 0.1 for square pixels

    def test_a_killed_ffmpeg_is_an_error(self):
        video, folder = self.standard(), self.path("bin")
        os.mkdir(folder)
        # ffmpeg ends in the middle of the frames: killed, or after a signal that it handles.
        for end in some(("kill -KILL $$", "exit 255"), 1):
            with open(os.path.join(folder, "ffmpeg"), "w", encoding="utf-8") as script:
                script.write(
                    f"""#!/bin/sh
case "$*" in *image2pipe*) '{shutil.which("ffmpeg")}' "$@" | head -c 3000000; {end} ;; esac
exec '{shutil.which("ffmpeg")}' "$@"
"""
                )
            os.chmod(os.path.join(folder, "ffmpeg"), 0o755)
            path = folder + os.pathsep + os.environ["PATH"]
            self.assert_rejected(
                1,
                "before the end of",
                call=swirl(
                    "track", video, "--out", self.path("tracks.csv"), environment={"PATH": path}
                ),
            )

    @slow("six videos of two periods; the wall of most other tests is reached in every frame")
    def test_container_radius_with_few_discs(self):
        # Four discs bounce off the wall about three times per period. With fewer contacts, the
        # program uses the rim.
        for discs in (4, 8, 12, 16, 24, 36):
            video = self.video(
                of=[
                    "--discs",
                    discs,
                    "--width",
                    400,
                    "--height",
                    400,
                    "--scale",
                    15,
                    "--frames-per-period",
                    60,
                    "--quality",
                    18,
                    "--start",
                    25,
                ],
                length=2,
                name=f"of{discs}.mp4",
            )
            tracks, _ = self.track(video, name=f"of{discs}.csv")
            result = Comparison(video, tracks)
            radius = result.found["container"]["radius"] / result.truth["container_radius"]
            self.assertLess(abs(radius - 1.0), 0.005, discs)

    def test_mirrored_video_with_dark_discs(self):
        video = self.video(
            "--mirrored",
            "--disc-level",
            60,
            "--floor-level",
            200,
            "--rim-level",
            90,
            "--table-level",
            150,
            "--gloss",
            120,
            "--texture",
            0.1,
        )
        tracks, said = self.track(video)
        result = Comparison(video, tracks)
        self.assertTrue(result.found["path"]["clockwise"])
        self.assertEqual(result.found["discs_are"], "dark")
        self.assertEqual(result.found["discs"], 20)
        self.assertIn("clockwise in the image", said)
        self.assertLess(result.rms, 0.4)
        self.assertLess(
            abs((result.found["path"]["phase"] - result.truth["phase"] + 180) % 360 - 180), 1.0
        )

    @slow("a video of its own for a special case, which ends in a warning")
    def test_radius_comes_from_the_rim_if_discs_are_rarely_at_the_wall(self):
        video = self.video(of=["--discs", 2, *LARGER[2:]])
        tracks, said = self.track(video)
        self.assertIn("at the wall too seldom", said)
        self.assertNotIn("the smaller radius is used", said)
        result = Comparison(video, tracks)
        # Within the width of the drawn wall; in most frames the discs stay farther inside.
        self.assertLess(
            abs(result.found["container"]["radius"] / result.truth["container_radius"] - 1.0), 0.06
        )

    def test_coarse_polygonal_paths_are_reported(self):
        three = self.video("--sides", 3, name="three.mp4")
        self.assert_rejected(
            1, "few sides", call=swirl("track", three, "--out", self.path("tracks.csv"))
        )
        _, said = self.track(self.video("--sides", 4))
        self.assertIn("as on a polygon of few sides", said)

    def test_amplitude_error_includes_that_of_the_lens(self):
        video = self.video("--distortion", 0.06, "--seed", 5, of=LARGER[:-2])
        result = Comparison(video, self.track(video)[0])
        # Mean distance of the sides of a 30-gon with its vertices at A, to order (pi/30)^4.
        true = result.truth["amplitude"] * (1.0 - (math.pi / 30) ** 2 / 3.0)
        path = result.found["path"]
        self.assertLess(abs(path["amplitude"] - true), 3.0 * path["amplitude_error"])
        # The claimed error is small.
        self.assertLess(path["amplitude_error"], 0.01 * true)

    def test_numbered_images_give_the_same_tracks_as_the_video(self):
        video, folder = self.standard_tracks()
        os.makedirs(self.path("seen"))
        subprocess.run(
            [
                "ffmpeg",
                "-v",
                "error",
                "-i",
                video,
                "-pix_fmt",
                "gray",
                "-start_number",
                "100",
                self.path("seen/%05d.png"),
            ],
            check=True,
        )
        of_images, _ = self.track(
            self.path("seen/%05d.png"), "--fps", 60, "--quiet", name="images.csv"
        )
        with open(os.path.join(folder, "tracks.csv"), "rb") as one, open(of_images, "rb") as other:
            self.assertTrue(one.read() == other.read())

    def test_unusable_videos_are_rejected_with_the_cause(self):
        still = self.video("--camera-on-container", name="still.mp4", length=0.5)
        out = self.path("tracks.csv")
        self.assert_rejected(1, "stands still", call=swirl("track", still, "--out", out))
        empty = self.path("empty.mp4")
        subprocess.run(
            [
                "ffmpeg",
                "-v",
                "error",
                "-f",
                "lavfi",
                "-i",
                "nullsrc=s=240x240:r=30:d=2,geq=lum='100+30*random(1)':cb=128:cr=128",
                empty,
            ],
            check=True,
        )
        self.assert_rejected(1, "no dish was found", call=swirl("track", empty, "--out", out))
        whole, partly = self.video(
            of=[*SMALL[:11], 32, *SMALL[12:]], name="whole.mp4", length=1.2
        ), self.path("part.mp4")
        subprocess.run(
            [
                "ffmpeg",
                "-v",
                "error",
                "-i",
                whole,
                "-vf",
                "crop=130:240:110:0",
                "-qp",
                "14",
                partly,
            ],
            check=True,
        )
        self.assert_rejected(
            1,
            "of the container's rim lies outside the frame",
            call=swirl("track", partly, "--out", out),
        )
        with open(still, "rb") as file:
            part = file.read()[:20000]
        for name, content in (
            ("cut.mp4", part[:-2000] if b"moov" not in part else part[:30]),
            ("text.mp4", b"this is no video"),
        ):
            with open(self.path(name), "wb") as file:
                file.write(content)
            self.assert_rejected(
                1, "no readable frames", call=swirl("track", self.path(name), "--out", out)
            )
        self.assert_rejected(
            1, "there is no video", call=swirl("track", self.path("none.mp4"), "--out", out)
        )
        self.assert_rejected(
            1, "no frames named", call=swirl("track", self.path("no%05d.png"), "--out", out)
        )

    def test_a_camera_or_a_stream_must_be_recorded_first(self):
        os.mkfifo(self.path("pipe"))
        for source in (
            "/dev/video0",
            "/dev/video77",
            "/dev/zero",
            "-",
            "/dev/stdin",
            "rtsp://camera/a%20b",
            "https://example.org/dish.mp4",
            self.path("pipe"),
        ):
            with self.subTest(source):
                self.assert_rejected(
                    2,
                    "must be a file",
                    "hint: record it first",
                    call=swirl("track", source, "--out", self.path("tracks.csv")),
                )
        self.assert_rejected(
            2,
            "is a folder",
            "%05d.png",
            call=swirl("track", self.path("."), "--out", self.path("tracks.csv")),
        )
        self.assert_rejected(
            2,
            "there is no option --live",
            call=swirl("track", "--live", "/dev/video0", "--out", self.path("tracks.csv")),
        )

    def test_errors_of_a_damaged_video_are_reported_with_quiet(self):
        with open(self.video(length=0.8), "rb") as file:
            data = bytearray(file.read())
        for k in range(len(data) // 2, len(data) // 2 + 3000):  # frames in the middle
            data[k] = (73 * k) % 256
        with open(self.path("damaged.mp4"), "wb") as file:
            file.write(data)
        done = swirl(
            "track",
            self.path("damaged.mp4"),
            "--out",
            self.path("tracks.csv"),
            "--last-frame",
            48,
            "--quiet",
        )
        if "no camera support" in done.stderr:
            self.skipTest("this build has no camera support")
        self.assertEqual(done.stdout, "")
        self.assertIn("ffmpeg reports", done.stderr)

    def track_changed(self, video, name, *arguments, of_input=()):
        subprocess.run(
            ["ffmpeg", "-v", "error", *of_input, "-i", video, *arguments, self.path(name)],
            check=True,
        )
        return self.track(self.path(name), name=name[:-4] + ".csv")

    def test_the_rotation_flag_of_a_video_is_applied(self):
        help_text = subprocess.run(
            ["ffmpeg", "-hide_banner", "-h", "full"], capture_output=True, text=True
        ).stdout
        if "-display_rotation" in help_text:  # from ffmpeg 6 on, instead of the metadata
            turn = dict(of_input=["-display_rotation:v:0", "90"])
            metadata = []
        else:
            turn = {}
            metadata = ["-metadata:s:v:0", "rotate=90"]
        tracks, _ = self.track_changed(
            self.standard(), "turned.mp4", "-c", "copy", *metadata, **turn
        )
        found = calibration(tracks)
        self.assertEqual(found["discs"], 20)
        self.assertLess(abs((found["path"]["phase"] - 90.0 + 180.0) % 360.0 - 180.0), 1.0)

    @slow(
        "four more videos; each fault ends in a warning, so a defect here gives no wrong numbers "
        "silently"
    )
    def test_typical_faults_of_phone_videos(self):
        video = self.standard()

        def changed(name, *arguments):
            return self.track_changed(video, name, *arguments)

        _, said = changed("two.mp4", "-vf", "split[a][b];[a][b]hstack", "-qp", "14")
        self.assertIn("second circle of the container's size", said)
        tracks, said = changed(
            "hand.mp4",
            "-vf",
            "drawbox=x=0:y=0:w=110:h=240:color=0x9a8070:t=fill:enable='between(n,25,40)'",
            "-qp",
            "14",
        )
        self.assertIn("perhaps a hand", said)
        after = positions(tracks)
        for frame in range(48, 70):
            self.assertEqual(len(after[frame]), 20, frame)  # all discs are found again
        self.assertNotIn("leaves these frames out", said)
        for enable, option in (("lt(n,7)", "--first-frame 7"), ("gt(n,66)", "--last-frame 66")):
            _, said = changed(
                option[2:4] + ".mp4",
                "-vf",
                f"drawbox=x=130:y=0:w=110:h=240:color=0x9a8070:t=fill:enable='{enable}'",
                "-qp",
                "14",
            )
            self.assertIn(
                f"perhaps a hand; a disc may have different IDs before and after; {option} leaves",
                said,
            )
        tracks, said = changed(
            "uneven.mp4", "-vf", "select='not(mod(n,7))+mod(n,2)'", "-vsync", "vfr", "-qp", "14"
        )
        self.assertIn("frame rate varies", said)
        done = swirl("measure", tracks, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        # The period is too short for an error, and no warning is about the steps of time.
        self.assertRegex(done.stderr, r"\Awarning: errors are n/a, because 1\.1 periods .*\n\Z")

    def with_times(self, video, name, times):
        """The same frames with other times: an expression of N, in frames."""
        subprocess.run(
            [
                "ffmpeg",
                "-v",
                "error",
                "-i",
                video,
                "-vf",
                f"setpts='({times})/60/TB'",
                "-fps_mode",
                "passthrough",
                "-enc_time_base",
                "1/600",
                "-c:v",
                "libx264",
                "-bf",
                "0",
                "-qp",
                "10",
                self.path(name),
            ],
            check=True,
        )
        return self.path(name)

    def test_frames_that_share_a_time(self):
        video = self.standard()
        # Frame 40 has the time of frame 39, or the other way round; three frames have one time.
        for name, times, untimed in some(
            (
                ("late.mkv", "if(eq(N,40),39,N)", {39, 40}),
                ("early.mkv", "if(eq(N,39),40,N)", {39, 40}),
                ("three.mkv", "if(between(N,39,41),39,N)", {39, 40, 41}),
            ),
            1,
        ):
            with self.subTest(times=times):
                tracks, said = self.track(
                    self.with_times(video, name, times), name=name[:-4] + ".csv"
                )
                self.assertIn(f"{len(untimed)} of the 74 frames", said)
                self.assertIn("the first at frame 39", said)
                self.assertNotIn("damaged", said)
                found = calibration(tracks)
                truth = Truth(video).about
                # 60 frames per second, as the other frames have it.
                omega = found["path"]["omega"] / 60.0 / truth["omega"]
                self.assertLess(abs(omega - 1.0), 1e-3)
                seen = positions(tracks)
                self.assertEqual(set(range(74)) - set(seen), untimed)  # filled in, not seen
                true = positions(video[:-4] + ".truth.csv", "x_ideal", "y_ideal")
                score = Score({k: true[k] for k in seen}, seen, truth)
                self.assertEqual(score.complete, 1.0)
                self.assertEqual(score.swaps, 0)
                self.assertLess(score.rms, 0.4)  # as with correct times
        if not ALL:
            return
        # All frames are used where their spacing is given.
        tracks, said = self.track(self.path("late.mkv"), "--fps", 60, name="given.csv")
        self.assertNotIn("no valid time", said)
        self.assertEqual(set(positions(tracks)), set(range(74)))

    def test_times_that_cannot_be_right_are_rejected(self):
        video = self.standard()
        out = self.path("tracks.csv")
        # An hour passes between two frames; every other frame shares its time.
        for name, times, word in some(
            (
                ("period.mkv", "if(gte(N,40),N+47,N)", "half a period"),
                ("pause.mkv", "if(gte(N,40),N+216000,N)", "3.6e+03 s pass"),
                ("half.mkv", "2*floor(N/2)", "do not ascend"),
            ),
            1,
        ):
            with self.subTest(times=times):
                self.assert_rejected(
                    1,
                    word,
                    "--fps",
                    call=swirl("track", self.with_times(video, name, times), "--out", out),
                )
        if not ALL:
            return
        # A gap of 30 frames is shorter than half a period, so the video is not rejected.
        tracks, said = self.track(self.with_times(video, "gap.mkv", "if(gte(N,40),N+20,N)"))
        self.assertIn("frame rate varies", said)

    def test_invalid_options_are_rejected(self):
        for words, arguments in (
            (["--out"], []),
            ([".csv"], ["--out", self.path("x.txt")]),
            (["--fps"], ["--out", self.path("x.csv"), "--fps", -1]),
            (["--discs"], ["--out", self.path("x.csv"), "--discs", 0]),
            (["--tilt"], ["--out", self.path("x.csv"), "--tilt", "5"]),
        ):
            call = swirl("track", "video.mp4", *arguments)
            self.assert_rejected(2, *words, call=call)
        self.assert_rejected(
            2,
            "must be laboratory, phone",
            call=swirl("synthetic-video", "--camera", "x", "--out", self.path("x.mp4")),
        )
        self.assert_rejected(2, ".mp4", call=swirl("synthetic-video", "--out", self.path("x.avi")))
        self.assertEqual(self.left_behind(), [])


if __name__ == "__main__":
    main()
