"""What the figures of the chapters have in common: curves over the packing fraction, and maps of the changes of
direction."""

import os

import numpy as np

import style
import tables

PACKING = r"packing fraction $\varphi = N r^2/R^2$"
CHANGES = (("counterrotation", "v", style.BLUE, "to counterrotation"),
           ("rotation", "^", style.RED, "back to rotation"))


def changes_of(table):
    """The rows of the second table, which lists the changes of direction; it may be empty."""
    stem, ending = os.path.splitext(table)
    return tables.read(f"{stem}_changes{ending}")


def colors_of(values):
    """A colour for each value, from dark to light."""
    colors = style.plt.get_cmap("viridis")
    return {value: colors(0.93 * k / max(len(values) - 1, 1)) for k, value in enumerate(values)}


def curves(axes, rows, parameter, quantity, label):
    """The quantity against the packing fraction, a curve for each value of the parameter."""
    values = sorted({row[parameter] for row in rows})
    colors = colors_of(values)
    for k, value in enumerate(values):
        here = sorted(tables.select(rows, **{parameter: value}), key=lambda row: row["packing_fraction"])
        axes.errorbar(style.column(here, "packing_fraction"), style.column(here, quantity),
                      yerr=style.column(here, quantity + "_error"), color=colors[value],
                      marker=style.MARKERS[k % len(style.MARKERS)], markersize=2.6, elinewidth=0.7,
                      linewidth=0.8, label=f"{label} = {value:g}")
    style.ring(axes, rows, "packing_fraction", quantity)


def sign_map(axes, rows, changes, parameter, logarithmic):
    """The sign of the rotation at every point, and the changes of direction with their errors."""
    for sign, color, words in ((1, style.RED, "rotates"), (-1, style.BLUE, "counterrotates")):
        here = [row for row in rows if sign * row["rigid_by_time"] > 3 * row["rigid_by_time_error"]]
        size = [2 + 60 * min(abs(row["rigid_by_time"]), 0.3) for row in here]
        axes.scatter(style.column(here, parameter), style.column(here, "packing_fraction"), s=size,
                     color=color, alpha=0.35, linewidths=0, label=words)
    unknown = [row for row in rows if not abs(row["rigid_by_time"]) > 3 * row["rigid_by_time_error"]]
    axes.plot(style.column(unknown, parameter), style.column(unknown, "packing_fraction"), "x",
              color=style.GREY, markersize=2.5, label="sign undetermined")
    for direction, marker, color, words in CHANGES:
        here = tables.select(changes, direction=direction)
        axes.errorbar(style.column(here, parameter), style.column(here, "packing_fraction"),
                      yerr=style.column(here, "packing_fraction_error"), fmt=marker, color=style.BLACK,
                      markerfacecolor=color, markeredgewidth=0.6, markersize=4.5, elinewidth=0.7,
                      label=words)
    if logarithmic:
        values = sorted({row[parameter] for row in rows})
        axes.set_xscale("log")
        axes.set_xticks(values, [f"{value:g}" for value in values], rotation=60)
        axes.minorticks_off()


def dishes(table, parameter, words, label, logarithmic):
    """A complete figure: curves on the left and the map of changes on the right; a row for each dish radius if the
    parameter is another one."""
    rows, changes = style.read(table), changes_of(table)
    radii = [None] if parameter == "container_radius" else sorted({row["container_radius"] for row in rows})
    drawing, axes = style.figure(style.PAGE, 3.4 * len(radii), ncols=2, nrows=len(radii), squeeze=False)
    for (left, right), radius in zip(axes, radii):
        here = rows if radius is None else tables.select(rows, container_radius=radius)
        marks = changes if radius is None else tables.select(changes, container_radius=radius)
        style.zero_line(left)
        curves(left, here, parameter, "rigid_by_time", label)
        left.set_yscale("symlog", linthresh=0.1, linscale=2)
        ticks = [-0.1, -0.05, 0, 0.05, 0.1, 0.3, 1]
        rates = style.column(here, "rigid_by_time")
        low, high = np.nanmin(rates), np.nanmax(rates)
        left.set_yticks([t for t in ticks if low - 0.05 <= t <= high + 0.05])
        left.yaxis.set_major_formatter(lambda y, _: f"{y:g}".replace("-", "−"))
        left.minorticks_off()
        left.set_xlabel(PACKING)
        left.set_ylabel(r"rotation $\varpi/\Omega$, rigid body, by time")
        style.legend(left, ncol=4, title=None if radius is None else f"$R/r = {radius:g}$")
        sign_map(right, here, marks, parameter, logarithmic)
        right.set_xlabel(words)
        right.set_ylabel(PACKING)
        style.legend(right, ncol=3)
    style.save(drawing, table)


def crossing_map(table, x, y, x_label, y_label):
    """A complete figure: N_c as colour and as number with its error, for pairs of two parameters."""
    rows = style.read(table)
    xs, ys = sorted({row[x] for row in rows}), sorted({row[y] for row in rows})
    drawing, axes = style.figure(1.4 * style.COLUMN, 0.9 + 0.5 * len(ys))
    values = np.full((len(ys), len(xs)), np.nan)
    for row in rows:
        values[ys.index(row[y]), xs.index(row[x])] = row["crossing"]
    known = values[np.isfinite(values)]
    low, high = (known.min(), known.max()) if known.size else (0.0, 1.0)
    image = axes.imshow(values, origin="lower", aspect="auto", cmap="viridis", vmin=low, vmax=max(high, low + 1))
    for row in rows:
        at = xs.index(row[x]), ys.index(row[y])
        if np.isfinite(row["crossing"]):
            dark = row["crossing"] < 0.5 * (low + max(high, low + 1))
            axes.text(*at, f"{row['crossing']:.1f}\n±{row['crossing_error']:.1f}", ha="center", va="center",
                      fontsize=style.SMALLEST, color="white" if dark else "black")
        else:
            # Signs are certain at three standard errors, as in statistics/zero_crossing.hpp.
            words = ("rotates" if row["lowest"] > 3 * row["lowest_error"] else
                     "counter-\nrotates" if row["highest"] < -3 * row["highest_error"] else "undecided")
            axes.text(*at, words, ha="center", va="center", fontsize=style.SMALLEST, color=style.GREY)
    axes.set_xticks(range(len(xs)), [f"{value:g}" for value in xs])
    axes.set_yticks(range(len(ys)), [f"{value:g}" for value in ys])
    axes.set_xlabel(x_label)
    axes.set_ylabel(y_label)
    drawing.colorbar(image, ax=axes, label="$N_c$")
    style.save(drawing, table)
