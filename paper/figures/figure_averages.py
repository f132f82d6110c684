"""Beyond the paper: the average over events minus that over time, for the five pairs of friction
coefficients of 5b."""

from paper import style
from paper.curves import Curve, rows_of, with_error
from paper.figure import Figure
from paper.figures.figure_5b import CURVES, friction_words, points
from paper.paper_parameters import LAST_N
from paper.runs import FRICTION_OF_5B


def largest_difference(curve):
    """Where the two averages differ most."""
    pairs = [
        (event, time)
        for event, time in zip(curve.by_rate["mean_by_event"], curve.by_rate["mean_by_time"])
        if abs(event[1] - time[1]) >= 0
    ]
    if not pairs:
        return "no runs"
    event, time = max(pairs, key=lambda pair: abs(pair[0][1] - pair[1][1]))
    return (
        f"largest difference at N = {event[0]}, ϖ/Ω = {with_error(*event[1:])} by event and "
        f"{with_error(*time[1:])} by time"
    )


def table(points, settings):
    """The runs and the table of Figure 5b."""
    findings = []
    for friction in FRICTION_OF_5B:
        curve = Curve(
            "",
            [
                p
                for p in points
                if p.cells["setting"] == friction.name and p.cells["discs"] <= LAST_N
            ],
        )
        findings.append(f"{friction_words(friction)}: {largest_difference(curve)}.")
    return {"": rows_of(points)}, findings


def draw(table):
    rows = style.read(table)
    drawing, (both, difference) = style.figure(height=4.2, nrows=2, sharex=True)
    for axes in (both, difference):
        style.zero_line(axes)
    for name, label, color, marker in CURVES:
        curve = style.select(rows, setting=name)
        both.plot(
            style.column(curve, "discs"),
            style.column(curve, "mean_by_event"),
            color=color,
            marker=marker,
            label=label,
        )
        both.plot(
            style.column(curve, "discs"),
            style.column(curve, "mean_by_time"),
            color=color,
            marker=marker,
            fillstyle="none",
            linestyle=":",
        )
        difference.plot(
            style.column(curve, "discs"),
            [row["mean_by_event"] - row["mean_by_time"] for row in curve],
            color=color,
            marker=marker,
        )
    both.set_ylabel(r"$\varpi/\Omega$")
    both.plot(
        [],
        [],
        color=style.GREY,
        linestyle=":",
        marker="o",
        fillstyle="none",
        label="by time (filled: by event)",
    )
    style.legend(both)
    difference.set(ylabel=r"by event $-$ by time", xlabel=r"number of discs $N$")
    style.save(drawing, table)


FIGURES = [
    Figure("averages", "beyond", "beyond the paper: by event and by time", points, table, draw)
]
