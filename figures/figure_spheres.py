"""Spheres that roll: rotation against the number of spheres in the experiment's dish, for frictions
from smooth to rough.

    /usr/bin/python3 figures/figure_spheres.py out/figure_spheres.csv
"""

import style

MOST = 0.16  # of Ω: what lies above is few spheres, which rotate


def main():
    table = style.table_from_arguments("figure_spheres")
    rows = style.read(table)
    drawing, axes = style.figure(width=1.45 * style.COLUMN, height=3.1)
    style.zero_line(axes)
    for k, mu in enumerate(sorted({row["mu"] for row in rows})):
        style.curve(axes, style.select(rows, mu=mu), "discs", "by_time", color=style.CYCLE[k],
                    marker=style.MARKERS[k], label=rf"$\mu = {mu:g}$")
    axes.set_ylim(-0.1, MOST)
    style.rotation_axes(axes)
    axes.set_xlabel(r"number of spheres $N$")
    style.legend(axes, ncol=3)
    style.save(drawing, table)


if __name__ == "__main__":
    main()
