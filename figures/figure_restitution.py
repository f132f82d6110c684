"""Beyond the paper: rotation against the number of discs for three coefficients of restitution.

    /usr/bin/python3 figures/figure_restitution.py out/figure_restitution.csv
"""

import style


def main():
    table = style.table_from_arguments("figure_restitution")
    rows = style.read(table)
    drawing, axes = style.figure()
    style.zero_line(axes)
    for k, value in enumerate(sorted({row["restitution"] for row in rows})):
        style.curve(axes, style.select(rows, restitution=value), "discs", "by_time",
                    color=style.CYCLE[k], marker=style.MARKERS[k], label=f"$e = {value:g}$")
    axes.set_xlabel(r"number of discs $N$")
    axes.set_ylabel(r"rotation of the cluster  $\varpi/\Omega$")
    axes.legend(loc="upper right")
    style.save(drawing, table)


if __name__ == "__main__":
    main()
