"""Rotation of rolling spheres and the packing of their cluster, at the friction of plastic (μ = 0.2) and half the amplitude.
Their curve ϖ(N) has a maximum near N = 28 to 30, which that of the discs does not have (docs/explanation/spheres.md)."""

import math

import numpy as np
import style
from combine import at, number
from curves import rows_of, with_error
from dishes import SPHERES_OF_CHAPTERS
from figure import Figure
from runs import length_of, lengths
from study import Point

# Quantities of the cluster that may explain the maximum of ϖ.
EXPLANATIONS = {"order.all": "hexatic order", "contact_network.coordination": "contacts of a sphere",
                "contact_network.wall": "share at the wall", "centre.elongation": "elongation",
                "slip.cluster": "slip parameter"}


def points(settings):
    made = []
    for spheres in range(20, 45, 3 if settings.quick else 1):
        run = {**SPHERES_OF_CHAPTERS, "discs": spheres, **lengths(settings, (50, 2), (200, 5))}
        made.append(Point(settings, f"spheres-packing_N{spheres}_{length_of(run)}", settings.chapter_seeds, run,
                          ("order", "contact_network", "centre", "slip"), cells={"curve": "0.2", "discs": spheres}))
    return made


def without_trend(values):
    """The values without a parabola in N. A smooth dependence on N says nothing about a maximum."""
    n = np.arange(len(values))
    return values - np.polyval(np.polyfit(n, values, 2), n)


def table(points, settings):
    def values(*path):
        found = [number(at(point.result, *path, "mean")) for point in points]
        return without_trend(found) if np.isfinite(found).all() else np.full(len(points), math.nan)
    rotation, found = values("rotation", "mean_by_time"), []
    for quantity, words in EXPLANATIONS.items():
        coefficient = float(np.corrcoef(values("measured", *quantity.split(".")), rotation)[0, 1])
        # The parabola uses three points.
        found.append((words, coefficient, (1 - coefficient * coefficient) / math.sqrt(len(points) - 4)))
    found.sort(key=lambda one: -abs(one[1]))
    return ({"": rows_of(points, [quantity.replace(".all", ".all=order") for quantity in EXPLANATIONS]),
             "_correlations": [dict(zip(("quantity", "correlation", "correlation_error"), one)) for one in found]},
            [f"Correlation with ϖ over N = {points[0].cells['discs']} to {points[-1].cells['discs']}, without a parabola in "
             f"N: {', '.join(f'{words} {with_error(*numbers)}' for words, *numbers in found)}."])


QUANTITIES = (("mean_by_time", r"rotation $\varpi/\Omega$"), ("order", r"hexatic order $\psi_6$"),
              ("elongation", "elongation"), ("coordination", "contacts of a sphere"))


def draw(table):
    rows = style.read(table)
    drawing, axes = style.figure(height=5.2, nrows=len(QUANTITIES), sharex=True)
    for k, (here, (quantity, label)) in enumerate(zip(axes, QUANTITIES)):
        here.axvspan(28, 30, color="0.9", zorder=0, linewidth=0)
        style.curve(here, rows, "discs", quantity, color=style.CYCLE[k], marker=style.MARKERS[k])
        here.set_ylabel(label)
    style.zero_line(axes[0])
    axes[-1].set_xlabel(r"number of spheres $N$")
    axes[-1].xaxis.set_major_locator(style.matplotlib.ticker.MaxNLocator(integer=True))
    style.save(drawing, table)


FIGURES = [Figure("spheres_packing", "chapters", "chapter: rotation and packing of spheres", points, table, draw)]
