"""Videos as students and laboratories make them: swirl track, and on request a baseline, against
the ground truth.

    student_videos.py               the tables of kinds in docs/results/tracking_accuracy.md
                                    (minutes)
    student_videos.py --baseline    with the tracker of opencv_tracker.py on the same videos; needs
                                    opencv and scipy
    student_videos.py --kind NAME   this kind only; may be repeated
    student_videos.py --periods N   length of the students' videos [4]
    student_videos.py --seed N      of the discs and the camera, in place of that of each kind; may
                                    be repeated

SWIRL is the program. A student's video has 28 discs and is made by `swirl synthetic-video --camera
student` (30 frames per second, 2 periods per second, 640x480 pixels) with the options of its kind.

In interlaced videos the odd rows are half a frame interval later than the even rows. The ground
truth is that of the even rows. A video by hand starts and stops, and its speed varies by a fourth.
A video that is rejected with a hint is tracked again with the options of the hint.
"""

import argparse
import itertools
import json
import math
import os
import re
import resource
import subprocess
import sys
import tempfile
import time

for folder in ("tests/cli", "track/tests"):
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", folder))
import track_test  # noqa: E402
from program import HANG, swirl  # noqa: E402

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

    def __init__(self, folder, kind, periods, seed):
        self.name, options, after = kind
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
        self.dark = "steel" in self.name
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
            sys.exit(done.stderr)
        self.about = track_test.Truth(made).about
        self.truth = track_test.positions(made[:-4] + ".truth.csv", "x_ideal", "y_ideal")

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
    """ϖ/Ω by time of {frame: {id: (x, y)}}, and its error."""
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
    """ϖ/Ω by time and its error. Overlaps are permitted in all frames: inaccurate positions are
    scored, not rejected."""
    done = swirl(*call, "--max-invalid", 1, "--json", "-")
    if done.returncode != 0:
        return math.nan, math.nan
    found = json.loads(done.stdout)["rotation"]["mean_by_time"]
    return tuple(math.nan if found[name] is None else found[name] for name in ("mean", "error"))


class Result(track_test.Score):
    """The score of tracks with ϖ. Frames before the first and after the last tracked one are not
    scored."""

    def __init__(self, video, found, varpi):
        truth = {
            frame: discs
            for frame, discs in video.truth.items()
            if min(found) <= frame <= max(found)
        }
        super().__init__(truth, found, video.about)
        self.varpi = varpi
        radius, there, total = 0.5 * video.about["scale"], 0, 0
        for frame, discs in truth.items():
            tracked = list(found.get(frame, {}).values())
            total += len(discs)
            there += sum(any(math.dist(p, q) < radius for q in tracked) for p in discs.values())
        self.found = there / total
        self.radius = self.container = math.nan  # relative errors of r and of R/r

    def score_radii(self, camera, about):
        radius = camera["species"][0]["radius"]
        self.radius = radius / about["scale"] - 1.0
        self.container = (
            camera["container"]["radius"] / radius * about["scale"] / about["container_radius"]
            - 1.0
        )


def track(folder, video):
    """The result of swirl track, the claimed error, and what the program printed. The result is
    None if the video is rejected, also with the frames of the hint."""
    out = os.path.join(folder, "tracks.csv")
    options, said = [], ""
    for _ in range(2):
        done = swirl(
            "track", video.path, "--out", out, "--overwrite", "--quiet", *options, timeout=HANG
        )
        said += done.stderr
        if done.returncode == 0:
            break
        options = re.findall(
            r"--(?:first-frame|last-frame|correct-frames) \S+|--discs",
            done.stderr.partition("hint:")[2],
        )
        options = [
            word
            for option in options
            for word in ((option, video.about["discs"]) if option == "--discs" else option.split())
        ]
        if not options:
            break
    if done.returncode != 0:
        return None, math.nan, said
    if options:
        said += "tracked with " + " ".join(map(str, options)) + "\n"
    with open(out[:-4] + ".camera.json", encoding="utf-8") as file:
        camera = json.load(file)
    result = Result(video, track_test.positions(out), measured("measure", out))
    result.score_radii(camera, video.about)
    return result, camera["quality"]["position_error"], said


def track_with_baseline(video):
    """The result of opencv_tracker.py, which is given the radius, the number and the brightness of
    the discs."""
    import cv2
    import opencv_tracker

    frames, film = [], cv2.VideoCapture(video.path)
    while (read := film.read())[0]:
        frames.append(cv2.cvtColor(read[1], cv2.COLOR_BGR2GRAY))
    about, start = dict(video.about), time.process_time()
    found, path, radius, container = opencv_tracker.track(
        frames, about["scale"], about["discs"], not video.dark
    )
    seconds = 1000.0 * (time.process_time() - start) / len(frames)
    result = Result(video, found, None)
    result.score_radii({"species": [{"radius": radius}], "container": {"radius": container}}, about)
    about.update(
        scale=radius,
        centre=path[:2].tolist(),
        amplitude=float(path[2]),
        omega=abs(float(path[3])),
        phase=math.degrees(path[4]),
        container_radius=container,
    )
    with tempfile.TemporaryDirectory(prefix="swirl-baseline-") as folder:
        result.varpi = rotation(folder, found, about)
    return result, seconds


HEAD = [
    "found",
    "swaps per 1000",
    "rms, pixels",
    "error of r",
    "error of R/r",
    "ϖ/Ω",
    "s per 1000 frames",
]


def cells(result, seconds):
    if result is None:
        return ["rejected"] + (len(HEAD) - 1) * [""]
    varpi = f"{result.varpi[0]:.3f}" + (
        f" ± {result.varpi[1]:.3f}" if result.varpi[1] >= 0.0 else ""
    )
    return [
        f"{100 * result.found:.1f} %",
        f"{result.swaps_per_thousand:.0f}",
        f"{result.rms:.2f}",
        f"{100 * result.radius:+.1f} %",
        f"{100 * result.container:+.1f} %",
        varpi,
        f"{seconds:.0f}",
    ]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--baseline", action="store_true")
    parser.add_argument("--kind", action="append")
    parser.add_argument("--periods", type=int, default=4)
    parser.add_argument("--seed", type=int, action="append")
    call = parser.parse_args()
    head = [
        "kind",
        "ϖ/Ω, true",
        "claimed/true",
        *HEAD,
        *(f"baseline: {name}" for name in HEAD if call.baseline),
    ]
    print("| " + " | ".join(head) + " |\n|" + len(head) * "---|", flush=True)
    with tempfile.TemporaryDirectory(prefix="swirl-students-") as folder:
        for kind, seed in itertools.product(KINDS, call.seed or [None]):
            if call.kind and kind[0] not in call.kind:
                continue
            video = Video(folder, kind, call.periods, seed)
            used = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            result, claimed, message = track(folder, video)
            seconds = (
                (resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - used)
                * 1000.0
                / len(video.truth)
            )
            row = [
                video.name,
                f"{video.varpi[0]:.3f}",
                "" if result is None else f"{claimed / result.rms:.2f}",
                *cells(result, seconds),
            ]
            if call.baseline:
                try:
                    row += cells(*track_with_baseline(video))
                except (
                    ValueError,
                    IndexError,
                    ZeroDivisionError,
                    TypeError,
                ) as failure:  # no rim, or no discs
                    row += cells(None, 0.0)
                    message += f"baseline: {failure}\n"
            print("| " + " | ".join(row) + " |", flush=True)
            for line in message.splitlines():
                print(f"{video.name}: {line}", file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
