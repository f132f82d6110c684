"""Figure 3a: angular velocity of the discs about the centre of mass against the angle.

    /usr/bin/python3 figures/figure_3a.py out/figure_3a.csv
"""

import math

import style


def main():
    table = style.table_from_arguments("figure_3a")
    rows = style.read(table)
    numbers = sorted({row["discs"] for row in rows})
    drawing, axes = style.figure(height=2.6)
    colors = style.plt.get_cmap("viridis")
    span = max(numbers[-1] - numbers[0], 1)
    for discs in numbers:
        color = colors(0.95 * (discs - numbers[0]) / span)
        curve = [row for row in style.select(rows, discs=discs) if row["visits"] > 200]
        axes.plot(style.column(curve, "theta"), style.column(curve, "varpi_m"), color=color,
                  linewidth=0.8)
        for angle, marker in (("becoming_pinned", "v"), ("becoming_free", "o")):
            here = [row for row in curve if not math.isnan(row[angle])]
            if not here:
                continue
            nearest = min(here, key=lambda row: abs(row["theta"] - row[angle]))
            axes.plot(nearest[angle], nearest["varpi_m"], marker, color=style.BLACK, markersize=2.4,
                      zorder=3)
    axes.plot([], [], "v", color=style.BLACK, markersize=3, label="becoming pinned")
    axes.plot([], [], "o", color=style.BLACK, markersize=3, label="becoming free")
    axes.axhline(-1, color=style.GREY, linewidth=0.6, linestyle="--", zorder=0)
    axes.set_xlabel(r"angular position $\theta$ in the M-frame (°); M is at 270°")
    axes.set_ylabel(r"$\langle\varpi_{M,i}\rangle/\Omega$")
    axes.set_xlim(0, 360)
    axes.set_ylim(*style.middle(style.column(
        [row for row in rows if row["visits"] > 200], "varpi_m")))
    axes.set_xticks(range(0, 361, 90))
    axes.legend(loc="best")
    bar = drawing.colorbar(style.scale(numbers, colors), ax=axes)
    bar.set_label(r"number of discs $N$")
    style.save(drawing, table)


if __name__ == "__main__":
    main()
