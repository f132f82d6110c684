"""Figure 4a: the slip parameter of the discs at the wall, for a low and a high friction.

    /usr/bin/python3 figures/figure_4a.py out/figure_4a.csv
"""

import style


def main():
    table = style.table_from_arguments("figure_4a")
    rows = style.read(table)
    drawing, axes = style.figure()
    for setting, label, color, marker in (("high", r"$\mu = 1$", style.RED, "o"),
                                          ("low", r"$\mu = 0.1$", style.SKY, "D")):
        curve = style.select(rows, setting=setting)
        style.curve(axes, curve, "discs", "pinned_at_wall", color=color, marker=marker,
                    label=label + ", pinned, at the wall")
        style.curve(axes, curve, "discs", "pinned_region", color=color, marker=".", linewidth=0.6,
                    linestyle="--", label=label + ", pinned (SI)")
        style.curve(axes, curve, "discs", "cluster", color=color, marker=marker, fillstyle="none",
                    linestyle=":", label=label + ", all discs")
    axes.axhline(1, color=style.GREY, linewidth=0.6, linestyle="--", zorder=0)
    axes.set_xlabel(r"number of discs $N$")
    axes.set_ylabel("slip parameter $s$")
    style.legend(axes, fontsize=6.5)
    style.save(drawing, table)


if __name__ == "__main__":
    main()
