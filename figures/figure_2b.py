"""Figures 2b and 2c: density of the discs in the M-frame, and their velocity relative to the container.

    /usr/bin/python3 figures/figure_2b.py out/figure_2b.csv
"""

import style

LEAST_SHARE = 2e-4  # of all visits: cells with fewer have no arrow


def main():
    table = style.table_from_arguments("figure_2b")
    rows = style.read(table)
    drawing, axes = style.figure(height=3.0)
    density = style.select(rows, map="density")
    R = style.map_radius(density)
    shown = style.cells(axes, density, "density", R)
    # On the density map, several cells share an arrow; Figure 5d has one arrow per cell.
    cells = style.select(rows, map="flow")
    spacing = style.COARSE * 2 * R / len({row["x"] for row in cells})
    flow = style.often_visited(style.blocks(cells, style.COARSE), LEAST_SHARE)
    if flow:
        style.arrows(axes, flow, spacing, max(map(style.speed, flow)), color="white")
    style.container(axes, R, color="white")
    axes.set_title(f"$N = {rows[0]['discs']:.0f}$")
    bar = drawing.colorbar(shown, ax=axes, shrink=0.85)
    bar.set_label(r"discs per unit area ($r^{-2}$)")
    style.note_not_steady(drawing, rows)
    style.save(drawing, table)


if __name__ == "__main__":
    main()
