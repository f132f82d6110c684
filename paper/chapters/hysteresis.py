"""Is there hysteresis? Ramps of a parameter through a change of direction and back."""

import numpy as np
from paper import style, tables
from paper.curves import with_error
from paper.standard_runs import Dish, dish_run, period_of
from paper.engine import swirl
from paper.figure import Figure
from paper.study import Point

BINS = 8  # of the parameter, on each branch
WARMUP = 30
# A difference is certain beyond this many errors. Three are not enough, because the largest of
# several bins is tested.
CERTAIN_DIFFERENCE = 4
# Name, words, dish, packing fraction, parameter of the ramp, from, to (the amplitude in units of
# R).
LOOPS = (
    ("cluster", "cluster, R/r = 8.6", Dish(8.6, 0.22), 0.568, "mu", 0.3, 1.5),
    ("gas", "gas, R/r = 17.2", Dish(17.2, 0.22), 0.25, "amplitude", 0.12, 0.4),
    ("elongated", "elongated cluster, R/r = 34.4", Dish(34.4, 0.22), 0.32, "amplitude", 0.17, 0.27),
)
PARAMETERS = {"mu": r"friction coefficient $\mu$", "amplitude": r"amplitude $A/R$"}


def loop_run(parameters):
    """Means of the rotation in bins of the parameter, upwards and downwards in its order."""
    series = swirl.run(series=True, **parameters).series
    rates = series["rigid_by_time"][series["counted"] > 0]
    bins = np.arange(len(rates)) * 2 * BINS // len(rates)
    means = np.bincount(bins, rates, 2 * BINS) / np.bincount(bins, minlength=2 * BINS)
    return {"up": means[:BINS].tolist(), "down": means[: BINS - 1 : -1].tolist()}


def points(settings):
    branches = [settings.periods(80, BINS)] + (
        [] if settings.quick else [settings.periods(160, BINS)]
    )
    made = []
    for name, words, dish, fraction, parameter, low, high in LOOPS:
        unit = dish.radius if parameter == "amplitude" else 1.0
        for branch in branches:
            end = WARMUP + 2 * branch
            ramp = f"{parameter}={unit * low!r}:{unit * high!r}:{unit * low!r}@{WARMUP}..{end}"
            run = dish_run(dish, dish.discs(fraction))
            if parameter == "amplitude":  # the ramp sets it; the period is that of the dish
                run = {
                    "discs": run["discs"],
                    "container_radius": dish.radius,
                    "period": period_of(run),
                }
            run |= {"ramp": ramp, "warmup": WARMUP, "periods": end}
            made.append(
                Point(
                    settings,
                    f"loop_{name}_{branch}periods",
                    settings.chapter_seeds,
                    run,
                    work=loop_run,
                    cells={
                        "loop": words,
                        "parameter": parameter,
                        "from": low,
                        "to": high,
                        "periods": branch,
                    },
                )
            )
    return made


def table(points, settings):
    rows, findings = [], {}
    for cells, runs in ((p.cells, p.runs) for p in points if p.runs):
        up, down = (np.array([run[name] for run in runs]).T for name in ("up", "down"))
        # The difference within each run is more precise than that of the means, if both branches
        # vary with the seed.
        means = [swirl.mean(values) for values in (up, down, down - up)]
        for k in range(BINS):
            rows.append(
                {
                    "loop": cells["loop"],
                    "parameter": cells["parameter"],
                    "value": cells["from"] + (cells["to"] - cells["from"]) * (k + 0.5) / BINS,
                    "periods": cells["periods"],
                    "seeds": len(runs),
                    **{
                        f"{name}{end}": found[c][k]
                        for name, found in zip(("up", "down", "difference"), means)
                        for c, end in enumerate(("", "_error"))
                    },
                }
            )
        largest = max(range(BINS), key=lambda k: abs(means[2][0][k] / means[2][1][k]))
        difference, error = means[2][0][largest], means[2][1][largest]
        # Ramps become slower, so the last value is that of the slowest ramp.
        findings.setdefault((cells["loop"], cells["parameter"]), []).append(
            (
                f"{with_error(difference, error)} with {cells['periods']} periods for each branch",
                abs(difference) > CERTAIN_DIFFERENCE * error,
            )
        )
    return {"": rows}, [
        f"{loop}, ramp of {parameter}: most certain difference of the branches, down minus up, in "
        f"ϖ/Ω: {'; '.join(words for words, _ in found)}; "
        f"{'' if found[-1][1] else 'no certain '}hysteresis at the slowest ramp."
        for (loop, parameter), found in findings.items()
    ]


def draw(table):
    rows = style.read(table)
    loops = list(dict.fromkeys(row["loop"] for row in rows))
    lengths = style.distinct(rows, "periods")
    drawing, axes = style.figure(style.PAGE, 2.6, ncols=len(loops), squeeze=False)
    for here, loop in zip(axes[0], loops):
        style.zero_line(here)
        for k, length in enumerate(lengths):
            part = tables.select(rows, loop=loop, periods=length)
            for branch, marker, filled in (("up", "^", True), ("down", "v", False)):
                style.curve(
                    here,
                    part,
                    "value",
                    branch,
                    color=style.CYCLE[k],
                    marker=marker,
                    linewidth=0.8,
                    markerfacecolor=style.CYCLE[k] if filled else "white",
                    label=f"{branch}, {length:.0f} periods",
                )
        here.set(title=loop, xlabel=PARAMETERS[part[0]["parameter"]])
    axes[0][0].set_ylabel(r"rotation $\varpi/\Omega$, rigid body")
    style.legend_of_all(drawing, axes[0][0], ncol=4)
    style.save(drawing, table)


FIGURES = [
    Figure(
        "hysteresis",
        "chapters",
        "chapter: ramps through a change of direction and back",
        points,
        table,
        draw,
    )
]
