"""Figure 1b: rotation of the cluster against the number of discs, and the pancake line.

    /usr/bin/python3 figures/figure_1b.py out/figure_1b.csv
"""

import style


def main():
    table = style.table_from_arguments("figure_1b")
    rows = style.read(table)
    drawing, axes = style.figure()
    style.zero_line(axes)
    style.curve(axes, rows, "discs", "by_time", color=style.RED, marker="o",
                label=r"simulation, $\mu_d = \mu_w = 1$")
    style.curve(axes, rows, "discs", "pancake", color=style.BLACK, marker="", linestyle="--",
                label="pancake that rolls without slipping")
    style.rotation_axes(axes)
    style.legend(axes, ncol=1)
    style.save(drawing, table)


if __name__ == "__main__":
    main()
