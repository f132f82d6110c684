"""Baseline for `swirl track`: a simple version of trackpy's method, scored on the videos of
docs/results/tracking_accuracy.md, whose ground truth is known.

    SWIRL=build/tests/swirl /usr/bin/python3 bench/plain_tracker.py       (numpy and scipy; minutes)

    find   Crocker & Grier (1996). A band pass (a Gaussian minus a moving mean over a disc's width,
           negative values set to 0), then local maxima, then the brightness-weighted centre of a disc
           around each, moved until it is stationary. Images of dark discs are inverted.
    link   The assignment between two frames with the least sum of squares, in the lab frame, within a
           range of a disc's radius. A missing disc is remembered for three frames.

The method is given the radius and number of the discs, and the position of the dish. It estimates no
errors. trackpy itself is more careful in some steps.
"""

import os
import subprocess
import sys
import tempfile

import numpy
from scipy import ndimage, optimize

for folder in ("tests/cli", "track/tests"):
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", folder))
import track_test  # noqa: E402


def read_frames(video):
    size = subprocess.run(["ffprobe", "-v", "error", "-select_streams", "v", "-show_entries",
                           "stream=width,height", "-of", "csv=p=0", video], check=True,
                          stdout=subprocess.PIPE, text=True).stdout.split(",")
    width, height = int(size[0]), int(size[1])
    raw = subprocess.run(["ffmpeg", "-v", "error", "-i", video, "-f", "rawvideo", "-pix_fmt", "gray",
                          "-"], check=True, stdout=subprocess.PIPE).stdout
    return numpy.frombuffer(raw, numpy.uint8).reshape(-1, height, width)


def find(image, radius, number, dark, centre, dish):
    grey = image.astype(float)
    if dark:
        grey = 255.0 - grey
    width = 2 * int(radius) + 1
    band = numpy.maximum(0.0, ndimage.gaussian_filter(grey, 1.0)
                         - ndimage.uniform_filter(grey, width))
    # As in trackpy: a disc of constant brightness has no maximum at its centre, but its smoothed
    # image has one.
    smooth = ndimage.gaussian_filter(band, 0.5 * radius)
    maxima = (ndimage.maximum_filter(smooth, size=int(1.2 * radius)) == smooth) & (smooth > 0)
    rows, columns = numpy.nonzero(maxima)
    inside = numpy.hypot(columns - centre[0], rows - centre[1]) < dish - 0.5 * radius
    rows, columns = rows[inside], columns[inside]
    best = numpy.argsort(-smooth[rows, columns])[:number]
    reach = int(radius)
    y, x = numpy.mgrid[-reach:reach + 1, -reach:reach + 1]
    disc = x * x + y * y <= radius * radius
    padded = numpy.pad(band, reach)
    found = []
    for row, column in zip(rows[best], columns[best]):
        for _ in range(10):
            part = padded[row:row + 2 * reach + 1, column:column + 2 * reach + 1] * disc
            mass = part.sum()
            if mass <= 0:
                break
            dx, dy = (part * x).sum() / mass, (part * y).sum() / mass
            step = (int(numpy.round(dy)), int(numpy.round(dx)))
            if step == (0, 0):
                break
            row = min(max(row + step[0], 0), band.shape[0] - 1)
            column = min(max(column + step[1], 0), band.shape[1] - 1)
        if mass > 0:
            found.append((column + dx, row + dy))
    return numpy.array(found).reshape(-1, 2)


def link(found, reach, memory=3):
    """Returns {frame: {track: position}}."""
    tracks, known, born = {}, {}, 0  # known: track → (position, last frame)
    for k, here in enumerate(found):
        ids = [t for t, (_, last) in known.items() if k - last <= memory + 1]
        used, tracks[k] = set(), {}
        if ids and len(here):
            positions = numpy.array([known[t][0] for t in ids])
            squares = ((positions[:, None] - here[None]) ** 2).sum(axis=2)
            rows, columns = optimize.linear_sum_assignment(
                numpy.minimum(squares, reach * reach))
            for r, c in zip(rows, columns):
                if squares[r, c] < reach * reach:
                    tracks[k][ids[r]] = here[c]
                    used.add(c)
        for c, position in enumerate(here):
            if c not in used:
                tracks[k][born] = position
                born += 1
        for t, position in tracks[k].items():
            known[t] = (position, k)
    return tracks


def main():
    print("| video | frames with all discs | identity swaps per 1000 | rms, pixels |")
    print("|---|---|---|---|")
    with tempfile.TemporaryDirectory(prefix="swirl-videos-") as folder:
        for name, options in track_test.VIDEOS:
            video = os.path.join(folder, name + ".mp4")
            done = track_test.swirl("synthetic-video", "--camera", name, *options, "--out", video, "--quiet",
                                    timeout=1200)
            if done.returncode != 0:
                sys.exit(done.stderr)
            truth = track_test.Truth(video)
            dish = [(float(row["x_ideal"]), float(row["y_ideal"]))
                    for row in track_test.rows(video[:-4] + ".container.csv")]
            found = [find(image, truth.about["scale"], truth.about["discs"], name == "steel",
                          centre, truth.about["container_radius"])
                     for image, centre in zip(read_frames(video), dish)]
            # Positions in the image, not those of an ideal lens: the baseline has no lens model.
            score = track_test.Score(track_test.positions(video[:-4] + ".truth.csv"),
                                       link(found, truth.about["scale"]), truth.about)
            print(f"| {name} | {100 * score.complete:.1f} % | {score.swaps_per_thousand:.0f} | "
                  f"{score.rms:.2f} |", flush=True)


if __name__ == "__main__":
    main()
