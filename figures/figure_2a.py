"""Figure 2a: discs pinned to the wall and loose ones, in the M-frame.

    /usr/bin/python3 figures/figure_2a.py out/figure_2a.csv
"""

import style


def main():
    table = style.table_from_arguments("figure_2a")
    rows = style.read(table)
    numbers = sorted({row["discs"] for row in rows})
    drawing, axes = style.figure(height=1.95, ncols=len(numbers), squeeze=False)
    for place, discs in zip(axes[0], numbers):
        R = rows[0]["container_radius"]
        style.dish(place, R)
        for row in style.select(rows, discs=discs):
            color = style.RED if row["pinned"] else style.BLUE
            place.add_patch(style.plt.Circle((row["x_m"], row["y_m"]), row["radius"], color=color,
                                             alpha=0.3, linewidth=0))
            place.plot(row["x_m"], row["y_m"], "o" if row["pinned"] else "s", color=color,
                       markersize=2)
        place.set_title(f"$N = {discs:.0f}$")
    axes[0][0].plot([], [], "o", color=style.RED, label="pinned")
    axes[0][0].plot([], [], "s", color=style.BLUE, label="loose")
    drawing.legend(*axes[0][0].get_legend_handles_labels(), loc="lower center", ncol=2)
    style.save(drawing, table)


if __name__ == "__main__":
    main()
