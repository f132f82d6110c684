"""Scores trackers on videos with a known truth: `swirl track`, or any program that writes a table.

    score_tracking.py                    the videos of student_videos.py (minutes)
    score_tracking.py --scenes           the videos of other_scenes.py; needs OpenCV and h5py
    score_tracking.py --videos FOLDER    all NAME.mp4 with NAME.truth.csv and NAME.truth.json
    score_tracking.py --tracker COMMAND  in place of `swirl track`
    score_tracking.py --kind NAME        this video or kind only; may be repeated
    score_tracking.py --periods N        length of the students' videos [2]
    score_tracking.py --seed N           of the students' videos, in place of that of each kind; may
                                         be repeated
    score_tracking.py --keep FOLDER      where --scenes puts its videos, to use them again

SWIRL is the program. COMMAND is called with VIDEO --out TRACKS.csv --json RESULT.json. It writes
the columns frame, particle, x and y, in pixels of the upright image, and `radius`, `ratio`,
`position_error` and `rotation.rigid` with `mean` and `error`.

A video that is rejected with options as its hint is tracked again with them. The column verdict is

    right        all particles; R/r within 2 %; error and ϖ as claimed; no more swaps than named
    warned       less than that, but a warning says so
    wrong        less than that, and nothing says so
    true, untrue a rejection, whose reason is among those of the video, or is not
"""

import argparse
import glob
import itertools
import json
import math
import os
import re
import resource
import shlex
import subprocess
import sys
import tempfile

for folder in ("tests/cli", "track/tests"):
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", folder))
import student_videos  # noqa: E402
import track_test  # noqa: E402
from program import HANG, swirl  # noqa: E402

HEAD = [
    "video",
    "ϖ/Ω, true",
    "found",
    "swaps per 1000",
    "rms, pixels",
    "claimed/true",
    "error of r",
    "error of R/r",
    "ϖ/Ω",
    "verdict",
    "s per 1000 frames",
]


class Scene:
    """A video next to its truth, in the format of synthetic-video."""

    def __init__(self, path):
        self.path = path
        self.name = os.path.basename(path)[:-4].replace("_", " ")
        self.about = track_test.Truth(path).about
        table = path[:-4] + ".truth.csv"
        self.truth = track_test.positions(table, "x_ideal", "y_ideal")
        # Where perspective shows the motion distorted, the table has it in the plane, too.
        self.plane = "x_plane" in next(track_test.rows(table))
        self.reason = self.about.get("reason")
        self.varpi = self.rotation(table)

    def rotation(self, table):
        if not self.plane:
            with tempfile.TemporaryDirectory(prefix="swirl-truth-") as folder:
                return student_videos.rotation(folder, self.truth, self.about)
        path = self.about["path"]
        middle = [sum(p[a] for p in path) / len(path) for a in (0, 1)]
        phase = math.degrees(math.atan2(middle[1] - path[0][1], path[0][0] - middle[0]))
        about = {
            "scale": 1.0,
            "omega": self.about["omega"],
            "centre": middle,
            "phase": phase,
            "amplitude": self.about["amplitude"] / self.about["scale"],
            "container_radius": self.about["container_radius"] / self.about["scale"],
        }
        with tempfile.TemporaryDirectory(prefix="swirl-truth-") as folder:
            plane = track_test.positions(table, "x_plane", "y_plane")
            return student_videos.rotation(folder, plane, about)


class Claims:
    """What a tracker says about its tracks."""

    def __init__(self, tracks, radius, ratio, error, varpi, swaps, warnings):
        self.tracks = tracks  # {frame: {id: (x, y)}}
        self.radius, self.ratio = radius, ratio
        self.error, self.varpi = error, varpi
        self.swaps, self.warnings = swaps, warnings


class Rejected(Exception):
    """The tracker has rejected the video."""


def hinted_options(message, discs):
    found = re.findall(
        r"--(?:first-frame|last-frame|correct-frames) \S+|--discs", message.partition("hint:")[2]
    )
    return [
        word
        for option in found
        for word in ((option, discs) if option == "--discs" else option.split())
    ]


def with_swirl(folder, video, *options):
    out = os.path.join(folder, "tracks.csv")
    done = swirl(
        "track", video.path, "--out", out, "--overwrite", "--quiet", *options, timeout=HANG
    )
    if done.returncode != 0:
        more = [] if options else hinted_options(done.stderr, video.about["discs"])
        if not more:
            raise Rejected(done.stderr)
        print(f"{video.name}: again with {' '.join(map(str, more))}", file=sys.stderr, flush=True)
        return with_swirl(folder, video, *more)
    camera = track_test.calibration(out)
    # Of a scene in perspective the truth is in the image as it is, else in the ideal image.
    seen = ("x_seen", "y_seen") if isinstance(video, Scene) else ("x", "y")
    radius, quality = camera["species"][0]["radius"], camera["quality"]
    return Claims(
        track_test.positions(out, *seen),
        radius,
        camera["container"]["radius"] / radius,
        quality["position_error"],
        student_videos.measured("measure", out),
        quality.get("possible_swap_count", len(quality["possible_swaps"])),
        done.stderr,
    )


def with_command(command, folder, video):
    out, result = (os.path.join(folder, name) for name in ("tracks.csv", "result.json"))
    call = [*shlex.split(command), video.path, "--out", out, "--json", result]
    done = subprocess.run(call, capture_output=True, encoding="utf-8")
    if done.returncode != 0:
        raise Rejected(done.stderr.strip().rpartition("\n")[2])
    with open(result, encoding="utf-8") as file:
        said = json.load(file)
    varpi = said["rotation"]["rigid"]
    return Claims(
        track_test.positions(out),
        said["radius"],
        said["ratio"],
        said["position_error"],
        tuple(math.nan if varpi[name] is None else varpi[name] for name in ("mean", "error")),
        said["possible_swaps"],
        "".join(f"warning: {text}\n" for text in said["warnings"]),
    )


class Result(track_test.Score):
    """The score of tracks. Frames before the first and after the last tracked one do not count."""

    def __init__(self, video, claims):
        found, about = claims.tracks, video.about
        truth = {
            frame: discs
            for frame, discs in video.truth.items()
            if min(found) <= frame <= max(found)
        }
        super().__init__(truth, found, about)
        near, there, total = 0.5 * about["scale"], 0, 0
        for frame, discs in truth.items():
            tracked = list(found.get(frame, {}).values())
            total += len(discs)
            there += sum(any(math.dist(p, q) < near for q in tracked) for p in discs.values())
        self.found = there / total
        self.claimed = claims.error / self.rms
        self.radius = claims.radius / about["scale"] - 1.0
        self.container = claims.ratio * about["scale"] / about["container_radius"] - 1.0
        self.varpi = claims.varpi
        off = abs(self.varpi[0] - video.varpi[0])
        # A rate from less than all frames, or without an error, may differ by 0.01. None is due
        # below 16 frames per period.
        right = (
            self.found > 0.95
            and abs(self.container) < 0.02
            and self.claimed > 0.5
            and not off > max(0.01, 2 * (self.varpi[1] if self.varpi[1] > 0 else 0))
            and self.swaps <= 2 * claims.swaps
        )
        # That there are few frames per period says nothing of errors.
        warnings = [
            line for line in claims.warnings.splitlines() if "frames per period" not in line
        ]
        self.verdict = "right" if right else "warned" if warnings else "**wrong**"


def row_of(video, result, reason, seconds):
    row = [video.name, f"{video.varpi[0]:.3f}"]
    if result is None:
        allowed = getattr(video, "reason", None)
        true = allowed and re.search(allowed, reason.split(".")[0])
        return [*row, "rejected", *6 * [""], "true" if true else "untrue", f"{seconds:.0f}"]
    error = f" ± {result.varpi[1]:.3f}" if result.varpi[1] >= 0.0 else ""
    return [
        *row,
        f"{100 * result.found:.1f} %",
        f"{result.swaps_per_thousand:.0f}",
        f"{result.rms:.2f}",
        f"{result.claimed:.2f}",
        f"{100 * result.radius:+.1f} %",
        f"{100 * result.container:+.1f} %",
        f"{result.varpi[0]:.3f}{error}",
        result.verdict,
        f"{seconds:.0f}",
    ]


def used_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def score(video, tracker):
    """Prints a row of the table, and on stderr what the tracker has said."""
    start, message, result = used_seconds(), "", None
    with tempfile.TemporaryDirectory(prefix="swirl-tracks-") as folder:
        try:
            claims = with_command(tracker, folder, video) if tracker else with_swirl(folder, video)
        except Rejected as rejected:
            message = str(rejected)
        else:
            message = claims.warnings
            result = Result(video, claims)
    seconds = (used_seconds() - start) * 1000.0 / len(video.truth)
    print("| " + " | ".join(row_of(video, result, message, seconds)) + " |", flush=True)
    for line in message.splitlines():
        print(f"{video.name}: {line}", file=sys.stderr, flush=True)


def videos(call, folder):
    """Students' videos, scenes or those of a folder."""

    def wanted(name):
        return not call.kind or name in call.kind

    if call.videos:
        for path in sorted(glob.glob(os.path.join(call.videos, "*.mp4"))):
            if wanted(os.path.basename(path)[:-4]):
                yield Scene(path)
    elif call.scenes:
        import other_scenes

        for name in filter(wanted, other_scenes.SCENES):
            yield Scene(other_scenes.make(call.keep or folder, name))
    else:
        for kind, seed in itertools.product(student_videos.KINDS, call.seed or [None]):
            if wanted(kind[0]):
                columns = ("x", "y") if call.tracker else ("x_ideal", "y_ideal")
                yield student_videos.Video(folder, kind, call.periods, seed, columns)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", action="store_true")
    parser.add_argument("--videos")
    parser.add_argument("--tracker")
    parser.add_argument("--kind", action="append")
    parser.add_argument("--periods", type=int, default=2)
    parser.add_argument("--seed", type=int, action="append")
    parser.add_argument("--keep")
    call = parser.parse_args()
    print("| " + " | ".join(HEAD) + " |\n|" + len(HEAD) * "---|", flush=True)
    with tempfile.TemporaryDirectory(prefix="swirl-videos-") as folder:
        for video in videos(call, folder):
            score(video, call.tracker)


if __name__ == "__main__":
    main()
