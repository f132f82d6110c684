"""Where in the M-frame discs become pinned and free, by the criterion of the paper's Supplementary
Information and by residences in the layer at the wall.

    /usr/bin/python3 figures/figure_pinning.py out/figure_pinning.csv
"""

import style

CRITERIA = (("the SI's criterion", style.RED, "--", ("si_pinned", "si_free")),
            ("residences in the wall layer", style.BLUE, "-", ("residence_begin", "residence_end")))
WHICH = ("becoming pinned", "becoming free")
SHOWN = (28, 48)  # as in the paper's maps, or what is nearest


def main():
    table = style.table_from_arguments("figure_pinning")
    rows = style.read(table)
    known = sorted({row["discs"] for row in rows})
    numbers = sorted({min(known, key=lambda n: abs(n - wanted)) for wanted in SHOWN})
    drawing, places = style.figure(width=style.PAGE, height=4.6, nrows=2, ncols=len(numbers),
                                   sharex=True, sharey="row", squeeze=False)
    for column, discs in enumerate(numbers):
        here = sorted(style.select(rows, discs=discs), key=lambda row: row["theta"])
        width = 360 / len(here)
        edges = [row["theta"] - width / 2 for row in here] + [here[-1]["theta"] + width / 2]
        for which, axes in enumerate(places[:, column]):
            told = []
            for label, color, line, names in CRITERIA:
                name = names[which]
                axes.stairs([100 * row[name] for row in here], edges, color=color, linestyle=line,
                            linewidth=1.1, label=label)
                told.append((here[0][name + "_resultant"], here[0][name + "_mean"], color))
            axes.set_title(f"$N = {discs:.0f}$, {WHICH[which]}: resultant "
                           f"{told[0][0]:.2f} (SI), {told[1][0]:.2f} (residences)",
                           fontsize=style.SMALLEST + 0.5, pad=11)
            for _, mean, color in told:
                # Above the axes, where no curve is.
                axes.plot(mean, 1.02, "v", color=color, markersize=4, clip_on=False,
                          transform=axes.get_xaxis_transform())
            axes.set_xlim(0, 360)
            axes.set_xticks(range(0, 361, 45))
    for axes in places.flat:
        axes.set_ylim(bottom=0)
    for axes in places[:, 0]:
        axes.set_ylabel("per cent in 10°")
    for axes in places[-1]:
        axes.set_xlabel(r"angular position $\theta$ (°); M is at 270°")
    style.legend_of_all(drawing, *places[0][0].get_legend_handles_labels(), ncol=2)
    style.note_not_steady(drawing, [row for row in rows if row["discs"] in numbers])
    style.save(drawing, table)


if __name__ == "__main__":
    main()
