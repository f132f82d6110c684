"""Figures 2b and 2c: density of the discs in the M-frame, and their velocity relative to the container."""

import style
from paper_parameters import AMPLITUDES

LEAST_SHARE = 2e-4  # of all visits: cells with fewer have no arrow


def draw(table):
    rows = style.read(table)
    settings = [name for name in style.LOOKS if style.select(rows, setting=name)]
    drawing, panels = style.figure(width=style.PAGE if len(settings) > 1 else style.COLUMN, height=3.0,
                                   ncols=len(settings), squeeze=False)
    for axes, setting in zip(panels[0], settings):
        density = style.select(rows, map="density", setting=setting)
        R = style.map_radius(density)
        shown = style.cells(axes, density, "density", R)
        # On the density map, several cells share an arrow; Figure 5d has one arrow per cell.
        cells = style.select(rows, map="flow", setting=setting)
        spacing = style.COARSE * 2 * R / len({row["x"] for row in cells})
        flow = style.often_visited(style.blocks(cells, style.COARSE), LEAST_SHARE)
        if flow:
            style.arrows(axes, flow, spacing, max(map(style.speed, flow)), color="white")
        style.container(axes, R, color="white", amplitude=AMPLITUDES.get(setting, style.AMPLITUDE))
        axes.set_title(f"{style.LOOKS[setting][0]}, $N = {rows[0]['discs']:.0f}$")
        bar = drawing.colorbar(shown, ax=axes, shrink=0.85)
        bar.set_label(r"particles per unit area ($r^{-2}$)")
    style.note_not_steady(drawing, rows)
    style.save(drawing, table)
