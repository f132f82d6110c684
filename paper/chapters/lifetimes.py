"""How long the two states last at points where runs end in different states, which differ in the
mean spin."""

import math

import numpy as np
from paper import style
from paper.curves import with_error
from paper.engine import swirl
from paper.figure import Figure
from paper.study import Point

WINDOW = 20  # periods
# Name, words, the two states, N, μ, threshold, periods. A window has the second state if its mean
# spin in Ω is below the threshold.
PLACES = (
    ("few", "N = 5, μ = 0.1", ("gas", "row that rolls along the wall"), 5, 0.1, -5.0, 10_000),
    ("dense", "N = 52, μ = 1", ("crystal", "rings"), 52, 1.0, -0.065, 600),
)


# --- Two states, also of other chapters ---------------------------------------------------------


def window_means(parameters, columns, window, measure=()):
    """{name: means in windows of the run after its warm-up} of columns {name: that of the
    series}."""
    series = swirl.run(series=True, measure=list(measure), **parameters).series
    rows = np.array([series[column] for column in columns.values()])[:, series["counted"] > 0]
    count = rows.shape[1] // window
    means = rows[:, : count * window].reshape(len(columns), count, window).mean(axis=2)
    return dict(zip(columns, np.round(means, 5).tolist()))


def visits(all_states, state, window):
    """(periods in the state, exits) of several runs."""
    inside = sum(int(np.sum(states == state)) for states in all_states)
    return inside * window, sum(
        int(np.sum((states[:-1] == state) & (states[1:] == 1 - state))) for states in all_states
    )


def lifetime_of(periods, exits):
    """The mean lifetime of a state with an exponential distribution: the time in the state over the
    number of exits, because the end of a run may cut a visit short. Without an exit it is the lower
    bound of 95 %, without an error."""
    if not exits:
        return periods / 3 if periods else math.nan, math.nan
    return periods / exits, periods / exits / math.sqrt(exits)


def state_cells(all_states, rates, state, window, ending=""):
    """Columns of a state: its time, exits and lifetime, ϖ/Ω in it, and the share of the runs that
    end in it."""
    periods, exits = visits(all_states, state, window)
    life, error = lifetime_of(periods, exits)
    inside = np.concatenate(
        [np.array(rate)[states == state] for rate, states in zip(rates, all_states)]
    )
    return {
        f"periods{ending}": periods,
        f"exits{ending}": exits,
        f"lifetime{ending}": life,
        f"lifetime{ending}_error": error,
        f"rotation{ending}": float(inside.mean()) if periods else math.nan,
        f"share_ended{ending}": sum(states[-1] == state for states in all_states) / len(all_states),
    }


def state_words(name, row, ending=""):
    if not row[f"periods{ending}"]:
        return f"{name}: not visited"
    life = with_error(row[f"lifetime{ending}"], row[f"lifetime{ending}_error"])
    return (
        f"{name}: {'' if row[f'exits{ending}'] else 'more than '}{life} periods, "
        f"{row[f'exits{ending}']} exits, ϖ/Ω = "
        f"{row[f'rotation{ending}']:.3f}, {100 * row[f'share_ended{ending}']:.0f} % of the runs "
        "end in it"
    )


# --- This chapter ---------------------------------------------------------------------------------


def windows_of(parameters):
    return window_means(
        {name: value for name, value in parameters.items() if name != "threshold"},
        {"spin": "spin", "rotation": "rigid_by_time"},
        WINDOW,
    )


def points(settings):
    return [
        Point(
            settings,
            f"lifetimes_{name}",
            settings.chapter_seeds,
            {
                "discs": discs,
                "mu": mu,
                "threshold": threshold,
                "warmup": 0,
                "periods": settings.periods(periods, 2 * WINDOW),
            },
            work=windows_of,
        )
        for name, _, _, discs, mu, threshold, periods in PLACES
    ]


def table(points, settings):
    rows, findings = [], []
    for point, (_, place, states, discs, mu, threshold, _) in zip(points, PLACES):
        if not point.runs:
            continue
        found = [(np.array(run["spin"]) < threshold).astype(int) for run in point.runs]
        here = [
            {
                "point": place,
                "discs": discs,
                "mu": mu,
                "state": state,
                "seeds": len(found),
                **state_cells(found, [run["rotation"] for run in point.runs], k, WINDOW),
            }
            for k, state in enumerate(states)
        ]
        rows += here
        findings.append(
            f"{place}: lifetime of the state "
            f"{'; '.join(state_words(row['state'], row) for row in here)}."
        )
    return {"": rows}, findings


def draw(table):
    rows = [row for row in style.read(table) if row["periods"] > 0]
    drawing, axes = style.figure(height=0.5 + 0.4 * len(rows))
    for marker, color, words in (
        ("o", style.CYCLE[0], "mean lifetime"),
        (">", style.CYCLE[1], "no exit: lower bound, 95 %"),
    ):
        here = [
            (row["lifetime"], k, row["lifetime_error"])
            for k, row in enumerate(rows)
            if (marker == "o") == (row["exits"] > 0)
        ]
        x, y, error = zip(*here) if here else ((), (), ())
        axes.errorbar(
            x, y, xerr=np.nan_to_num(error), fmt=marker, color=color, elinewidth=0.9, label=words
        )
    axes.set_xscale("log")
    axes.set_yticks(range(len(rows)), [f"{row['point']}:\n{row['state']}" for row in rows])
    axes.set(ylim=(len(rows) - 0.5, -0.5), xlabel="lifetime (periods)")
    style.legend(axes, ncol=1)
    style.save(drawing, table)


FIGURES = [
    Figure("lifetimes", "chapters", "chapter: how long coexisting states last", points, table, draw)
]
