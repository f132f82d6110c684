"""Spheres that roll: rotation with each ingredient of the model switched off alone.

    /usr/bin/python3 figures/figure_spheres_ingredients.py out/figure_spheres_ingredients.csv
"""

import style

CURVES = [
    (None, "all ingredients", style.BLACK, "o"),
    ("no-damping", r"no damping ($e = 1$)", style.SKY, "D"),
    ("shell", r"hollow ($I = \frac{2}{3}$)", style.BLUE, "s"),
    ("no-floor", "no floor", style.GREEN, "X"),
    ("no-vertical", "no vertical friction", style.RED, "v"),
    ("no-vertical-wall", "… at the wall only", style.PINK, "P"),
    ("no-vertical-disc", "… between spheres only", style.ORANGE, "^"),
]


def main(figure="figure_spheres_ingredients", full="0.2", ending=""):
    """`full` names the curve with all ingredients; `ending` ends the names of the others."""
    table = style.table_from_arguments(figure)
    rows = style.read(table)
    # A table reader returns a numeric curve name as a number.
    curves = [([row for row in rows if str(row["curve"]) == (name + ending if name else full)],
               {"label": label, "color": color, "marker": marker})
              for name, label, color, marker in CURVES]
    style.rotation_figure(table, curves, of="spheres", height=3.2)


if __name__ == "__main__":
    main()
