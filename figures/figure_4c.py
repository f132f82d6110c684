"""Figure 4c: rotation of the cluster against the number of discs, smooth and rough.

    /usr/bin/python3 figures/figure_4c.py out/figure_4c.csv
"""

import style


def main():
    table = style.table_from_arguments("figure_4c")
    rows = style.read(table)
    curves = [(style.select(rows, setting=setting),
               {"label": label, "color": color, "marker": marker})
              for setting, label, color, marker in (
                  ("low", r"smooth ($\mu = 0.1$)", style.SKY, "D"),
                  ("high", r"rough ($\mu = 1$)", style.RED, "o"))]
    style.rotation_figure(table, curves)


if __name__ == "__main__":
    main()
