"""Beyond the paper: rotation of spheres for bounds of the parameters that the experiment does not state.

    /usr/bin/python3 figures/figure_spheres_bounds.py out/figure_spheres_bounds.csv
"""

import style


def main():
    table = style.table_from_arguments("figure_spheres_bounds")
    rows = style.read(table)
    names = list(dict.fromkeys(row["curve"] for row in rows))
    curves = [(style.select(rows, curve=name),
               {"label": name.replace("μ_f", r"$\mu_f$"), "color": style.CYCLE[k], "marker": style.MARKERS[k]})
              for k, name in enumerate(names)]
    style.rotation_figure(table, curves, of="spheres", width=1.4 * style.COLUMN, height=3.2, fine=0.1, ncol=3)


if __name__ == "__main__":
    main()
