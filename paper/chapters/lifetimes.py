"""How long the two states last at points where runs end in different states, which differ in the mean spin."""

import math

import numpy as np
import style
from curves import with_error
from engine import swirl
from figure import Figure
from study import Point

WINDOW = 20  # periods
# Name, words, the two states, N, μ, threshold, periods. A window has the second state if its mean spin in Ω is below the
# threshold.
PLACES = (("few", "N = 5, μ = 0.1", ("gas", "row that rolls along the wall"), 5, 0.1, -5.0, 10_000),
          ("dense", "N = 52, μ = 1", ("crystal", "rings"), 52, 1.0, -0.065, 600))


def visits(parameters):
    """Periods and exits of both states, ϖ in each, and the state in which the run ends."""
    series = swirl.run(series=True, **{name: value for name, value in parameters.items() if name != "threshold"}).series
    windows = len(series["spin"]) // WINDOW
    spins, rates = (series[name][:windows * WINDOW].reshape(windows, WINDOW).mean(axis=1)
                    for name in ("spin", "rigid_by_time"))
    states = np.array(spins < parameters["threshold"], dtype=int)
    left = states[:-1][states[1:] != states[:-1]]
    return {"periods": [int(np.sum(states == k)) * WINDOW for k in (0, 1)],
            "exits": [int(np.sum(left == k)) for k in (0, 1)],
            "sums": [float(np.sum(rates[states == k])) * WINDOW for k in (0, 1)], "last": int(states[-1])}


def points(settings):
    return [Point(settings, f"lifetimes_{name}", settings.chapter_seeds,
                  {"discs": discs, "mu": mu, "threshold": threshold, "warmup": 0,
                   "periods": settings.periods(periods, 2 * WINDOW)}, work=visits)
            for name, _, _, discs, mu, threshold, periods in PLACES]


def lifetime_of(periods, exits):
    """The mean lifetime of a state with an exponential distribution: the time in the state over the number of exits,
    because the end of a run may cut a visit short. Without an exit it is the lower bound of 95 %, without an error."""
    if not exits:
        return periods / 3, math.nan
    return periods / exits, periods / exits / math.sqrt(exits)


def table(points, settings):
    rows, findings = [], []
    for point, (_, place, states, discs, mu, _, _) in zip(points, PLACES):
        words = []
        for k, state in enumerate(states):
            periods, exits, total = (sum(run[name][k] for run in point.runs) for name in ("periods", "exits", "sums"))
            lifetime, error = lifetime_of(periods, exits)
            rotation = total / periods if periods else math.nan
            ended = sum(run["last"] == k for run in point.runs)
            rows.append({"point": place, "discs": discs, "mu": mu, "state": state, "periods": periods, "exits": exits,
                         "lifetime": lifetime, "lifetime_error": error, "rotation": rotation, "seeds": len(point.runs),
                         "share_ended": ended / len(point.runs) if point.runs else None})
            lasts = f"{with_error(lifetime, error)} periods" if exits else f"more than {lifetime:.0f} periods"
            words.append(f"{state}: {lasts}, ϖ/Ω = {rotation:.3f}, {ended} of {len(point.runs)} seeds end in it"
                         if periods else f"{state}: not visited")
        findings.append(f"{place}: lifetime of the state {'; '.join(words)}.")
    return {"": rows}, findings


def draw(table):
    rows = [row for row in style.read(table) if row["periods"] > 0]
    drawing, axes = style.figure(height=0.5 + 0.4 * len(rows))
    for k, row in enumerate(rows):
        color = style.CYCLE[0 if row["exits"] else 1]
        if row["exits"]:
            axes.errorbar(row["lifetime"], k, xerr=row["lifetime_error"], fmt="o", color=color, elinewidth=0.9)
        else:
            axes.plot(row["lifetime"], k, ">", color=color, markersize=5)
    axes.plot([], [], "o", color=style.CYCLE[0], label="mean lifetime")
    axes.plot([], [], ">", color=style.CYCLE[1], label="no exit: lower bound, 95 %")
    axes.set_xscale("log")
    axes.set_yticks(range(len(rows)), [f"{row['point']}:\n{row['state']}" for row in rows])
    axes.set(ylim=(len(rows) - 0.5, -0.5), xlabel="lifetime (periods)")
    style.legend(axes, ncol=1)
    style.save(drawing, table)


FIGURES = [Figure("lifetimes", "chapters", "chapter: how long coexisting states last", points, table, draw)]
