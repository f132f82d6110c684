"""Round clusters and elongated ones at the same parameters, and how long each lasts; both are
prepared on purpose, in dishes of several sizes at one packing fraction, against the amplitude A/R.
In a transition of first order both lifetimes are much longer than the motion within a state, they
grow with the size of the dish, and a line of equal lifetimes separates the states. The lifetimes
here cannot show that: windows are told apart by their elongation alone, and an elongated cluster is
a rotating wave at R/r = 34.4, but also an ellipse at rest at 48 (AXES). Rotation and rate of the
axis tell these apart. `--replicates 64 --events 3.4e6` runs 64 seeds for 1000 periods, and `--part K/N`
divides the runs among the jobs of a cluster (docs/how-to/reproduce_paper.md)."""

import math

import numpy as np
from paper import style, tables
from paper.chapters.lifetimes import state_cells, state_words, window_means
from paper.cluster_axis import axis_of
from paper.combine import means
from paper.curves import with_error
from paper.standard_runs import Dish, dish_run, period_of
from paper.engine import swirl
from paper.figure import Figure
from paper.study import Point

FRACTION = 0.32
WINDOW = 5  # periods
RATE_STEP = 0.01  # Ω, of the distribution
PREPARED = 90  # periods before the first window
PREPARATIONS = ("round", "elongated")
# A ramp of A/R brings the cluster into a state, and then to the amplitude of the point.
ELONGATING = (0.27, 0.222, 0.222)
ELONGATED, ROUND = 1.25, 1.15  # the elongation above, below which a window is certainly in a state
# For R/r: A/R of the points, the A/R of the ramp that prepares a round cluster, and the length of a
# run relative to the others, since a period at R/r = 60 has 10⁵ events.
DISHES = {
    24.0: ((0.2, 0.209, 0.2137), 0.19, 1),
    28.0: ((0.2, 0.2055), 0.19, 1),
    34.4: ((0.206, 0.209, 0.211, 0.2137, 0.217), 0.19, 1),
    48.0: ((0.1425, 0.145, 0.2, 0.238, 0.24), 0.1, 1),
    60.0: ((0.1425, 0.145, 0.2, 0.265, 0.27), 0.1, 0.25),
}
BISTABLE, EQUAL = (
    0.2137,
    0.211,
)  # A/R where both states last long, and about equally long, at R/r = 34.4
# R/r and A/R at which the axis is followed. It turns as a wave, with the swirl, hardly, and
# irregularly.
AXES = ((34.4, BISTABLE), (24.0, 0.33), (48.0, 0.145), (48.0, 0.2))


def windows_of(parameters):
    return window_means(
        parameters,
        {"rotation": "rigid_by_time", "elongation": "centre.elongation"},
        WINDOW,
        ["centre"],
    )


def coexistence_run(radius, ratio, prepared, periods):
    dish = Dish(radius, 0.22)
    run = dish_run(dish, dish.discs(FRACTION))
    start = ELONGATING if prepared == "elongated" else (DISHES[radius][1],) * 2
    ramp = ":".join(repr(radius * value) for value in (*start, ratio))
    return {
        "discs": run["discs"],
        "container_radius": radius,
        "period": period_of(run),
        "ramp": f"amplitude={ramp}@0..{PREPARED}",
        "warmup": PREPARED,
        "periods": PREPARED + periods,
    }


def coexistence_point(settings, radius, ratio, prepared, periods, seeds, work=windows_of):
    run = coexistence_run(radius, ratio, prepared, periods)
    name = "coexistence" if work is windows_of else "axis"
    return Point(
        settings,
        f"{name}_R{radius:g}_A{ratio:g}_{prepared}_{periods}periods",
        seeds,
        run,
        work=work,
        cells={
            "container_radius": radius,
            "amplitude_ratio": ratio,
            "discs": run["discs"],
            "prepared": prepared,
        },
    )


def points(settings):
    seeds = settings.first_seeds or settings.chapter_seeds
    dishes = {34.4: ((BISTABLE,), *DISHES[34.4][1:])} if settings.quick else DISHES
    return [
        coexistence_point(
            settings, radius, ratio, prepared, settings.periods(300 * length, 2 * WINDOW), seeds
        )
        for radius, (ratios, _, length) in dishes.items()
        for ratio in ratios
        for prepared in PREPARATIONS
    ] + [
        coexistence_point(settings, *dish, prepared, settings.periods(60, 3), seeds, axis_of)
        for dish in (AXES[:2] if settings.quick else AXES)
        for prepared in PREPARATIONS
    ]


# --- Lifetimes ------------------------------------------------------------------------------------


def states_of(elongations):
    """The state of each window, 0 round or 1 elongated: that of the last window which is certain;
    −1 before it."""
    states, state = [], -1
    for value in elongations:
        state = 1 if value > ELONGATED else 0 if value < ROUND else state
        states.append(state)
    return np.array(states)


def rate_law(ratios, periods, exits):
    """The maximum likelihood of exits per period, exp(a + b x) with x = A/R − BISTABLE, from the
    time in a state and the number of exits at each A/R: (a, b) and their covariance. None without
    exits at two A/R: then b is undetermined."""
    ratios, periods, exits = (
        np.asarray(column, dtype=float) for column in (ratios, periods, exits)
    )
    if len(set(ratios[exits > 0])) < 2:
        return None
    x = np.array([np.ones_like(ratios), ratios - BISTABLE])
    law = np.array([math.log(exits.sum() / periods.sum()), 0.0])
    for _ in range(100):
        expected = periods * np.exp(law @ x)
        information = (x * expected) @ x.T
        step = np.linalg.solve(information, x @ (exits - expected))
        law = law + step * min(1.0, 2.0 / max(abs(step[1]) * np.ptp(ratios), 1e-300))
    return law, np.linalg.inv(information)


def equal_lifetimes(rows):
    """The A/R at which both laws of the rates agree, and the lifetime there, each with its error.
    None if a law is undetermined, if the lifetime of the elongated state does not certainly grow
    relative to that of the round one, or if the lifetime is longer than all runs together: then it
    would follow from an extrapolation alone."""
    laws = [
        rate_law(
            *(
                [row[name] for row in rows]
                for name in ("amplitude_ratio", f"periods_{state}", f"exits_{state}")
            )
        )
        for state in ("round", "elongated")
    ]
    if None in laws:
        return None
    (height, slope), spread = laws[0][0] - laws[1][0], laws[0][1] + laws[1][1]
    if not slope > 2 * math.sqrt(spread[1, 1]):
        return None
    shift = -height / slope
    direction = np.array([1.0, shift])
    lifetime = math.exp(-laws[0][0] @ direction)
    if lifetime > sum(row["periods_round"] + row["periods_elongated"] for row in rows):
        return None
    return (
        (BISTABLE + shift, math.sqrt(direction @ spread @ direction) / slope),
        (lifetime, lifetime * math.sqrt(direction @ laws[0][1] @ direction)),
    )


def row_of(cells, runs):
    """Both states at a dish and an amplitude; the correlation time of the elongation, in periods,
    and its largest window."""
    states, rates = [states_of(run["elongation"]) for run in runs], [
        run["rotation"] for run in runs
    ]
    row = {
        **cells,
        "runs": len(runs),
        "largest_elongation": max(max(run["elongation"]) for run in runs),
        **means(
            [
                {
                    "correlation": WINDOW
                    * swirl.series_mean(run["elongation"]).details["autocorrelation_time"]
                }
                for run in runs
            ],
            ["correlation"],
        ),
    }
    for k, name in enumerate(PREPARATIONS):
        longest = np.concatenate(
            [np.array(run["elongation"])[s == k] for run, s in zip(runs, states)]
        )
        row |= {
            f"prepared_{name}": sum(
                run["prepared"] == name and s[0] == k for run, s in zip(runs, states)
            ),
            **state_cells(states, rates, k, WINDOW, f"_{name}"),
            f"elongation_{name}": float(longest.mean()) if len(longest) else math.nan,
        }
    return row


def table(points, settings):
    rows, histogram, findings, dishes = [], [], [], {}
    lasting, turning = (
        [p for p in points if p.tasks[0].work is work and p.runs] for work in (windows_of, axis_of)
    )
    for p in lasting:
        dishes.setdefault(tuple(p.cells.items())[:-1], []).extend(
            {**run, "prepared": p.cells["prepared"]} for run in p.runs
        )
    for cells, runs in dishes.items():
        rows.append(row_of(dict(cells), runs))
        counts = np.unique(
            np.floor(np.concatenate([run["rotation"] for run in runs]) / RATE_STEP),
            return_counts=True,
        )
        histogram += [
            {**dict(cells), "rotation": (k + 0.5) * RATE_STEP, "windows": int(count)}
            for k, count in zip(*counts)
        ]
        findings.append(
            f"R/r = {rows[-1]['container_radius']:g}, A/R = {rows[-1]['amplitude_ratio']:g}, "
            "lifetime of the state "
            f"{'; '.join(state_words(name, rows[-1], f'_{name}') for name in PREPARATIONS)}."
        )
    for radius in dict.fromkeys(row["container_radius"] for row in rows):
        equal = equal_lifetimes([row for row in rows if row["container_radius"] == radius])
        findings.append(
            f"R/r = {radius:g}: "
            + (
                f"lifetimes are equal at A/R = {with_error(*equal[0])}, {with_error(*equal[1])} "
                "periods."
                if equal
                else "no certain line of equal lifetimes."
            )
        )
    axes = [
        {
            **p.cells,
            "seeds": len(p.runs),
            **means(p.runs, p.runs[0]),
            "share_elongated": sum(run["elongation"] > ELONGATED for run in p.runs) / len(p.runs),
        }
        for p in turning
    ]
    return {"": rows, "_histogram": histogram, "_axis": axes}, findings + [
        f"R/r = {row['container_radius']:g}, A/R = {row['amplitude_ratio']:g}, prepared "
        f"{row['prepared']}: the longest axis "
        f"turns with {with_error(row['axis_rate'], row['axis_rate_error'])} Ω, and scatters by "
        f"{row['axis_scatter']:.0f}° in a "
        "period."
        for row in axes
    ]


def draw(table):
    rows, histogram = style.read(table), tables.companion(table, "_histogram")
    drawing, (left, right) = style.figure(style.PAGE, 2.8, ncols=2)
    left.set_yscale("log")
    for radius, here, look in style.groups(rows, "container_radius"):
        for name, filled in (("round", look["color"]), ("elongated", "white")):
            if known := [row for row in here if row[f"exits_{name}"]]:
                style.curve(
                    left,
                    known,
                    "amplitude_ratio",
                    f"lifetime_{name}",
                    markerfacecolor=filled,
                    linewidth=0.7,
                    label=f"$R/r = {radius:g}$, {name}",
                    **look | {"marker": "o"},
                )
            bounds = [row for row in here if not row[f"exits_{name}"] and row[f"periods_{name}"]]
            left.plot(
                style.column(bounds, "amplitude_ratio"),
                style.column(bounds, f"lifetime_{name}"),
                "^",
                color=look["color"],
                markerfacecolor=filled,
            )
        ratio = min(style.distinct(here, "amplitude_ratio"), key=lambda value: abs(value - EQUAL))
        found = style.select(histogram, container_radius=radius, amplitude_ratio=ratio)
        total = sum(style.column(found, "windows")) * RATE_STEP
        right.step(
            style.column(found, "rotation"),
            [row["windows"] / total for row in found],
            where="mid",
            color=look["color"],
            label=f"$R/r = {radius:g}$, $A/R = {ratio:g}$",
        )
    left.set(xlabel="amplitude $A/R$", ylabel="lifetime (periods)")
    left.locator_params(axis="x", nbins=5)
    right.set(xlabel=r"rotation $\varpi/\Omega$ in five periods", ylabel="probability density")
    for axes in (left, right):
        style.legend(axes, ncol=2)
    style.save(drawing, table)


FIGURES = [
    Figure(
        "coexistence", "chapters", "chapter: how long two prepared states last", points, table, draw
    )
]
