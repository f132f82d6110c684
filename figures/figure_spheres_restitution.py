"""Spheres that roll: rotation against N for restitutions of the contacts.

    /usr/bin/python3 figures/figure_spheres_restitution.py out/figure_spheres_restitution.csv
"""

import style

COLORS = [style.BLACK, style.RED, style.ORANGE, style.GREEN, style.BLUE, style.PINK]


def main():
    table = style.table_from_arguments("figure_spheres_restitution")
    rows = style.read(table)
    restitutions = sorted({row["curve"] for row in rows}, reverse=True)
    curves = [(style.select(rows, curve=e),
               {"label": rf"$e = {e:g}$", "color": color, "marker": marker})
              for e, color, marker in zip(restitutions, COLORS, "osD^vP")]
    style.rotation_figure(table, curves, of="spheres", height=2.9, ncol=3)


if __name__ == "__main__":
    main()
