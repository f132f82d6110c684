"""Figures with a curve ϖ(N) for each value of a parameter that the paper holds fixed."""

from curves import curves_by, rows_of
from paper_parameters import LAST_N
from runs import HIGH, dense_length, length_of, paper_run, text, with_periods
from study import DEFAULT_EVENTS, Point


def curve_points(settings, name, parameter, values, numbers, **parameters):
    """Points at high friction; `parameters` are those of all runs."""
    points = []
    for value in values:
        for discs in numbers:
            # Half of the paper's events: there are many curves, and the errors remain small.
            run = {**paper_run(settings, HIGH, discs), "events": int(settings.events or DEFAULT_EVENTS // 2), **parameters,
                   parameter: value}
            if discs > LAST_N:
                run = with_periods(run, dense_length(settings))
            points.append(Point(settings, f"{name}_{text(value)}_N{discs}_{length_of(run)}", settings.seeds_beyond, run,
                                cells={"curve": text(value), parameter: value, "discs": discs}))
    return points


def curve_tables(points, settings):
    """The rows of all points, and the crossings of the curves."""
    parameter = list(points[0].cells)[1]
    curves = curves_by(points, "curve")
    return ({"": rows_of(points), "_crossings": [curve.row() for curve in curves]},
            [f"{parameter} {curve.name}: {curve.sentence()}" for curve in curves])
