"""For comparison with rolling spheres: solid discs (I = 1/2) that slide flat on a floor, and without one.

    /usr/bin/python3 figures/figure_spheres_flat_discs.py out/figure_spheres_flat_discs.csv
"""

import style

CURVES = [
    ("flat-discs_f0", "no floor", style.GREEN, "X"),
    ("flat-discs_f0.01", r"$\mu_f = 0.01$", style.SKY, "D"),
    ("flat-discs_f0.02", r"$\mu_f = 0.02$", style.BLUE, "s"),
    ("flat-discs_f0.03", r"$\mu_f = 0.03$", style.BLACK, "o"),
]


def main():
    table = style.table_from_arguments("figure_spheres_flat_discs")
    rows = style.read(table)
    curves = [(style.select(rows, curve=name), {"label": label, "color": color, "marker": marker})
              for name, label, color, marker in CURVES]
    style.rotation_figure(table, curves, of="solid discs", height=2.9)


if __name__ == "__main__":
    main()
