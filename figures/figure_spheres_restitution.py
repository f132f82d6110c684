"""Spheres that roll: rotation against N for restitutions of the contacts.

    /usr/bin/python3 figures/figure_spheres_restitution.py out/figure_spheres_restitution.csv
"""

import style

COLORS = [style.BLACK, style.RED, style.ORANGE, style.GREEN, style.BLUE, style.PINK]


def main():
    table = style.table_from_arguments("figure_spheres_restitution")
    rows = style.read(table)
    drawing, axes = style.figure(height=2.9)
    style.zero_line(axes)
    restitutions = sorted({row["curve"] for row in rows}, reverse=True)
    for e, color, marker in zip(restitutions, COLORS, "osD^vP"):
        style.curve(axes, [row for row in rows if row["curve"] == e], "discs", "by_time",
                    label=rf"$e = {e:g}$", color=color, marker=marker)
    style.rotation_axes(axes)
    axes.set_xlabel(r"number of spheres $N$")
    style.legend(axes)
    style.save(drawing, table)


if __name__ == "__main__":
    main()
