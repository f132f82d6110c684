"""Figures 2b and 2c: density of the discs in the M-frame, and their velocity relative to the
container."""

from paper import style
from paper.combine import failed, steadiness
from paper.figure import Figure
from paper.paper_parameters import AMPLITUDES, COUNTERROTATING_N, ROTATING_N
from paper.runs import HIGH, SMOOTH, measured_point

LEAST_SHARE = 2e-4  # of all visits: cells with fewer have no arrow
COLUMNS = (
    "setting",
    "map",
    "discs",
    "steady_state",
    "x",
    "y",
    "density",
    "density_error",
    "u_x",
    "u_x_error",
    "u_y",
    "u_y_error",
    "visits",
)


def points_at(discs):
    return lambda settings: [
        measured_point(settings, friction, discs) for friction in (HIGH, SMOOTH)
    ]


def table(points, settings):
    """Density and flow in one table: rows of one have no values of the other."""
    rows = []
    for point in points:
        if failed(point.result):
            continue
        for name in ("density", "flow"):
            found = point.result["measured"][name]
            names = (
                {"density": "by_time", "density_error": "by_time_error"}
                if name == "density"
                else {}
            )
            first = dict(
                zip(
                    COLUMNS,
                    (point.cells["setting"], name, point.cells["discs"], steadiness(point.result)),
                )
            )
            shown = COLUMNS[4:8] if name == "density" else (*COLUMNS[4:6], *COLUMNS[8:])
            for cells in zip(*(found[names.get(column, column)] for column in shown)):
                rows.append({**dict.fromkeys(COLUMNS), **first, **dict(zip(shown, cells))})
    return {"": (rows, COLUMNS)}, []


def draw(table):
    rows = style.read(table)
    settings = [name for name in style.LOOKS if style.select(rows, setting=name)]
    drawing, panels = style.figure(
        width=style.PAGE if len(settings) > 1 else style.COLUMN,
        height=3.0,
        ncols=len(settings),
        squeeze=False,
    )
    densest = max(row["density"] for row in style.select(rows, map="density"))
    for axes, setting in zip(panels[0], settings):
        density = style.select(rows, map="density", setting=setting)
        R = style.map_radius(density)
        shown = style.cells(axes, density, "density", R, densest)
        # On the density map, several cells share an arrow; Figure 5d has one arrow per cell.
        cells = style.select(rows, map="flow", setting=setting)
        spacing = style.COARSE * 2 * R / len({row["x"] for row in cells})
        flow = style.often_visited(style.blocks(cells, style.COARSE), LEAST_SHARE)
        if flow:
            style.arrows(axes, flow, spacing, max(map(style.speed, flow)), color="white")
        style.container(axes, R, color="white", amplitude=AMPLITUDES.get(setting, style.AMPLITUDE))
        axes.set_title(f"{style.LOOKS[setting][0]}, $N = {rows[0]['discs']:.0f}$")
    drawing.colorbar(shown, ax=panels, shrink=0.85, label=r"particles per unit area ($r^{-2}$)")
    style.note_not_steady(drawing, rows)
    style.save(drawing, table)


FIGURES = [
    Figure(
        "2b",
        "paper",
        "density and flow of a rotating cluster, N = 28",
        points_at(ROTATING_N),
        table,
        draw,
    ),
    Figure(
        "2c",
        "paper",
        "density and flow of a counterrotating cluster, N = 48",
        points_at(COUNTERROTATING_N),
        table,
        draw,
    ),
]
