"""What plain tracking makes of the films of docs/how-to/record_experiment.md: the method that trackpy has made common,
written down plainly, against the truth of the films.

    /usr/bin/python3 bench/plain_tracker.py       (numpy and scipy; minutes; with SWIRL set to the program)

    find   Crocker & Grier (1996): a band pass (a Gaussian less a moving mean of a disc's width, nothing
           below 0), local maxima of it as bright as the best, the brightness-weighted middle of a disc
           about each, moved until it stays. The diameter is told; of dark discs the negative is taken.
           As many of the brightest maxima are kept as there are discs, which is told, too, and where
           the dish is.
    link   the assignment with the least sum of squares between two pictures, in the lab, within a
           range that is told (a disc's radius); who is missing is remembered for three pictures.

trackpy itself does this with more care in places. Nothing of the dish is found, and no error told.
"""

import os
import subprocess
import sys
import tempfile

import numpy
from scipy import ndimage, optimize

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tests", "cli"))
import track_test  # noqa: E402


def pictures(film):
    size = subprocess.run(["ffprobe", "-v", "error", "-select_streams", "v", "-show_entries",
                           "stream=width,height", "-of", "csv=p=0", film], check=True,
                          stdout=subprocess.PIPE, text=True).stdout.split(",")
    width, height = int(size[0]), int(size[1])
    raw = subprocess.run(["ffmpeg", "-v", "error", "-i", film, "-f", "rawvideo", "-pix_fmt", "gray",
                          "-"], check=True, stdout=subprocess.PIPE).stdout
    return numpy.frombuffer(raw, numpy.uint8).reshape(-1, height, width)


def find(picture, radius, number, dark, centre, dish):
    grey = picture.astype(float)
    if dark:
        grey = 255.0 - grey
    width = 2 * int(radius) + 1
    band = numpy.maximum(0.0, ndimage.gaussian_filter(grey, 1.0)
                         - ndimage.uniform_filter(grey, width))
    # As trackpy: discs of constant brightness have no maximum in the middle, a mean over them has.
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
    """{frame: {track: place}}."""
    tracks, known, born = {}, {}, 0  # known: track → (place, last picture)
    for k, here in enumerate(found):
        names = [t for t, (_, last) in known.items() if k - last <= memory + 1]
        used, tracks[k] = set(), {}
        if names and len(here):
            places = numpy.array([known[t][0] for t in names])
            squares = ((places[:, None] - here[None]) ** 2).sum(axis=2)
            rows, columns = optimize.linear_sum_assignment(
                numpy.minimum(squares, reach * reach))
            for r, c in zip(rows, columns):
                if squares[r, c] < reach * reach:
                    tracks[k][names[r]] = here[c]
                    used.add(c)
        for c, place in enumerate(here):
            if c not in used:
                tracks[k][born] = place
                born += 1
        for t, place in tracks[k].items():
            known[t] = (place, k)
    return tracks


def main():
    print("| video | frames with all discs | identity swaps per 1000 | rms, pixels |")
    print("|---|---|---|---|")
    with tempfile.TemporaryDirectory(prefix="swirl-films-") as folder:
        for name, options in track_test.VIDEOS:
            film = os.path.join(folder, name + ".mp4")
            done = track_test.swirl("synthetic-video", "--camera", name, *options, "--out", film, "--quiet",
                                    timeout=1200)
            if done.returncode != 0:
                sys.exit(done.stderr)
            truth = track_test.Truth(film)
            dish = [(float(row["x_ideal"]), float(row["y_ideal"]))
                    for row in track_test.rows(film[:-4] + ".container.csv")]
            found = [find(picture, truth.about["scale"], truth.about["discs"], name == "steel",
                          centre, truth.about["container_radius"])
                     for picture, centre in zip(pictures(film), dish)]
            # Of the picture, not of an ideal lens: plain tracking knows of none.
            score = track_test.Score(track_test.positions(film[:-4] + ".truth.csv"),
                                       link(found, truth.about["scale"]), truth.about)
            print(f"| {name} | {100 * score.complete:.1f} % | {score.swaps_per_thousand:.0f} | "
                  f"{score.rms:.2f} |", flush=True)


if __name__ == "__main__":
    main()
