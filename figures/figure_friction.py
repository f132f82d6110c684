"""Beyond the paper: the number of discs at which rotation turns into counterrotation, against the
friction.

    /usr/bin/python3 figures/figure_friction.py out/figure_friction.csv
"""

import style


def main():
    table = style.table_from_arguments("figure_friction")
    rows = style.select(style.read(table), crosses=1.0)
    drawing, axes = style.figure()
    axes.errorbar(style.column(rows, "mu"), style.column(rows, "crossing"),
                  yerr=style.column(rows, "crossing_error"), color=style.BLUE, marker="o",
                  elinewidth=0.7)
    axes.set_xscale("log")
    axes.set_xticks([0.05, 0.1, 0.2, 0.5, 1, 2])
    axes.set_xticklabels(["0.05", "0.1", "0.2", "0.5", "1", "2"])
    axes.minorticks_off()
    axes.set_xlabel(r"friction $\mu_d = \mu_w$")
    axes.set_ylabel(r"crossing $N_c$")
    style.save(drawing, table)


if __name__ == "__main__":
    main()
