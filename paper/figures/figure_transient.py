"""Beyond the paper: without disc friction, rotation and mean spin against time from rest."""

import math

import numpy as np
from paper import style
from paper.curves import with_error
from paper.engine import swirl
from paper.figure import Figure
from paper.paper_parameters import EVENTS
from paper.runs import NO_DISC, paper_run, with_periods
from paper.study import Point

SEEDS = 4


def transient(parameters):
    """For each period of a run that starts from rest: ϖ/Ω, mean spin/Ω, and the number of events up
    to its end."""
    series = swirl.run(series=True, **parameters).series
    return {
        "varpi": series["mean_by_time"].tolist(),
        "spin": series["spin"].tolist(),
        "events": np.cumsum(series["events"]).tolist(),
    }


def points(settings):
    length = {"warmup": 0, "periods": settings.periods(600, 20)}
    return [
        Point(
            settings,
            f"transient_N{discs}",
            SEEDS,
            with_periods(paper_run(settings, NO_DISC, discs), length),
            work=transient,
            cells={"discs": discs},
        )
        for discs in ([48] if settings.quick else [40, 44, 46, 48])
    ]


def table(points, settings):
    rows, findings = [], []
    for point in points:
        discs, runs = point.cells["discs"], point.runs
        if not runs:
            continue
        varpi, spin = (
            swirl.mean(np.array([run[name] for run in runs]).T) for name in ("varpi", "spin")
        )
        events = np.mean([run["events"] for run in runs], axis=0)
        periods = len(events)
        rows += [
            {
                "discs": discs,
                "period": t + 1,
                "varpi": varpi[0][t],
                "varpi_error": varpi[1][t],
                "spin": spin[0][t],
                "spin_error": spin[1][t],
                "events": events[t],
            }
            for t in range(periods)
        ]
        reached = [t + 1 for t in range(periods) if events[t] >= EVENTS]
        findings.append(
            f"μ_d = 0, N = {discs}: ϖ/Ω = {np.mean(varpi[0][:periods // 10]):.3f} in the first "
            f"{periods // 10} periods, "
            f"{np.mean(varpi[0][periods // 2:]):.4f} in the last {periods - periods // 2}, with a "
            f"mean spin of {with_error(spin[0][-1], math.nan)} Ω at the end; 10^6 events last "
            f"{reached[0] if reached else f'more than {periods}'} periods."
        )
    return {"": rows}, findings


def smoothed(rows, name, width=10):
    """Means over `width` periods, and the middles of these intervals."""
    blocks = [rows[k : k + width] for k in range(0, len(rows) - width + 1, width)]
    return (
        [sum(style.column(b, "period")) / width for b in blocks],
        [sum(style.column(b, name)) / width for b in blocks],
    )


def draw(table):
    rows = style.read(table)
    drawing, (rotation, spin) = style.figure(height=3.6, nrows=2, sharex=True)
    rotation.axhline(1, color=style.GREY, linewidth=0.6, zorder=0)
    for discs, curve, look in style.groups(rows, "discs"):
        after = [row["period"] for row in curve if row["events"] >= EVENTS]
        for axes, name in ((rotation, "varpi"), (spin, "spin")):
            axes.plot(*smoothed(curve, name), markevery=5, label=f"$N = {discs:.0f}$", **look)
            if after:
                axes.axvline(after[0], color=look["color"], linewidth=0.7, linestyle="--")
    rotation.set_ylabel(r"$\varpi/\Omega$")
    spin.set_ylabel(r"mean spin $\langle\omega_i\rangle/\Omega$")
    spin.set_xlabel(r"periods from rest (dashed: the paper's $10^6$ events)")
    style.legend(rotation, ncol=4)
    style.save(drawing, table)


FIGURES = [
    Figure(
        "transient",
        "beyond",
        "beyond the paper: spin and rotation from rest, μ_d = 0",
        points,
        table,
        draw,
    )
]
