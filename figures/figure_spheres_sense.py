"""Spheres that roll: the numbers of spheres at which the sense of rotation changes, against the
friction, beside those of the experiment.

    /usr/bin/python3 figures/figure_spheres_sense.py out/figure_spheres_sense.csv
"""

import style

EXPERIMENT = ((36, "smooth"), (28, "rough"))  # where the paper's spheres change their sense
CHANGES = (("counterrotation", "full", "to counterrotation"),
           ("rotation", "none", "back to rotation"))


def main():
    table = style.table_from_arguments("figure_spheres_sense")
    rows = style.read(table)
    drawing, axes = style.figure()
    for discs, kind in EXPERIMENT:
        axes.axhline(discs, color=style.GREY, linewidth=0.7, linestyle="--", zorder=0)
        axes.annotate(f" {kind}\n experiment", (1.0, discs), xycoords=("axes fraction", "data"),
                      fontsize=style.SMALLEST, color="0.3", ha="left", va="center")
    for sense, filled, label in CHANGES:
        here = style.select(rows, sense=sense)
        if here:
            axes.errorbar(style.column(here, "mu"), style.column(here, "crossing"),
                          yerr=style.column(here, "crossing_error"), fmt="o", color=style.BLUE,
                          fillstyle=filled, elinewidth=0.7, label=label)
    axes.set_xlabel(r"friction $\mu$")
    axes.set_ylabel(r"$N$ where the sense changes")
    axes.set_xlim(0, max(row["mu"] for row in rows) * 1.12)
    style.legend(axes)
    style.save(drawing, table)


if __name__ == "__main__":
    main()
