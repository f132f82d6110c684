"""A map of `swirl map`: a quantity over two parameters, or a curve over one.

    /usr/bin/python3 paper parameter_map map/map.csv
"""

import argparse
import sys

import numpy as np

from paper import optional_file, style, tables
from paper.style import plt

# The verdicts that have a marker, and its explanation below the figure.
SIGNS = {
    "always rotates": ("+", "+: rotates at every N"),
    "always counterrotates": ("_", "−: counterrotates at every N"),
    "undecided": ("x", "×: undecided"),
    "undetermined": ("x", "×: undetermined"),
    "failed": ("s", "square: all runs failed"),
}
LABELS = {
    "mean_by_time": r"$\varpi/\Omega$",
    "mean_by_event": r"$\varpi/\Omega$ by event",
    "rigid_by_time": r"rigid $\varpi/\Omega$",
    "rigid_by_event": r"rigid $\varpi/\Omega$ by event",
    "N_c": r"$N_c$",
    "mu": r"friction coefficient $\mu$",
    "mu_disc": r"disc friction $\mu_d$",
    "mu_wall": r"wall friction $\mu_w$",
    "amplitude": r"amplitude $A$",
    "discs": r"number of discs $N$",
    "restitution": r"restitution $e$",
    "inertia": r"moment of inertia $I$",
    "period": r"period $T$",
    "container_radius": r"container radius $R$",
}
BAND = 1.96  # errors: 95 %


def label(name):
    return LABELS.get(name, name.replace("_", " "))


def numbers(rows, name):
    return np.array([row[name] for row in rows], dtype=float)


def draw_signs(axes, rows, x, y):
    """Markers for the sites without a certain value; `y` is a column, or None for the bottom of the
    axes. Returns the explanations."""
    notes = []
    for verdict, (marker, text) in SIGNS.items():
        here = tables.select(rows, verdict=verdict)
        if not here:
            continue
        notes.append(text)
        place = {} if y else {"transform": axes.get_xaxis_transform()}
        axes.plot(
            numbers(here, x),
            numbers(here, y) if y else [0.03] * len(here),
            marker,
            color=style.BLACK,
            markersize=4,
            markeredgewidth=0.8,
            markerfacecolor="none",
            clip_on=False,
            zorder=5,
            **place,
        )
    return notes


def draw_curve(axes, rows, x, of, level):
    shown = [row for row in rows if row[of] == row[of]]
    values, bars = numbers(shown, of), BAND * numbers(shown, of + "_error")
    if of == "N_c":
        bars = [values - numbers(shown, "N_c_lower"), numbers(shown, "N_c_upper") - values]
    axes.errorbar(
        numbers(shown, x), values, yerr=bars, color=style.BLUE, marker="o", elinewidth=0.7
    )
    if of != "N_c":
        axes.axhline(level, color=style.GREY, linewidth=0.6, linestyle="--", zorder=0)
    axes.set_ylabel(label(of))
    without_value = [row for row in rows if row[of] != row[of]]
    return ["bars: 95 %"] + draw_signs(axes, without_value, x, None)


def color_scale(values, of, level):
    """Two colours on either side of the level; one scale for N_c."""
    if of == "N_c":
        return {"cmap": "viridis"}
    reach = float(np.max(np.abs(values - level))) or 1.0
    if of in tables.RATES and level == 0.0 and reach > 0.04:
        # Counterrotation is weak compared with rotation: linear up to 0.02, logarithmic beyond.
        return {
            "cmap": style.directions(),
            "norm": plt.matplotlib.colors.SymLogNorm(linthresh=0.02, vmin=-reach, vmax=reach),
        }
    return {"cmap": style.directions(), "vmin": level - reach, "vmax": level + reach}


def triangles(x, y):
    """Triangles between the sites, none if they are on one line. Axes have very different units, so
    the triangulation uses their ranks."""

    def rank(v):
        return np.searchsorted(np.unique(v), v).astype(float)

    if len(np.unique(x)) < 2 or len(np.unique(y)) < 2 or len(x) < 3:
        return None
    try:
        found = plt.matplotlib.tri.Triangulation(rank(x), rank(y))
    except (RuntimeError, ValueError):
        return None
    return plt.matplotlib.tri.Triangulation(x, y, found.triangles)


def lines(axes, mesh, field, levels, **look):
    """Contours, if the field reaches one of the levels."""
    if any(field.min() < level < field.max() for level in levels):
        return axes.tricontour(mesh, field, levels=levels, **look)
    return None


def draw_zero_line(axes, mesh, rows, of, level):
    """The line on which the quantity crosses the level, and the band in which it is within 1.96
    errors of it."""
    distance = numbers(rows, of) - level
    error = np.nan_to_num(numbers(rows, of + "_error"))
    lines(axes, mesh, distance, [0.0], colors=style.BLACK, linewidths=1.2)
    for sign in (-1, 1):
        lines(
            axes,
            mesh,
            distance + sign * BAND * error,
            [0.0],
            colors=style.BLACK,
            linewidths=0.6,
            linestyles="dashed",
        )


def draw_map(drawing, axes, rows, names, level):
    x, y, of = names
    shown = [row for row in rows if row[of] == row[of]]
    if shown:
        across, up, values = numbers(shown, x), numbers(shown, y), numbers(shown, of)
        scale = color_scale(values, of, level)
        mesh = triangles(across, up)
        if mesh is not None:
            axes.tripcolor(mesh, values, shading="gouraud", rasterized=True, **scale)
        if mesh is not None and of == "N_c":
            steps = np.arange(
                np.ceil(values.min()), values.max() + 1, max(1, round(np.ptp(values) / 8))
            )
            contours = lines(axes, mesh, values, list(steps), colors=style.BLACK, linewidths=0.6)
            if contours is not None:
                axes.clabel(contours, fmt="%d", fontsize=style.SMALLEST)
        elif mesh is not None:
            draw_zero_line(axes, mesh, shown, of, level)
        dots = axes.scatter(
            across,
            up,
            c=values,
            s=9,
            edgecolors=style.BLACK,
            linewidths=0.3,
            zorder=3,
            clip_on=False,
            **scale,
        )
        drawing.colorbar(dots, ax=axes).set_label(label(of))
    axes.set_ylabel(label(y))
    line = (
        f"largest error: {np.nanmax(numbers(shown, of + '_error')):.2g}"
        if of == "N_c" and shown
        else f"line: {level:g}, dashed: its 95 % band"
    )
    return ["dots: computed points", line] + draw_signs(axes, rows, x, y)


def main():
    parser = argparse.ArgumentParser(
        description="Draws the table of `swirl map` to PNG and PDF next to it."
    )
    parser.add_argument("table")
    parser.add_argument("--level", type=float, default=0.0, help="level that the line shows [0]")
    given = parser.parse_args()
    if not optional_file.exists(given.table):
        sys.exit(f"error: the table '{given.table}' does not exist.\nhint: `swirl map` writes it.")
    rows = style.read(given.table)
    columns = list(rows[0])
    of = next(name for name in columns if name + "_error" in columns)
    x, y = columns[0], columns[1] if columns[1] != of else None
    drawing, axes = style.figure(
        width=style.COLUMN if y is None else 4.4, height=2.6 if y is None else 3.4
    )
    if y is None:
        notes = draw_curve(axes, rows, x, of, given.level)
    else:
        notes = draw_map(drawing, axes, rows, (x, y, of), given.level)
    axes.set_xlabel(label(x))
    lines_of_notes = ["; ".join(notes[k : k + 2]) for k in range(0, len(notes), 2)]
    style.note(drawing, "\n".join(lines_of_notes))
    style.save(drawing, given.table)
