"""Figure 5a: the simulated discs in the lab, each with a line that turns with it.

    /usr/bin/python3 figures/figure_5a.py out/figure_5a.csv
"""

import math

import style


def main():
    table = style.table_from_arguments("figure_5a")
    rows = style.read(table)
    numbers = sorted({row["discs"] for row in rows})
    drawing, axes = style.figure(height=2.05, ncols=len(numbers), squeeze=False)
    largest = max(abs(row["spin"]) for row in rows)
    colors = style.plt.get_cmap("PuOr")
    for place, discs in zip(axes[0], numbers):
        here = style.select(rows, discs=discs)
        centre = (here[0]["container_x"], here[0]["container_y"])
        style.dish(place, here[0]["container_radius"], centre)
        for row in here:
            r = row["radius"]
            place.add_patch(style.plt.Circle((row["x"], row["y"]), r, linewidth=0.4,
                                             facecolor=colors(0.5 + 0.5 * row["spin"] / largest),
                                             edgecolor=style.BLACK))
            place.plot([row["x"], row["x"] + r * math.cos(row["angle"])],
                       [row["y"], row["y"] + r * math.sin(row["angle"])],
                       color=style.BLACK, linewidth=0.5)
        place.plot(0, 0, "+", color=style.GREY, markersize=4)
        place.set_title(f"$N = {discs:.0f}$")
    bar = drawing.colorbar(style.scale([-largest, largest], colors), ax=axes, shrink=0.8)
    bar.set_label(r"spin $\omega_i/\Omega$")
    style.save(drawing, table)


if __name__ == "__main__":
    main()
