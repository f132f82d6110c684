"""Figures 5c and 5d: density of the discs in the M-frame, and their velocity relative to the
container, rotating and counterrotating."""

from paper import style
from paper.combine import failed, steadiness
from paper.figure import Figure
from paper.paper_parameters import COUNTERROTATING_N, ROTATING_N
from paper.runs import HIGH, measured_point

LEAST_SHARE = 1e-4  # of all visits: cells with fewer have no arrow


def points(settings):
    return [measured_point(settings, HIGH, discs) for discs in (ROTATING_N, COUNTERROTATING_N)]


def table_of(measurement, columns):
    def table(points, settings):
        rows = [
            {
                "discs": point.cells["discs"],
                "steady_state": steadiness(point.result),
                **dict(zip(columns, cells)),
            }
            for point in points
            if not failed(point.result)
            for cells in zip(*(point.result["measured"][measurement][column] for column in columns))
        ]
        return {"": (rows, ["discs", "steady_state", *columns])}, []

    return table


def draw_density(table):
    rows = style.read(table)
    numbers = style.distinct(rows, "discs")
    drawing, axes = style.figure(height=2.3, ncols=len(numbers), squeeze=False)
    densest = max(row["by_event"] for row in rows)
    R = style.map_radius(rows)
    for panel, discs in zip(axes[0], numbers):
        here = style.select(rows, discs=discs)
        shown = style.cells(panel, here, "by_event", R, densest)  # counted by event as in the paper
        style.container(panel, R, color="white")
        panel.set_title(f"$N = {discs:.0f}$")
    drawing.colorbar(
        shown,
        ax=axes,
        orientation="horizontal",
        shrink=0.5,
        label=r"discs per unit area ($r^{-2}$)",
    )
    style.note_not_steady(drawing, rows)
    style.save(drawing, table)


def draw_flow(table):
    rows = style.read(table)
    numbers = style.distinct(rows, "discs")
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


FIGURES = [
    Figure(
        "5c",
        "paper",
        "density, N = 28 and 48",
        points,
        table_of("density", ("x", "y", "by_event", "by_event_error", "by_time", "by_time_error")),
        draw_density,
    ),
    Figure(
        "5d",
        "paper",
        "flow relative to the container, N = 28 and 48",
        points,
        table_of("flow", ("x", "y", "visits", "u_x", "u_x_error", "u_y", "u_y_error")),
        draw_flow,
    ),
]
