"""Figure 1b, with the slip of Figure 4a: rotation of the experiment's spheres against their number,
and the slip parameter of the pinned ones, with the numbers that the paper states."""

from paper import style
from paper.against_n import against_n
from paper.figure import Figure
from paper.paper_parameters import ROUGH_CHANGE_N, SLIP_AT_25, SMOOTH_CHANGE_N
from paper.runs import HALF, HIGH, ROUGH, SMOOTH

PAPER = {
    "color": style.BLACK,
    "marker": "*",
    "markersize": 9,
    "linestyle": "none",
    "zorder": 5,
    "markeredgecolor": "white",
    "markeredgewidth": 0.5,
}
QUANTITIES = """slip.pinned_region slip.cluster_perimeter slip.pancake centre.x=centre_x centre.y=centre_y
    centre.distance=centre_distance centre.theta=centre_theta centre.left=left centre.elongation centre.centrifugal
    centre.coriolis centre.max_centrifugal centre.max_coriolis"""
WORDS = {
    "slip.pancake": "pancake line",
    "centre.theta": "direction of the centre of mass in degrees (M is at 270)",
}


def draw(table):
    rows = style.read(table)
    drawing, (rotation, slip) = style.figure(height=4.4, nrows=2, sharex=True)
    style.zero_line(rotation)
    style.curves_by_setting(rotation, rows, "mean_by_time")
    style.curve(
        rotation,
        style.select(rows, setting="smooth"),
        "discs",
        "pancake",
        color=style.BLACK,
        marker="",
        linestyle="--",
        label="pancake that rolls without slipping",
    )
    rotation.plot([ROUGH_CHANGE_N, SMOOTH_CHANGE_N], [0, 0], label="the paper states", **PAPER)
    style.rotation_axes(rotation)
    rotation.set_xlabel("")
    style.legend(rotation, ncol=2)
    style.curves_by_setting(slip, rows, "pinned_region")
    slip.plot(*SLIP_AT_25, **PAPER)
    slip.axhline(1, color=style.BLACK, linewidth=1.0, linestyle="--", zorder=0)
    slip.set(ylabel="slip parameter $s$, pinned", xlabel=r"number of particles $N$")
    style.save(drawing, table)


FIGURES = [
    Figure(
        "1b",
        "paper",
        "rotation against N, and the pancake line",
        *against_n((HIGH, SMOOTH, ROUGH, HALF), QUANTITIES, WORDS, with_crossings=True),
        draw,
    )
]
