"""Videos as students and laboratories make them, which score_tracking.py scores.

A student's video has 28 discs and is made by `swirl synthetic-video --camera student` (30 frames
per second, 2 periods per second, 640x480 pixels) with the options of its kind. In interlaced videos
the odd rows are half a frame interval later than the even rows. The ground truth is that of the
even rows. A video by hand starts and stops, and its speed varies by a fourth.
"""

import json
import math
import os
import subprocess

import track_test
from program import HANG, swirl

PERIOD = 15  # frames
WIDTH, HEIGHT = 640, 480  # pixels
REST, PAUSE = 4, 3.4  # periods: two seconds before the start, and a stop of 1.7 s
COMMON = ["--camera", "student", "--discs", 28, "--seed", 4, "--quality", 23]
ROUGH = ["--discs", 28, "--width", 640, "--height", 480, "--scale", 15, "--frames-per-period", 64]
LIGHT = ["--light-from", 135, "--light-elevation", 45, "--light-share", 0.8]
MIXED = ["--disc-level", 40, "--other-level", 215, "--floor-level", 125, "--gloss", 0]
LARGE = ["--width", 1920, "--height", 1080, "--scale", 44]
# Name, options of synthetic-video, what is done to the video afterwards.
KINDS = [
    ("plain", [], None),
    (
        "steel balls",
        ["--disc-level", 60, "--floor-level", 200, "--gloss", 200, "--texture", 0.1],
        None,
    ),
    ("1080p", LARGE, None),
    ("rolling shutter", ["--rolling-shutter", 0.8], None),
    ("variable frame rate", ["--frames-per-period", 4 * PERIOD], "uneven"),
    ("interlaced", ["--frames-per-period", 4 * PERIOD], "interlaced"),
    ("interlaced 1080p", ["--frames-per-period", 4 * PERIOD, *LARGE], "interlaced"),
    ("auto-exposure", ["--auto-exposure", 0.3], None),
    ("hands", ["--hand-time", 0.7], None),
    ("rotated", [], "rotated"),
    ("colour balls, patterned floor", ["--floor-pattern", 60, "--disc-variation", 0.25], None),
    ("transparent marbles", ["--transparency", 0.8, "--gloss", 180], None),
    ("coins", ["--flat", "--texture", 0.3, "--gloss", 0], None),
    ("by hand", ["--speed-variation", 0.25, "--rest", REST, "--pause", PAUSE], "by hand"),
    ("dark and bright", MIXED, None),
    ("lit balls", LIGHT, None),
    ("lit balls, dark and bright", [*MIXED, *LIGHT], None),
    ("dim wall", ["--scale", 16], None),
    ("moving shadow", ["--shadow", 60], None),
    ("pixels of 4:3", [], "anamorphic"),
    # Complete calls: other cameras and difficult set-ups.
    (
        "laboratory",
        ["--camera", "laboratory", "--discs", 36, "--frames-per-period", 128, "--periods", 1.5],
        "complete",
    ),
    ("phone", ["--camera", "phone", "--discs", 48, "--periods", 1.5, "--quality", 26], "complete"),
    ("bad", ["--camera", "bad", "--discs", 28, "--periods", 4, "--quality", 26], "complete"),
    (
        "two sizes of steel",
        [
            "--camera",
            "steel",
            "--discs",
            32,
            "--mixture",
            "10:1.35",
            "--periods",
            1.5,
            "--quality",
            24,
        ],
        "complete",
    ),
    (
        "camera tilted by 8 degrees",
        [*ROUGH, "--periods", 2, "--tilt", 8, "--tilt-towards", 250, "--quality", 14],
        "complete",
    ),
    (
        "three fast discs",
        ["--camera", "student", "--discs", 3, "--seed", 4, "--quality", 23, "--periods", 2],
        "complete",
    ),
    (
        "light from one side",
        [*ROUGH, "--periods", 6, "--quality", 14, *LIGHT, "--gloss", 60],
        "complete",
    ),
    (
        "contrast 1.3:1",
        [
            *ROUGH,
            "--periods",
            2.5,
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
        "complete",
    ),
]


def ffmpeg(*arguments):
    subprocess.run(["ffmpeg", "-v", "error", "-y", *map(str, arguments)], check=True)


class Video:
    """A video of one kind with its ground truth: {frame: {disc: (x, y)}} and the container's
    centres."""

    def __init__(self, folder, kind, periods, seed, columns=("x_ideal", "y_ideal")):
        self.name, options, after = kind
        self.columns = columns  # of the truth: with x and y, tilt and lens are not corrected
        self.seed = seed
        made = os.path.join(folder, "made.mp4")
        self.complete = after == "complete"
        if after == "by hand":  # the true ϖ is that of the same periods at an even speed
            self.make(made, [], periods)
            even = self.truth
            periods += REST + PAUSE
        self.make(made, options, periods)
        self.centres = [
            (float(row["x_ideal"]), float(row["y_ideal"]))
            for row in track_test.rows(made[:-4] + ".container.csv")
        ]
        self.path, regular = made, even if after == "by hand" else self.truth
        if after == "uneven":
            regular = self.drop_frames(folder, made)
        elif after == "interlaced":
            regular = self.interleave_fields(folder, made)
        elif after == "rotated":
            self.path = os.path.join(folder, "rotated.mp4")
            ffmpeg("-i", made, "-c", "copy", "-metadata:s:v:0", "rotate=90", self.path)
            angle = subprocess.run(
                [
                    "ffprobe",
                    "-v",
                    "error",
                    "-select_streams",
                    "v",
                    "-show_entries",
                    "stream_side_data=rotation",
                    "-of",
                    "csv=p=0",
                    self.path,
                ],
                capture_output=True,
                check=True,
                encoding="utf-8",
            ).stdout
            self.turns_left = float(angle.strip()) > 0.0
        elif after == "anamorphic":
            self.path = os.path.join(folder, "anamorphic.mp4")
            ffmpeg("-i", made, "-vf", "scale=iw*3/4:ih,setsar=4/3", "-crf", 18, self.path)
        self.varpi = rotation(folder, regular, self.about)
        if after == "rotated":
            self.turn_truth()

    def make(self, made, options, periods):
        call = [*([] if self.complete else [*COMMON, "--periods", periods]), *options]
        if self.seed is not None:
            at = call.index("--seed") if "--seed" in call else len(call)
            call[at : at + 2] = ["--seed", self.seed]
        done = swirl(
            "synthetic-video", *call, "--out", made, "--quiet", "--overwrite", timeout=HANG
        )
        if done.returncode != 0:
            raise RuntimeError(done.stderr)
        self.about = track_test.Truth(made).about
        self.truth = track_test.positions(made[:-4] + ".truth.csv", *self.columns)

    def drop_frames(self, folder, made):
        """One frame in four, at uneven times that the file gives."""
        steps = [3, 5, 4, 3, 4, 5, 4, 5, 3, 4]
        taken = [0]
        while taken[-1] + steps[len(taken) % len(steps)] < len(self.truth):
            taken.append(taken[-1] + steps[len(taken) % len(steps)])
        self.path = os.path.join(folder, "uneven.mp4")
        ffmpeg(
            "-i",
            made,
            "-vf",
            "select=" + "+".join(f"eq(n\\,{k})" for k in taken),
            "-fps_mode",
            "passthrough",
            "-crf",
            18,
            self.path,
        )
        regular = {k // 4: self.truth[k] for k in range(0, len(self.truth), 4)}
        self.truth = {n: self.truth[k] for n, k in enumerate(taken)}
        self.centres = [self.centres[k] for k in taken]
        self.about["omega"] *= 4.0
        return regular

    def interleave_fields(self, folder, made):
        """Even rows of frames 1, 5, 9, …, and odd rows of frames 3, 7, 11, …"""
        self.path = os.path.join(folder, "interlaced.mp4")
        ffmpeg(
            "-i",
            made,
            "-vf",
            "select=mod(n\\,2),setpts=N/(60*TB),tinterlace=interleave_top",
            "-crf",
            18,
            self.path,
        )
        regular = {k // 4: self.truth[k] for k in range(0, len(self.truth), 4)}
        self.truth = {k // 4: self.truth[k] for k in range(1, len(self.truth), 4)}
        self.centres = self.centres[1::4]
        self.about["omega"] *= 4.0
        return regular

    def turn_truth(self):
        """A player turns the video by 90 degrees. Versions of ffmpeg differ in the direction that
        they write."""

        def turned(p):
            return (p[1], WIDTH - 1 - p[0]) if self.turns_left else (HEIGHT - 1 - p[1], p[0])

        self.truth = {
            k: {i: turned(p) for i, p in discs.items()} for k, discs in self.truth.items()
        }
        self.centres = [turned(p) for p in self.centres]


def rotation(folder, positions, about):
    """ϖ/Ω of {frame: {id: (x, y)}} as of a rigid body by time, and its error."""
    table = os.path.join(folder, "positions.csv")
    with open(table, "w", encoding="utf-8") as file:
        file.write("frame,particle,x,y\n")
        for frame in sorted(positions):
            for disc in sorted(positions[frame]):
                file.write("%d,%d,%r,%r\n" % (frame, disc, *positions[frame][disc]))
    return measured(
        "measure",
        table,
        "--camera-fps",
        1,
        "--scale",
        about["scale"],
        "--omega",
        about["omega"],
        "--centre",
        "%r,%r" % tuple(about["centre"]),
        "--phase",
        about["phase"],
        "--amplitude",
        about["amplitude"] / about["scale"],
        "--container-radius",
        about["container_radius"] / about["scale"],
    )


def measured(*call):
    """ϖ/Ω as of a rigid body by time, and its error. Overlaps are permitted in all frames:
    inaccurate positions are scored, not rejected."""
    done = swirl(*call, "--max-invalid", 1, "--json", "-")
    if done.returncode != 0:
        return math.nan, math.nan
    found = json.loads(done.stdout)["rotation"]["rigid_by_time"]
    return tuple(math.nan if found[name] is None else found[name] for name in ("mean", "error"))
