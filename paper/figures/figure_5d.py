"""Figure 5d: velocity of the discs relative to the container, in the M-frame."""

import style
from figure import Figure
from measured_map import points, table_of

LEAST_SHARE = 1e-4  # of all visits: cells with fewer have no arrow


def draw(table):
    rows = style.read(table)
    numbers = sorted({row["discs"] for row in rows})
    drawing, axes = style.figure(width=style.PAGE, height=3.6, ncols=len(numbers), squeeze=False)
    R = style.map_radius(rows)
    spacing = 2 * R / len({row["x"] for row in rows})
    flows = [style.often_visited(style.select(rows, discs=discs), LEAST_SHARE) for discs in numbers]
    # One scale for both panels.
    fastest = max((style.speed(row) for flow in flows for row in flow), default=1.0)
    for panel, discs, flow in zip(axes[0], numbers, flows):
        style.container(panel, R)
        if flow:
            style.arrows(panel, flow, spacing, fastest, color=style.BLUE)
        panel.set_title(f"$N = {discs:.0f}$")
    style.note_not_steady(drawing, rows)
    style.save(drawing, table)


FIGURES = [Figure("5d", "paper", "flow relative to the container, N = 28 and 48", points,
                  table_of("flow", ("x", "y", "visits", "u_x", "u_x_error", "u_y", "u_y_error")), draw)]
