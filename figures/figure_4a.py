"""Figure 4a: the slip parameter of the discs at the wall, for a low and a high friction.

    /usr/bin/python3 figures/figure_4a.py out/figure_4a.csv
"""

import style

OF = (("slip_resident", "resident at the wall", {}),
      ("pinned_region", "pinned (SI)", {"marker": ".", "linewidth": 0.6, "linestyle": "--"}),
      ("cluster", "all discs", {"fillstyle": "none", "linestyle": ":"}))


def main():
    table = style.table_from_arguments("figure_4a")
    rows = style.read(table)
    drawing, axes = style.figure(height=2.6)
    marks = []
    for setting, label, color, marker in (("high", r"$\mu = 1$", style.RED, "o"),
                                          ("low", r"$\mu = 0.1$", style.SKY, "D")):
        curve = style.select(rows, setting=setting)
        for name, _, look in OF:
            style.curve(axes, curve, "discs", name, color=color, **({"marker": marker} | look))
        marks.append(axes.plot([], [], color=color, marker=marker, label=label)[0])
    marks += [axes.plot([], [], color=style.GREY, label=words, **({"marker": "o"} | look))[0]
              for _, words, look in OF]
    axes.axhline(1, color=style.GREY, linewidth=0.6, linestyle="--", zorder=0)
    axes.set_xlabel(r"number of discs $N$")
    axes.set_ylabel("slip parameter $s$")
    # By columns: the frictions first, below them what is averaged.
    style.legend(axes, ncol=3, handles=[marks[0], marks[2], marks[1], marks[3], marks[4]])
    style.save(drawing, table)


if __name__ == "__main__":
    main()
