"""Figure 5c: density of the discs in the M-frame, rotating and counterrotating."""

import style
from figure import Figure
from measured_map import points, table_of


def draw(table):
    rows = style.read(table)
    numbers = sorted({row["discs"] for row in rows})
    drawing, axes = style.figure(height=2.3, ncols=len(numbers), squeeze=False)
    densest = max(row["by_event"] for row in rows)
    R = style.map_radius(rows)
    for panel, discs in zip(axes[0], numbers):
        here = style.select(rows, discs=discs)
        shown = style.cells(panel, here, "by_event", R, densest)  # counted by event as in the paper
        style.container(panel, R, color="white")
        panel.set_title(f"$N = {discs:.0f}$")
    drawing.colorbar(shown, ax=axes, orientation="horizontal", shrink=0.5, label=r"discs per unit area ($r^{-2}$)")
    style.note_not_steady(drawing, rows)
    style.save(drawing, table)


FIGURES = [Figure("5c", "paper", "density, N = 28 and 48", points,
                  table_of("density", ("x", "y", "by_event", "by_event_error", "by_time", "by_time_error")), draw)]
