"""Searches for N_c as points of a figure."""

import math

from paper.combine import number
from paper.curves import crossing_cells
from paper.engine import swirl
from paper.study import DEFAULT_EVENTS, Point

PARTS = ("N_c", "N_c_error", "N_c_lower", "N_c_upper")


def search(parameters):
    """The complete result of a search. It has no command: that of the figure makes it."""
    crossing = swirl.crossing(threads=1, **parameters)
    return {**crossing.found, "command": "", "report": crossing.sentence}


def search_point(
    settings, name, parameters, min_discs, max_discs, cells, tolerance=0.2, min_periods=100
):
    """A search. Its runs are shorter if `events` shortens those of the other points, and N_c is as
    uncertain as they are."""
    coarser = math.sqrt(DEFAULT_EVENTS / settings.events_of_a_run)
    shorter = {"events": int(settings.events)} if coarser > 1 else {}
    return Point(
        settings,
        name,
        1,
        {
            **shorter,
            **parameters,
            "min_discs": min_discs,
            "max_discs": max_discs,
            "tolerance": min(tolerance * coarser, 0.1 * (max_discs - min_discs)),
            "min_periods": settings.periods(min_periods, 5),
        },
        work=search,
        cells=cells,
    )


def search_cells(found):
    def numbers(result):
        return [number(result[part]) for part in PARTS]

    steady = (
        "not steady"
        if found["runs_not_steady"]
        else "too short to tell"
        if found["runs_too_short"]
        else "steady"
    )
    return {
        "crosses": found["verdict"] == "crosses",
        **dict(zip(("crossing", "crossing_error", "lower", "upper"), numbers(found))),
        "runs": found["runs"],
        "events": found["events"],
        "runs_not_steady": found["runs_not_steady"],
        "steady_state": steady,
        **crossing_cells({rate: numbers(result) for rate, result in found["by_rate"].items()}),
    }


SEARCH_COLUMNS = [
    *"crosses crossing crossing_error lower upper runs events runs_not_steady steady_state".split(),
    *crossing_cells(
        dict.fromkeys(
            ("mean_by_event", "mean_by_time", "rigid_by_event", "rigid_by_time"), range(4)
        )
    ),
]
