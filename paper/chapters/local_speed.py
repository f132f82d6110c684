"""The mechanism of Zhao and Pöschel (arXiv 2008.12902) for the instability of a layer of spheres (instability.py): a particle
moves faster where its neighbourhood is denser. The speed in the lab frame, in units of the floor's speed, against the local
packing fraction: that of the particles with centres within REACH radii. A rolling sphere alone has 2/7 of the floor's
speed, one that the floor carries has 1. Particles whose neighbourhood may contain the wall are omitted."""

import math

import numpy as np
import style
from chapters.instability import RADIUS, layer_point
from combine import over_seeds
from curves import CERTAIN, with_error
from engine import swirl
from figure import Figure

REACH = 4  # r
LAYERS = (0.3, 0.45, 0.65)  # φ
AMPLITUDES = (1.0, 2.0)  # below and near the thresholds
LEAST = 200  # particles in a bin of a run


class LocalSpeed:
    """Sums of the speed, and numbers of the particles, by how many are within REACH, the particle included."""

    name, samples_per_period = "local_speed", 16

    def __init__(self):
        self.sums = np.zeros((2, 1 + REACH * REACH))  # hard spheres: fewer than REACH² fit

    def block(self, frames):
        speeds = np.hypot(*np.moveaxis(frames.velocity, -1, 0)) / np.hypot(*frames.container_velocity.T)[:, None]
        for position, centre, speed in zip(frames.position, frames.container_centre, speeds):
            apart = position[:, None] - position[None]
            near = np.sum(np.einsum("ijk,ijk->ij", apart, apart) < REACH * REACH, axis=1)
            inside = np.hypot(*(position - centre).T) < RADIUS - 1 - REACH
            for row, values in zip(self.sums, (speed, np.ones(len(near)))):
                row += np.bincount(near[inside], values[inside], len(row))[:len(row)]
        return {"samples": float(len(frames))}


def local_run(parameters):
    local = LocalSpeed()
    swirl.run(measure=local, **parameters)
    return {"sums": local.sums.tolist()}


def points(settings):
    return [layer_point(settings, "local-speed", fraction, amplitude, local_run) for fraction in LAYERS
            for amplitude in (AMPLITUDES[-1:] if settings.quick else AMPLITUDES)]


def slope_of(sums):
    """Of the speed against the local packing fraction, a fit to all particles."""
    speed, count = np.asarray(sums)
    x = np.flatnonzero(count)
    if len(x) < 2:
        return math.nan
    return float(np.polyfit(x / REACH ** 2, speed[x] / count[x], 1, w=np.sqrt(count[x]))[0])


def table(points, settings):
    rows, slopes, findings = [], [], []
    for point in (p for p in points if p.runs):
        sums = [np.array(run["sums"]) for run in point.runs]
        for k in np.flatnonzero(np.min([one[1] for one in sums], axis=0) >= LEAST):
            speeds = dict(zip(("speed", "speed_error"), over_seeds([one[0, k] / one[1, k] for one in sums])))
            rows.append({**point.cells, "local_packing": k / REACH ** 2, **speeds})
        slope, error = over_seeds([slope_of(one) for one in sums])[:2]
        slopes.append({**point.cells, "slope": slope, "slope_error": error, "seeds": len(sums)})
        sign = "faster" if slope > CERTAIN * error else "slower" if slope < -CERTAIN * error else "not certainly faster"
        findings.append(f"φ = {point.cells['packing_fraction']}, A/r = {point.cells['amplitude']:g}: particles are {sign} in denser "
                        f"neighbourhoods, d(speed/floor's speed)/dφ_local = {with_error(slope, error)}.")
    return {"": rows, "_slopes": slopes}, findings


def draw(table):
    rows = style.read(table)
    amplitudes = style.distinct(rows, "amplitude") or AMPLITUDES
    drawing, axes = style.figure(style.PAGE, 2.6, ncols=len(amplitudes), squeeze=False, sharey=True)
    for panel, amplitude in zip(axes[0], amplitudes):
        for layer, here, look in style.groups(style.select(rows, amplitude=amplitude), "packing_fraction"):
            style.curve(panel, here, "local_packing", "speed", label=rf"$\varphi = {layer:g}$", **look)
        panel.axhline(2 / 7, color=style.GREY, linewidth=0.6, linestyle="--")
        panel.set(title=f"$A/r = {amplitude:g}$", xlabel="local packing fraction")
    axes[0][0].set_ylabel("speed / speed of the floor")
    style.legend_of_all(drawing, axes[0][-1], ncol=3)
    style.save(drawing, table)


FIGURES = [Figure("local_speed", "chapters", "chapter: are spheres faster in dense neighbourhoods?", points, table, draw)]
