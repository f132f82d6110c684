"""Tables of docs/results/tracking_accuracy.md: errors with four cameras, and of spins.

    tracking_tables.py            the table of four cameras (minutes)
    tracking_tables.py --spins    bias of measured spins against spin, noise and compression
                                  (minutes)

SWIRL is the program.
"""

import os
import sys
import tempfile

for path in ("tests/cli", "track/tests"):
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", path))
import track_test  # noqa: E402
from program import HANG, swirl  # noqa: E402

VIDEOS = (
    ("laboratory", ["--discs", 36, "--periods", 1.5]),
    ("phone", ["--discs", 48, "--periods", 4, "--quality", 26]),
    ("bad", ["--discs", 28, "--periods", 12, "--quality", 26]),
    ("steel", ["--discs", 32, "--mixture", "10:1.35", "--periods", 4, "--quality", 24]),
)


def make_and_track(video, made, tracks, tracked):
    for call in (
        ["synthetic-video", *made, "--out", video],
        ["track", video, *tracked, "--out", tracks],
    ):
        done = swirl(*call, "--overwrite", "--quiet", timeout=HANG)
        if done.returncode != 0:
            sys.exit(done.stderr)


def print_table(folder):
    print(
        "| video | frames with all discs | identity swaps per 1000 | rms, pixels | Ω | centre, "
        "pixels | amplitude, pixels | radius |"
    )
    print("|---|---|---|---|---|---|---|---|")
    for name, options in VIDEOS:
        video, tracks = (os.path.join(folder, name + end) for end in (".mp4", ".csv"))
        make_and_track(video, ["--camera", name, *options], tracks, [])
        c = track_test.Comparison(video, tracks)
        print(
            f"| {name} | {100 * c.complete:.1f} % | {c.swaps_per_thousand:.1f} | {c.rms:.2f} "
            f"| {c.omega:+.0e} | {c.centre:.2f} | {c.amplitude:+.2f} | {100 * c.radius:+.1f} % |",
            flush=True,
        )


def print_spins(folder):
    print("| noise, levels | compression | slope, 0–0.3 Ω | 0.3–0.6 | above | rms, Ω |")
    print("|---|---|---|---|---|---|")
    video, tracks = os.path.join(folder, "video.mp4"), os.path.join(folder, "tracks.csv")
    for noise, quality in ((0, 0), (2, 0), (4, 0), (8, 0), (2, 10), (2, 18), (2, 26)):
        make_and_track(
            video,
            [
                "--discs",
                36,
                "--frames-per-period",
                64,
                "--frame-count",
                80,
                "--noise",
                noise,
                "--quality",
                quality,
            ],
            tracks,
            ["--spin"],
        )
        spins = track_test.SpinComparison(video, tracks)
        cells = [f"{noise}", f"{quality}"]
        cells += [f"{spins.slope(*bounds):.3f}" for bounds in ((0, 0.3), (0.3, 0.6), (0.6,))] + [
            f"{spins.rms():.3f}"
        ]
        print("| " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="swirl-videos-") as work:
        (print_spins if sys.argv[1:] == ["--spins"] else print_table)(work)
