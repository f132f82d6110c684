"""The minimal model: a rigid ball in a swirled container, its rotation against the slip parameter.

    /usr/bin/python3 figures/figure_ball.py out/figure_ball.csv
"""

import style


def main():
    table = style.table_from_arguments("figure_ball")
    rows = style.read(table)
    drawing, axes = style.figure()
    axes.axhline(1, color=style.GREY, linewidth=0.6, zorder=0)
    kinds = ((style.BLUE, "o"), (style.GREEN, "s"), (style.RED, "^"))
    for (color, marker), radius in zip(kinds, sorted({row["ball_radius"] for row in rows})):
        curve = style.select(rows, ball_radius=radius)
        share = radius / curve[0]["container_radius"]
        axes.plot(style.column(curve, "slip"), style.column(curve, "gamma"), color=color,
                  marker=marker, markevery=4,
                  label=rf"$R_{{\rm ball}}/R_{{\rm container}} = {share:g}$")
    axes.text(0.02, 1.05, r"counterrotation, $\gamma > 1$", color=style.GREY, fontsize=7)
    axes.text(0.02, 0.86, r"rotation, $\gamma < 1$", color=style.GREY, fontsize=7)
    axes.set_xlabel("slip parameter $s$ (0: slips freely, 1: rolls)")
    axes.set_ylabel(r"$\gamma = |\varpi_M|/\Omega$")
    axes.set_xlim(0, 1)
    axes.set_ylim(0, 2.05)
    axes.legend(loc="upper left")
    style.save(drawing, table)


if __name__ == "__main__":
    main()
