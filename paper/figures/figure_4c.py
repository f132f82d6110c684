"""Figure 4c: rotation of the cluster against the number of particles, smooth and rough."""

import style
from against_n import against_n
from figure import Figure
from runs import HALF, HIGH, LOW, ROUGH, SMOOTH


def draw(table):
    rows = style.read(table)
    drawing, axes = style.figure(height=2.9)
    style.zero_line(axes)
    style.curves_by_setting(axes, rows, "mean_by_time", ("smooth", "rough", "low", "high"))
    style.rotation_axes(axes, of="particles")
    style.legend(axes)
    style.save(drawing, table)


FIGURES = [Figure("4c", "paper", "rotation against N, smooth and rough",
                  *against_n((LOW, HIGH, SMOOTH, ROUGH, HALF), with_crossings=True), draw)]
