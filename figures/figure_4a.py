"""Figure 4a: the slip parameter of the discs at the wall, for a low and a high friction coefficient.

    /usr/bin/python3 figures/figure_4a.py out/figure_4a.csv
"""

import style

GROUPS = (("slip_resident", "resident at the wall", {}),
      ("pinned_region", "pinned (SI)", {"marker": ".", "linewidth": 0.6, "linestyle": "--"}),
      ("cluster", "all discs", {"fillstyle": "none", "linestyle": ":"}))


def main():
    table = style.table_from_arguments("figure_4a")
    rows = style.read(table)
    drawing, axes = style.figure(height=2.6)
    handles = []
    for setting, label, color, marker in (("high", r"$\mu = 1$", style.RED, "o"),
                                          ("low", r"$\mu = 0.1$", style.SKY, "D")):
        curve = style.select(rows, setting=setting)
        for name, _, look in GROUPS:
            style.curve(axes, curve, "discs", name, color=color, **({"marker": marker} | look))
        handles.append(axes.plot([], [], color=color, marker=marker, label=label)[0])
    handles += [axes.plot([], [], color=style.GREY, label=words, **({"marker": "o"} | look))[0]
              for _, words, look in GROUPS]
    axes.axhline(1, color=style.GREY, linewidth=0.6, linestyle="--", zorder=0)
    axes.set_xlabel(r"number of discs $N$")
    axes.set_ylabel("slip parameter $s$")
    # The legend fills column by column: friction coefficients first, then the groups of discs.
    style.legend(axes, ncol=3, handles=[handles[0], handles[2], handles[1], handles[3], handles[4]])
    style.save(drawing, table)


if __name__ == "__main__":
    main()
