"""Spheres that roll: all numbers of spheres at which the direction of rotation changes, against the
friction coefficient, with those of the experiment.

    /usr/bin/python3 figures/figure_spheres_direction.py out/figure_spheres_direction.csv
"""

import style
from paper_parameters import ROUGH_CHANGE_N, SMOOTH_CHANGE_N

EXPERIMENT = ((SMOOTH_CHANGE_N, "smooth"), (ROUGH_CHANGE_N, "rough"))
CHANGES = (("counterrotation", style.BLUE, "to counterrotation"),
           ("rotation", style.RED, "back to rotation"))


def main():
    table = style.table_from_arguments("figure_spheres_direction")
    rows = style.read(table)
    drawing, axes = style.figure()
    for discs, kind in EXPERIMENT:
        axes.axhline(discs, color=style.GREY, linewidth=0.7, linestyle="--", zorder=0)
        axes.annotate(f" {kind}\n experiment", (1.0, discs), xycoords=("axes fraction", "data"),
                      fontsize=style.SMALLEST, color="0.3", ha="left", va="center")
    for direction, color, label in CHANGES:
        here = style.select(rows, direction=direction)
        if not here:
            continue
        # A bar spans the confidence interval, or the bracket of a change without an interpolated N.
        axes.vlines(style.column(here, "mu"), style.column(here, "lower"), style.column(here, "upper"),
                    color=color, linewidth=2.5, label=label)
        known = [row for row in here if row["crossing"] == row["crossing"]]
        axes.plot(style.column(known, "mu"), style.column(known, "crossing"), "o", color=color)
    unknown = style.select(rows, direction="undetermined")
    if unknown:
        axes.plot(style.column(unknown, "mu"), style.column(unknown, "before"), "x", color=style.GREY,
                  label="sign undetermined")
    axes.set_xlabel(r"friction coefficient $\mu$")
    axes.set_ylabel(r"$N$ where the direction changes")
    axes.set_xlim(0, max(row["mu"] for row in rows) * 1.12)
    style.legend(axes)
    style.save(drawing, table)


if __name__ == "__main__":
    main()
