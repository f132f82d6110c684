"""Beyond the paper: without disc friction the cluster condenses. The waiting time against the
number of discs, and the granular temperature before and after."""

import numpy as np
from paper import style
from paper.combine import at, min_periods, number
from paper.curves import with_error
from paper.engine import result_of, simulation_of, swirl
from paper.figure import Figure
from paper.paper_parameters import COUNTERROTATING_N, ROTATING_N
from paper.runs import NO_DISC, paper_run, with_periods
from paper.study import Point

LITTLE_MOTION = 0.1  # of ΩR
QUIET = 10  # periods with little motion, until the cluster counts as condensed
AFTER = 50  # periods, averaged after the condensation
AVERAGES = {
    "granular": ("temperature", "granular"),
    "coordination": ("frustration", "coordination"),
    "wall_spin": ("frustration", "wall_spin"),
    "spin_correlation": ("frustration", "spin_correlation"),
    "mean_by_time": ("rotation", "mean_by_time"),
}


def find_condensation(parameters):
    """(whether it condenses, the period, events until then). The cluster counts as condensed from
    the first period in which the mean speed of the discs in the M-frame is below a tenth of the
    wall's, ΩR, if it stays there for ten periods (in a gas that speed is about ΩR). If it does not
    condense: the length of the run."""
    simulation = simulation_of(parameters)
    condensed, quiet = None, 0
    for period in range(parameters["periods"]):
        events = simulation.counts.total
        velocity = simulation.sample(1, 64).m_frame().velocity
        speed = np.hypot(velocity[..., 0], velocity[..., 1]).mean() / (
            simulation.omega * simulation.container_radius
        )
        quiet = quiet + 1 if speed < LITTLE_MOTION else 0
        if quiet == 1:
            condensed = True, period, events
        if quiet == QUIET:
            return condensed
    return False, parameters["periods"], simulation.counts.total


def condensation(parameters):
    condensed, period, events = find_condensation(parameters)

    def averages(begin, end):
        if end - begin < min_periods():
            return {}
        run = result_of(
            {**parameters, "warmup": begin, "periods": end}, ["temperature", "frustration"]
        )
        return {**run["measured"], "rotation": run["rotation"]}

    after = period + QUIET
    return {
        "condensed": condensed,
        "periods": period,
        "events": events,
        "before": averages(0, period),
        "after": averages(after, after + AFTER) if condensed else {},
    }


def points(settings):
    numbers = (
        [ROTATING_N, COUNTERROTATING_N] if settings.quick else [16, 20, 24, 28, 32, 36, 40, 44, 48]
    )
    length = {"warmup": 0, "periods": settings.periods(400, 20)}
    return [
        Point(
            settings,
            f"condensation_N{discs}",
            settings.seeds,
            with_periods(paper_run(settings, NO_DISC, discs), length),
            work=condensation,
            cells={"discs": discs},
        )
        for discs in numbers
    ]


def table(points, settings):
    rows, findings = [], []
    for point in points:
        runs, N = point.runs, point.cells["discs"]
        if not runs:
            continue
        found = [run for run in runs if run["condensed"]]
        waiting = [run["periods"] for run in found]
        mean, error = swirl.mean(waiting)[:2] if found else (None, None)
        longest = max(run["periods"] for run in runs)
        row = {
            "discs": N,
            "seeds": len(runs),
            "condensed": len(found),
            "waiting": mean,
            "waiting_error": error,
            "shortest": min(waiting, default=0),
            "longest": longest,
            "events": sum(run["events"] for run in found) / len(found) if found else None,
        }
        for phase in ("before", "after"):
            for column, path in AVERAGES.items():
                # A transient has no error within a run, since its blocks differ systematically.
                row[f"{phase}_{column}"], row[f"{phase}_{column}_error"] = swirl.mean(
                    [number(at(run, phase, *path, "mean")) for run in runs]
                )[:2]
        rows.append(row)
        findings.append(
            f"μ_d = 0, N = {N}: "
            + (
                f"{len(found)} of {len(runs)} runs condense, after {with_error(mean, error)} "
                f"periods ({min(waiting)} to {longest})."
                if found
                else f"none of {len(runs)} runs condenses within {longest} periods."
            )
        )
    return {"": rows}, findings


def draw(table):
    rows = style.read(table)
    drawing, (waiting, heat) = style.figure(height=3.8, nrows=2, sharex=True)
    found = [row for row in rows if row["condensed"]]
    if found:
        style.curve(waiting, found, "discs", "waiting", color=style.BLUE, marker="o", label="mean")
        for end, marker in (("shortest", "v"), ("longest", "^")):
            waiting.plot(
                style.column(found, "discs"),
                style.column(found, end),
                marker,
                color=style.GREY,
                markersize=3,
                label=end,
            )
    waiting.set_ylim(bottom=0)
    waiting.set_ylabel("waiting time (periods)")
    style.legend(waiting, ncol=3)
    for phase, color, marker in (("before", style.RED, "s"), ("after", style.BLUE, "o")):
        name = f"{phase}_granular"
        style.curve(
            heat,
            [row for row in rows if row[name] == row[name]],
            "discs",
            name,
            color=color,
            marker=marker,
            label=phase,
        )
    heat.set(yscale="log", ylabel="temp. ($m v_c^2$)", xlabel="number of discs $N$")
    style.legend(heat)
    style.save(drawing, table)


FIGURES = [
    Figure(
        "condensation",
        "beyond",
        "beyond the paper: without disc friction a gas condenses, μ_d = 0",
        points,
        table,
        draw,
    )
]
