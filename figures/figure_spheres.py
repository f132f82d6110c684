"""Spheres that roll: rotation against the number of spheres in a container of the experiment's size, for friction
coefficients from smooth to rough.

    /usr/bin/python3 figures/figure_spheres.py out/figure_spheres.csv
"""

import style

FINE = 0.16  # in Ω: coarser scale above, where only small N rotate


def main():
    table = style.table_from_arguments("figure_spheres")
    rows = style.read(table)
    curves = [(style.select(rows, mu=mu),
               {"label": rf"$\mu = {mu:g}$", "color": style.CYCLE[k], "marker": style.MARKERS[k]})
              for k, mu in enumerate(sorted({row["mu"] for row in rows}))]
    style.rotation_figure(table, curves, of="spheres", width=style.PAGE, height=3.4,
                          fine=FINE, ncol=6)


if __name__ == "__main__":
    main()
