"""The shortest times between collisions, with and without friction, as a table only. The paper:
"The minimal time between collisions is around 10^-11 and 10^-9 with and without friction,
respectively" (SI, "Finding the next event")."""

import math

import numpy as np
from paper.combine import failed
from paper.engine import simulation_of, swirl
from paper.figure import Figure
from paper.paper_parameters import COUNTERROTATING_N
from paper.runs import Friction, paper_run
from paper.study import Point

EVENTS_AT_ONCE = 100_000


def shortest_time(parameters):
    """Between two consecutive collisions, anywhere in the container."""
    simulation = simulation_of(parameters)
    shortest, last, left = math.inf, np.zeros((0, 2)), parameters["events"]
    while left > 0:
        events = simulation.step(min(left, EVENTS_AT_ONCE))
        left -= len(events)
        events = events[events["kind"] <= swirl.EventKind.disc_wall]
        times = np.concatenate([last, np.column_stack([events["whole_periods"], events["clock"]])])
        # Clocks restart with each period. One pair in thousands spans two periods; it is skipped.
        steps = np.diff(times, axis=0)
        steps = steps[(steps[:, 0] == 0) & (steps[:, 1] > 0), 1]
        shortest, last = min([shortest, *steps]), times[-1:]
    return {"events": parameters["events"], "smallest": shortest}


def points(settings):
    return [
        Point(
            settings,
            f"times_mu{mu}",
            settings.seeds,
            paper_run(settings, Friction("", "", mu, mu), COUNTERROTATING_N),
            work=shortest_time,
            cells={"mu": mu, "discs": COUNTERROTATING_N},
        )
        for mu in (1, 0)
    ]


def table(points, settings):
    rows, findings = [], []
    for point in points:
        rows += [
            {**point.cells, "seed": k + 1, **task.result, "point": point.name}
            for k, task in enumerate(point.tasks)
            if not failed(task.result)
        ]
        found = [run["smallest"] for run in point.runs]
        if found:
            findings.append(
                f"μ = {point.cells['mu']}, N = {COUNTERROTATING_N}: the shortest time between two "
                f"collisions of a run lies between {min(found):.1g} and {max(found):.1g}."
            )
    return {"": (rows, ["mu", "discs", "seed", "events", "smallest", "point"])}, findings


FIGURES = [Figure("times", "beyond", "the shortest times between collisions", points, table)]
