"""Beyond the paper: a curve ϖ(N) for each value of a parameter that the paper holds fixed."""

from paper import style
from paper.curves import curve_tables, curves_by
from paper.figure import Figure
from paper.paper_parameters import LAST_N
from paper.runs import (
    HIGH,
    dense_length,
    length_of,
    numbers_beyond,
    paper_run,
    sparse_numbers,
    text,
    with_periods,
)
from paper.study import DEFAULT_EVENTS, Point


def curve_points(settings, name, parameter, values, numbers, **parameters):
    """Points at high friction; `parameters` are those of all runs."""
    points = []
    for value in values:
        for discs in numbers:
            # Half of the paper's events: there are many curves, and the errors remain small.
            run = {
                **paper_run(settings, HIGH, discs),
                "events": int(settings.events or DEFAULT_EVENTS // 2),
                **parameters,
                parameter: value,
            }
            if discs > LAST_N:
                run = with_periods(run, dense_length(settings))
            points.append(
                Point(
                    settings,
                    f"{name}_{text(value)}_N{discs}_{length_of(run)}",
                    settings.seeds_beyond,
                    run,
                    cells={"curve": text(value), parameter: value, "discs": discs},
                )
            )
    return points


def tables_of(points, settings):
    """The rows of all points, and the crossings of the curves."""
    parameter = list(points[0].cells)[1]
    curves = curves_by(points, "curve")
    return curve_tables(points, curves), [
        f"{parameter} {curve.name}: {curve.sentence()}" for curve in curves
    ]


def inertia_points(settings):
    """I = 1/2 is a solid disc, I = 1 a ring, and I = 10 the paper's. Discs with a physical inertia
    cross beyond the paper's last N, if at all."""
    return curve_points(
        settings,
        "inertia",
        "inertia",
        (0.5, 1.0, 3.0, 10.0, 100.0, 1e4),
        sparse_numbers(settings) + numbers_beyond(settings),
    )


def restitution_points(settings):
    return curve_points(
        settings, "restitution", "restitution", (1.0, 0.99, 0.9), sparse_numbers(settings)
    )


def tangential_points(settings):
    """Solid discs."""
    return curve_points(
        settings,
        "tangential",
        "tangential_restitution",
        (0.0, 0.5, 1.0),
        sparse_numbers(settings),
        inertia=0.5,
    )


def drawn_by(parameter, symbol):
    """A curve for each value of the parameter."""

    def draw(table):
        curves = [
            (here, {"label": f"${symbol} = {value:g}$", **look})
            for value, here, look in style.groups(style.read(table), parameter)
        ]
        style.rotation_figure(table, curves, ncol=3)

    return draw


FIGURES = [
    Figure(
        "inertia",
        "beyond",
        "beyond the paper: moment of inertia ½ to 10⁴",
        inertia_points,
        tables_of,
        drawn_by("inertia", "I"),
    ),
    Figure(
        "restitution",
        "beyond",
        "beyond the paper: restitution e = 1, 0.99, 0.9",
        restitution_points,
        tables_of,
        drawn_by("restitution", "e"),
    ),
    Figure(
        "tangential",
        "beyond",
        "beyond the paper: tangential restitution, solid discs",
        tangential_points,
        tables_of,
        drawn_by("tangential_restitution", r"\beta"),
    ),
]
