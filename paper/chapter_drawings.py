"""What the figures of the chapters have in common: curves over the packing fraction, and maps of
the changes of direction."""

import numpy as np

from paper import look, style, tables
from paper.curves import CERTAIN

PACKING = r"packing fraction $\varphi = N r^2/R^2$"
CHANGES = (
    ("counterrotation", "v", look.AGAINST, "to counterrotation"),
    ("rotation", "^", look.WITH, "back to rotation"),
)
DOT = 0.3  # in Ω: the rate of the largest dots


def curves(axes, rows, parameter, quantity, label):
    """The quantity against the packing fraction, a curve for each value of the parameter, from dark
    to light."""
    values = style.distinct(rows, parameter)
    colors = style.plt.get_cmap("viridis")
    for k, value in enumerate(values):
        here = sorted(
            tables.select(rows, **{parameter: value}), key=lambda row: row["packing_fraction"]
        )
        style.curve(
            axes,
            here,
            "packing_fraction",
            quantity,
            color=colors(0.93 * k / max(len(values) - 1, 1)),
            marker=style.MARKERS[k % len(style.MARKERS)],
            markersize=2.6,
            linewidth=0.8,
            label=f"{label} = {value:g}",
        )


def dots(axes, rows, parameter, color, words):
    """Dots whose area grows with the rate."""
    size = [2 + 60 * min(abs(row["rigid_by_time"]), DOT) for row in rows]
    axes.scatter(
        style.column(rows, parameter),
        style.column(rows, "packing_fraction"),
        s=size,
        color=color,
        alpha=0.35,
        linewidths=0,
        label=words,
    )


def sign_map(axes, rows, changes, parameter):
    """The sign of the rotation at every point, and the changes of direction with their errors."""
    for sign, color, words in ((1, look.WITH, "rotates"), (-1, look.AGAINST, "counterrotates")):
        here = [
            row
            for row in rows
            if sign * row["rigid_by_time"] > CERTAIN * row["rigid_by_time_error"]
        ]
        if here:
            dots(axes, here, parameter, color, words)
    for rate in (0.02, DOT):  # the key of the areas
        axes.scatter(
            [],
            [],
            s=2 + 60 * rate,
            color=style.GREY,
            linewidths=0,
            label=rf"$|\varpi|/\Omega = {rate:g}$" + (" or more" if rate == DOT else ""),
        )
    unknown = [
        row for row in rows if not abs(row["rigid_by_time"]) > CERTAIN * row["rigid_by_time_error"]
    ]
    if unknown:
        axes.plot(
            style.column(unknown, parameter),
            style.column(unknown, "packing_fraction"),
            "x",
            color=style.GREY,
            markersize=2.5,
            label="sign undetermined",
        )
    for direction, marker, color, words in CHANGES:
        here = tables.select(changes, direction=direction)
        if here:
            axes.errorbar(
                style.column(here, parameter),
                style.column(here, "packing_fraction"),
                yerr=style.column(here, "packing_fraction_error"),
                fmt=marker,
                color=style.BLACK,
                markerfacecolor=color,
                markeredgewidth=0.6,
                markersize=4.5,
                elinewidth=0.7,
                label=words,
            )
    values = style.distinct(rows, parameter)
    axes.set_xscale("log")
    axes.set_xticks(values, [f"{value:g}" for value in values], rotation=60)
    axes.minorticks_off()


def dishes(table, parameter, words, label):
    """A complete figure: curves on the left and the map of changes on the right; a row for each
    dish radius if the parameter is another one."""
    rows, changes = style.read(table), tables.companion(table, "_changes")
    radii = [None] if parameter == "container_radius" else style.distinct(rows, "container_radius")
    drawing, axes = style.figure(
        style.PAGE, 3.4 * len(radii), ncols=2, nrows=len(radii), squeeze=False
    )
    for (left, right), radius in zip(axes, radii):
        here = rows if radius is None else tables.select(rows, container_radius=radius)
        marks = changes if radius is None else tables.select(changes, container_radius=radius)
        style.zero_line(left)
        curves(left, here, parameter, "rigid_by_time", label)
        style.fine_near_zero(left, style.column(here, "rigid_by_time"))
        left.set(xlabel=PACKING, ylabel=r"rotation $\varpi/\Omega$, rigid body, by time")
        style.legend(left, ncol=4, title=None if radius is None else f"$R/r = {radius:g}$")
        sign_map(right, here, marks, parameter)
        right.set(xlabel=words, ylabel=PACKING)
        style.legend(right, ncol=3)
    style.save(drawing, table)


def crossing_map(table, x, y, x_label, y_label):
    """A complete figure: N_c as colour and as number with its error, for pairs of two
    parameters."""
    rows = style.read(table)
    xs, ys, values = style.grid(rows, x, y, "crossing")
    drawing, axes = style.figure(1.4 * style.COLUMN, 0.9 + 0.5 * len(ys))
    known = values[np.isfinite(values)]
    low, high = (known.min(), known.max()) if known.size else (0.0, 1.0)
    image = axes.imshow(
        values, origin="lower", aspect="auto", cmap="viridis", vmin=low, vmax=max(high, low + 1)
    )
    for row in rows:
        at = xs.index(row[x]), ys.index(row[y])
        if np.isfinite(row["crossing"]):
            dark = row["crossing"] < 0.5 * (low + max(high, low + 1))
            axes.text(
                *at,
                f"{row['crossing']:.1f}\n±{row['crossing_error']:.1f}",
                ha="center",
                va="center",
                fontsize=style.SMALLEST,
                color="white" if dark else "black",
            )
        else:
            # Signs are certain at three standard errors, as in statistics/zero_crossing.hpp.
            words = (
                "rotates"
                if row["lowest"] > 3 * row["lowest_error"]
                else "counter-\nrotates"
                if row["highest"] < -3 * row["highest_error"]
                else "undecided"
            )
            axes.text(
                *at, words, ha="center", va="center", fontsize=style.SMALLEST, color=style.GREY
            )
    style.label_grid(axes, xs, ys)
    axes.set(xlabel=x_label, ylabel=y_label)
    drawing.colorbar(image, ax=axes, label="$N_c$")
    style.save(drawing, table)
