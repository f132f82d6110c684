"""Beyond the paper: rotation of 48 discs against both frictions.

    /usr/bin/python3 figures/figure_map.py out/figure_map.csv
"""

import style


def main():
    table = style.table_from_arguments("figure_map")
    rows = style.read(table)
    steps = sorted({row["mu_wall"] for row in rows})
    # Nine steps take a page's width to be readable.
    large = len(steps) > 6
    drawing, axes = style.figure(width=style.PAGE if large else style.COLUMN,
                                 height=5.6 if large else 2.9)
    values = [[float("nan")] * len(steps) for _ in steps]
    for row in rows:
        values[steps.index(row["mu_wall"])][steps.index(row["mu_disc"])] = row["by_time"]
    colors = style.plt.get_cmap("PuOr_r").copy()
    colors.set_bad("0.85")
    # Counterrotation is weak beside rotation: linear up to 0.02, logarithmic beyond.
    span = style.matplotlib.colors.SymLogNorm(linthresh=0.02, vmin=-1, vmax=1)
    shown = axes.imshow(values, origin="lower", cmap=colors, norm=span)
    for y, line in enumerate(values):
        for x, value in enumerate(line):
            if value == value:
                number = f"{value:.2f}".replace("-0.00", "0.00").replace("-", "−")
                axes.text(x, y, number, ha="center", va="center",
                          fontsize=8 if large else 7,
                          color="white" if abs(value) > 0.3 else "black")
    drifting = style.not_steady(rows)
    for row in drifting:
        corner = (steps.index(row["mu_disc"]) - 0.44, steps.index(row["mu_wall"]) - 0.44)
        axes.add_patch(style.plt.Rectangle(corner, 0.88, 0.88, fill=False, linewidth=0.7,
                                           linestyle=":"))
    notes = []
    if drifting:
        notes.append("dotted: not shown to be steady")
    if any(value != value for line in values for value in line):
        notes.append("grey: no result")
    if notes:
        style.note(drawing, "; ".join(notes))
    axes.set_xticks(range(len(steps)), [f"{s:g}" for s in steps])
    axes.set_yticks(range(len(steps)), [f"{s:g}" for s in steps])
    axes.set_xlabel(r"disc friction $\mu_d$")
    axes.set_ylabel(r"wall friction $\mu_w$")
    for side in axes.spines.values():
        side.set_visible(False)
    axes.tick_params(length=0)
    bar = drawing.colorbar(shown, ax=axes, shrink=0.85)
    bar.set_ticks([-1, -0.1, 0, 0.1, 1], labels=["−1", "−0.1", "0", "0.1", "1"])
    bar.minorticks_off()
    bar.set_label(r"$\varpi/\Omega$ at $N = 48$")
    style.save(drawing, table)


if __name__ == "__main__":
    main()
