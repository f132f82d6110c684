"""Beyond the paper: rotation against the number of discs for three moments of inertia (a solid disc has ½, a ring 1, the paper 10).

    /usr/bin/python3 figures/figure_inertia.py out/figure_inertia.csv
"""

import style


def main():
    table = style.table_from_arguments("figure_inertia")
    rows = style.read(table)
    drawing, axes = style.figure()
    style.zero_line(axes)
    for k, value in enumerate(sorted({row["inertia"] for row in rows})):
        style.curve(axes, style.select(rows, inertia=value), "discs", "by_time",
                    color=style.CYCLE[k], marker=style.MARKERS[k], label=f"$I = {value:g}$")
    axes.set_xlabel(r"number of discs $N$")
    axes.set_ylabel(r"rotation of the cluster  $\varpi/\Omega$")
    axes.legend(loc="upper right")
    style.save(drawing, table)


if __name__ == "__main__":
    main()
