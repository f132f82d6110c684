"""Figures 2b and 2c: density of the discs in the M-frame, and how they move against the container.

    /usr/bin/python3 figures/figure_2b.py out/figure_2b.csv
"""

import style


def main():
    table = style.table_from_arguments("figure_2b")
    rows = style.read(table)
    drawing, axes = style.figure(height=3.0)
    density = style.select(rows, map="density")
    R = max(row["x"] for row in density) * 100 / 99
    shown = style.cells(axes, density, "density", R)
    # Every cell would have an arrow of its own in 5d; here they lie on the density.
    cells = style.select(rows, map="flow")
    spacing = style.COARSE * 2 * R / len({row["x"] for row in cells})
    flow = style.often_visited(style.blocks(cells, style.COARSE), 2e-4)
    if flow:
        style.arrows(axes, flow, spacing, max(map(style.speed, flow)), color="white")
    style.dish(axes, R, color="white")
    axes.set_title(f"$N = {rows[0]['discs']:.0f}$")
    bar = drawing.colorbar(shown, ax=axes, shrink=0.85)
    bar.set_label(r"discs per unit area ($r^{-2}$)")
    style.note_not_steady(drawing, rows)
    style.save(drawing, table)


if __name__ == "__main__":
    main()
