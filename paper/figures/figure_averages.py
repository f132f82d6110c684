"""Beyond the paper: the average over events minus that over time, for the five pairs of friction coefficients of 5b."""

import style
from figures.figure_5b import CURVES


def draw(table):
    rows = style.read(table)
    drawing, (both, difference) = style.figure(height=4.2, nrows=2, sharex=True)
    for axes in (both, difference):
        style.zero_line(axes)
    for name, label, color, marker in CURVES:
        curve = style.select(rows, setting=name)
        both.plot(style.column(curve, "discs"), style.column(curve, "by_event"), color=color,
                  marker=marker, label=label)
        both.plot(style.column(curve, "discs"), style.column(curve, "by_time"), color=color,
                  marker=marker, fillstyle="none", linestyle=":")
        difference.plot(style.column(curve, "discs"),
                        [row["by_event"] - row["by_time"] for row in curve], color=color,
                        marker=marker)
        style.ring(both, curve, "discs", "by_event")
        style.ring(difference, curve, "discs", lambda row: row["by_event"] - row["by_time"])
    both.set_ylabel(r"$\varpi/\Omega$")
    both.plot([], [], color=style.GREY, linestyle=":", marker="o", fillstyle="none",
              label="by time (filled: by event)")
    style.legend(both)
    difference.set_ylabel(r"by event $-$ by time")
    difference.set_xlabel(r"number of discs $N$")
    style.save(drawing, table)
