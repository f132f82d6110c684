"""Baseline for `swirl track`: what OpenCV and scipy give an experimenter in an afternoon.

    rim    For each radius, edges vote for the centre along their gradient. Of the circles with the
           most votes, the one whose centre moves is the rim. Its centres give the container's path:
           x, y, A, Ω and φ by least squares.
    discs  The same votes for the given radius. A robust circle is fitted to the sub-pixel edges on
           rays around each maximum. The best circles that do not overlap are the discs, at most the
           given number.
    link   Assignment of least squares between frames, in the frame of reference of the dish. A disc
           is expected half as far as it moved before, the best of 0, 1/2 and 1. A missing disc is
           remembered for five frames.

The baseline is given the radius and the number of the discs, and whether they are bright. It
estimates no errors, and knows no lens, no tilt, no uneven times and no interlaced frames.
`student_videos.py --baseline` compares both.
"""

import cv2
import numpy
from scipy import ndimage, optimize

RAYS = 64
DIRECTIONS = numpy.stack(
    [
        numpy.cos(2 * numpy.pi * numpy.arange(RAYS) / RAYS),
        numpy.sin(2 * numpy.pi * numpy.arange(RAYS) / RAYS),
    ]
)
MEMORY = 5  # frames


def edges_of(image):
    """Positions, unit gradients and weights of the edge pixels."""
    smooth = cv2.GaussianBlur(image, (0, 0), 1.2)
    dx, dy = (cv2.Scharr(smooth, cv2.CV_32F, *axis, scale=1 / 32) for axis in ((1, 0), (0, 1)))
    steep = cv2.magnitude(dx, dy)
    least = max(3.5 * float(numpy.median(steep)) / 1.18, 0.12 * float(numpy.percentile(steep, 97)))
    y, x = numpy.nonzero(steep > least)
    s = steep[y, x]
    return x, y, dx[y, x] / s, dy[y, x] / s, numpy.minimum(1.0, s / (2 * least))


def votes(edges, shape, radius, sign):
    """Votes for the centres of circles that are brighter (sign 1) or darker (-1) inside."""
    x, y, gx, gy, weight = edges
    u = numpy.rint(x + sign * radius * gx).astype(int)
    v = numpy.rint(y + sign * radius * gy).astype(int)
    inside = (u >= 0) & (v >= 0) & (u < shape[1]) & (v < shape[0])
    count = numpy.bincount(v[inside] * shape[1] + u[inside], weight[inside], shape[0] * shape[1])
    return cv2.GaussianBlur(count.reshape(shape), (0, 0), 0.7 + 0.07 * radius)


def fit(image, centre, radius, sign, free=False):
    """A circle through the steepest points of rays, reweighted by Tukey: centre, radius, share of
    the rays."""
    centre, window = numpy.array(centre, float), max(3.0, 0.17 * radius)
    share = 0.0
    for _ in range(3):
        along = radius + numpy.arange(-window - 1, window + 1.01, 0.5)
        x = centre[0] + DIRECTIONS[0][:, None] * along
        y = centre[1] + DIRECTIONS[1][:, None] * along
        profile = ndimage.map_coordinates(image, [y, x], order=1, mode="nearest")
        slope = -sign * (profile[:, 2:] - profile[:, :-2])
        k = slope[:, 1:-1].argmax(axis=1) + 1
        ray = numpy.arange(RAYS)
        before, here, after = slope[ray, k - 1], slope[ray, k], slope[ray, k + 1]
        bend = numpy.minimum(before - 2 * here + after, -1e-6)
        edge = along[k + 1] + 0.5 * numpy.clip(0.5 * (before - after) / bend, -1, 1)
        good = here > max(1e-3, 0.25 * numpy.percentile(here, 80))
        rows = numpy.stack(
            [DIRECTIONS[0], DIRECTIONS[1], numpy.ones(RAYS)][: 3 if free else 2], axis=1
        )
        step, scale = numpy.zeros(rows.shape[1]), window
        for _ in range(6):
            off = edge - radius - rows @ step
            weight = numpy.where(
                good & (abs(off) < 3 * scale), (1 - (off / (3 * scale)) ** 2) ** 2, 0.0
            )
            if weight.sum() < 6:
                return centre, radius, 0.0
            step = numpy.linalg.lstsq(
                rows * weight[:, None] ** 0.5, (edge - radius) * weight**0.5, rcond=None
            )[0]
            scale = max(0.15, 1.4826 * numpy.median(abs(edge - radius - rows @ step)[good]))
        if abs(step).max() > 1.5 * window:
            return centre, radius, 0.0
        share = float((good & (abs(edge - radius - rows @ step) < max(1.2, 0.06 * radius))).mean())
        centre, radius = centre + step[:2], radius + (step[2] if free else 0.0)
        window = max(2.0, 0.6 * window)
    return centre, radius, share


def find_rim(frames):
    """Radius and sign of the rim: the circle with the most votes whose centre moves."""
    shrink = min(1.0, 300.0 / min(frames[0].shape))
    small = [
        cv2.resize(f, None, fx=shrink, fy=shrink, interpolation=cv2.INTER_AREA).astype(
            numpy.float32
        )
        for f in frames[:: max(1, len(frames) // 12)]
    ]
    edges, shape, best = [edges_of(f) for f in small], small[0].shape, (0.0, 0.0, 1)
    for sign in (1, -1):
        for radius in range(int(0.2 * min(shape)), int(0.56 * min(shape))):
            maxima = [cv2.minMaxLoc(votes(e, shape, radius, sign)) for e in edges]
            centres = numpy.array([m[3] for m in maxima])
            score = sum(m[1] for m in maxima) * (0.7 + 0.07 * radius) ** 2 / radius
            if centres.std(axis=0).min() > 1.5 and score > best[0]:
                best = score, radius / shrink, sign
    return best[1], best[2], shrink


def fit_path(centres):
    """(x, y, A, Ω per frame, φ) of a circular path with y down; Ω is negative if clockwise in the
    image."""
    known = numpy.array([k for k, c in enumerate(centres) if c is not None])
    c = numpy.array([centres[k] for k in known])
    p = numpy.linalg.lstsq(numpy.c_[2 * c, numpy.ones(len(c))], (c**2).sum(1), rcond=None)[0]
    angle = numpy.unwrap(numpy.arctan2(-(c[:, 1] - p[1]), c[:, 0] - p[0]))
    rate, phase = numpy.polyfit(known, angle, 1)
    start = [p[0], p[1], numpy.sqrt(p[2] + p[0] ** 2 + p[1] ** 2), rate, phase]

    def off(q):
        turn = q[3] * known + q[4]
        return numpy.r_[
            q[0] + q[2] * numpy.cos(turn) - c[:, 0], q[1] - q[2] * numpy.sin(turn) - c[:, 1]
        ]

    return optimize.least_squares(off, start, loss="cauchy", f_scale=0.5).x


def find_discs(image, edges, rim, radius, number, sign):
    count = votes(edges, image.shape, radius, sign)
    peak = (count == ndimage.maximum_filter(count, size=int(radius))) & (count > 0)
    y, x = numpy.nonzero(peak)
    inside = numpy.hypot(x - rim[0][0], y - rim[0][1]) < rim[1] - 0.5 * radius
    order = numpy.argsort(-count[y, x] * inside)[: 2 * number + 8]
    circles = sorted(
        (fit(image, (x[k], y[k]), radius, sign) for k in order if inside[k]), key=lambda c: -c[2]
    )
    found = []
    for centre, _, share in circles:
        if (
            share > 0.3
            and len(found) < number
            and all(numpy.hypot(*(centre - other)) > 1.7 * radius for other in found)
        ):
            found.append(centre)
    return numpy.array(found).reshape(-1, 2)


def link(found, containers, radius):
    """{frame: {track: (x, y)}}"""
    tracks, known, born = {}, {}, 0  # known: track → (position in the dish, velocity, last frame)
    for k, (here, container) in enumerate(zip(found, containers)):
        tracks[k], relative = {}, here - container
        ids = [t for t, (_, _, last) in known.items() if k - last <= MEMORY + 1]
        free = set(range(len(here)))
        if ids and len(here):
            expected = numpy.array(
                [known[t][0] + 0.5 * (k - known[t][2]) * known[t][1] for t in ids]
            )
            cost = ((expected[:, None] - relative[None]) ** 2).sum(axis=2)
            for r, c in zip(
                *optimize.linear_sum_assignment(numpy.minimum(cost, (1.5 * radius) ** 2))
            ):
                if cost[r, c] < (1.5 * radius) ** 2:
                    tracks[k][ids[r]] = tuple(here[c].tolist())
                    free.discard(c)
        for c in free:
            tracks[k][born] = tuple(here[c].tolist())
            born += 1
        for t, p in tracks[k].items():
            at = numpy.array(p) - container
            steady = t in known and k - known[t][2] == 1
            known[t] = at, (at - known[t][0] if steady else numpy.zeros(2)), k
    return tracks


def track(frames, radius, number, bright=True):
    """{frame: {track: (x, y)}}, the path, and the radii of the discs and of the container, from
    grey frames."""
    rim_radius, rim_sign, shrink = find_rim(frames)
    sign, rims, discs, radii = 1 if bright else -1, [], [], []
    for frame in frames:
        image = cv2.GaussianBlur(frame.astype(numpy.float32), (0, 0), 0.6)
        small = cv2.resize(frame, None, fx=shrink, fy=shrink, interpolation=cv2.INTER_AREA).astype(
            numpy.float32
        )
        seed = numpy.array(
            cv2.minMaxLoc(votes(edges_of(small), small.shape, rim_radius * shrink, rim_sign))[3]
        )
        rims.append(fit(image, (seed + 0.5) / shrink - 0.5, rim_radius, rim_sign, free=True))
        discs.append(find_discs(image, edges_of(image), rims[-1], radius, number, sign))
        radii += [fit(image, p, radius, sign, free=True)[1] for p in discs[-1][:3]]
    path = fit_path([c if share > 0.2 else None for c, _, share in rims])
    turn = path[3] * numpy.arange(len(frames)) + path[4]
    containers = numpy.stack(
        [path[0] + path[2] * numpy.cos(turn), path[1] - path[2] * numpy.sin(turn)], axis=1
    )
    reach = [numpy.hypot(*(d - c).T).max() + radius for d, c in zip(discs, containers) if len(d)]
    return (
        link(discs, containers, radius),
        path,
        float(numpy.median(radii)),
        float(numpy.median(reach)),
    )
