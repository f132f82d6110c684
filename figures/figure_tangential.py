"""Beyond the paper: rotation against the number of discs for three coefficients of tangential restitution,
solid discs.

    /usr/bin/python3 figures/figure_tangential.py out/figure_tangential.csv
"""

import style


def main():
    table = style.table_from_arguments("figure_tangential")
    rows = style.read(table)
    drawing, axes = style.figure()
    style.zero_line(axes)
    for k, value in enumerate(sorted({row["tangential_restitution"] for row in rows})):
        style.curve(axes, style.select(rows, tangential_restitution=value), "discs", "by_time",
                    color=style.CYCLE[k], marker=style.MARKERS[k], label=rf"$\beta = {value:g}$")
    axes.set_xlabel(r"number of discs $N$")
    axes.set_ylabel(r"rotation of the cluster  $\varpi/\Omega$")
    axes.legend(loc="upper right")
    style.save(drawing, table)


if __name__ == "__main__":
    main()
