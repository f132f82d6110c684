"""Figure 5b: rotation of the cluster against the number of discs, for five frictions.

    /usr/bin/python3 figures/figure_5b.py out/figure_5b.csv
"""

import style

CURVES = [
    ("no-wall", r"no wall friction ($\mu_w = 0$)", style.GREEN, "^"),
    ("no-disc", r"no disc friction ($\mu_d = 0$)", style.ORANGE, "v"),
    ("low", r"low ($\mu = 0.1$)", style.SKY, "D"),
    ("medium", r"medium ($\mu = 0.5$)", style.BLUE, "s"),
    ("high", r"high ($\mu = 1$)", style.RED, "o"),
]


def main():
    table = style.table_from_arguments("figure_5b")
    rows = style.read(table)
    drawing, axes = style.figure(height=2.75)
    axes.axhline(0, color=style.GREY, linewidth=0.6, zorder=0)
    for name, label, color, marker in CURVES:
        curve = style.select(rows, setting=name)
        axes.errorbar(style.column(curve, "discs"), style.column(curve, "by_event"),
                      yerr=style.column(curve, "by_event_error"), label=label, color=color,
                      marker=marker, elinewidth=0.7)
    axes.set_xlabel(r"number of discs $N$")
    axes.set_ylabel(r"rotation of the cluster  $\varpi/\Omega$")
    axes.set_xlim(3.5, 49.5)
    axes.set_ylim(-0.15, 1.09)
    axes.text(5, -0.1, "counterrotation", color=style.GREY, fontsize=7)
    axes.text(5, 0.025, "rotation", color=style.GREY, fontsize=7)
    axes.legend(loc="upper left", bbox_to_anchor=(0.13, 0.9))
    style.save(drawing, table)


if __name__ == "__main__":
    main()
