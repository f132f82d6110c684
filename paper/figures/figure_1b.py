"""Figure 1b, with the slip of Figure 4a: rotation of the experiment's spheres against their number, and the slip
parameter of the pinned ones, with the numbers that the paper states."""

import style
from paper_parameters import ROUGH_CHANGE_N, SLIP_AT_25, SMOOTH_CHANGE_N

PAPER = {"color": style.BLACK, "marker": "*", "markersize": 9, "linestyle": "none", "zorder": 5,
         "markeredgecolor": "white", "markeredgewidth": 0.5}


def draw(table):
    rows = style.read(table)
    drawing, (rotation, slip) = style.figure(height=4.4, nrows=2, sharex=True)
    style.zero_line(rotation)
    style.curves_by_setting(rotation, rows, "by_time")
    style.curve(rotation, style.select(rows, setting="smooth"), "discs", "pancake", color=style.BLACK, marker="",
                linestyle="--", label="pancake that rolls without slipping")
    rotation.plot([ROUGH_CHANGE_N, SMOOTH_CHANGE_N], [0, 0], label="the paper states", **PAPER)
    style.rotation_axes(rotation)
    rotation.set_xlabel("")
    style.legend(rotation, ncol=2)
    style.curves_by_setting(slip, rows, "pinned_region")
    slip.plot(*SLIP_AT_25, **PAPER)
    slip.axhline(1, color=style.BLACK, linewidth=1.0, linestyle="--", zorder=0)
    slip.set_ylabel("slip parameter $s$, pinned")
    slip.set_xlabel(r"number of particles $N$")
    style.save(drawing, table)
