"""Beyond the paper: ramps of a parameter through a change of direction and back.

    /usr/bin/python3 figures/figure_hysteresis.py out/figure_hysteresis.csv
"""

import style
import tables

PARAMETERS = {"mu": r"friction coefficient $\mu$", "amplitude": r"amplitude $A/R$"}


def main():
    table = style.table_from_arguments("figure_hysteresis")
    rows = style.read(table)
    loops = list(dict.fromkeys(row["loop"] for row in rows))
    lengths = sorted({row["periods"] for row in rows})
    drawing, axes = style.figure(style.PAGE, 2.6, ncols=len(loops), squeeze=False)
    for here, loop in zip(axes[0], loops):
        style.zero_line(here)
        for k, length in enumerate(lengths):
            part = tables.select(rows, loop=loop, periods=length)
            for branch, marker, filled in (("up", "^", True), ("down", "v", False)):
                here.errorbar(style.column(part, "value"), style.column(part, branch),
                              yerr=style.column(part, branch + "_error"), color=style.CYCLE[k], marker=marker,
                              markerfacecolor=style.CYCLE[k] if filled else "white", elinewidth=0.7, linewidth=0.8,
                              label=f"{branch}, {length:.0f} periods")
        here.set_title(loop)
        here.set_xlabel(PARAMETERS[part[0]["parameter"]])
    axes[0][0].set_ylabel(r"rotation $\varpi/\Omega$, rigid body")
    style.legend_of_all(drawing, *axes[0][0].get_legend_handles_labels(), ncol=4)
    style.save(drawing, table)


if __name__ == "__main__":
    main()
