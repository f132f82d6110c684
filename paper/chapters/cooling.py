"""Against published theory: does a gas of rough discs cool as the mean-field theory of Huthmann and
Zippelius says (Phys. Rev. E 56, R6275, 1997, cond-mat/9708093)? Luding, Huthmann, McNamara and
Zippelius compared it with simulations (Phys. Rev. E 58, 3416, 1998). The container is at rest, and
its wall is smooth. The gas first reaches equilibrium without friction and losses. Then the
collision law is switched on, with all spins zero. The theory is in rough_gas.py."""

import dataclasses
import math

import numpy as np
from paper import style, tables
from paper.combine import means
from paper.curves import with_error
from paper.engine import swirl
from paper.figure import Figure
from paper.rough_gas import FRACTION, Case, collision_rate, radius_of
from paper.study import Point

QUANTITIES = ("translation", "spins", "time", "excess", "correlation")  # of a state of the gas
# Collisions per disc without losses: to reach equilibrium, then to measure the collision rate.
TO_MIX, TO_COUNT = 40, 20
MOMENTS = (0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 7.0, 10.0, 15.0, 20.0, 30.0)
FIRST_COLLISIONS = 2  # of the findings
STICKS = 1e6  # μ
CASES = (
    Case("haff", "smooth, e = 0.9", 0.9, -1, 0, 0.5),
    Case("elastic", "e = 1, β = 1, I = ½", 1, 1, STICKS, 0.5),
    Case("partly", "e = 0.95, β = 0.5, I = ½", 0.95, 0.5, STICKS, 0.5),
    Case("solid", "e = 0.9, β = 0, I = ½", 0.9, 0, STICKS, 0.5),
    Case("sticking", "e = 1, β = 0, I = 10", 1, 0, STICKS, 10),
    Case("paper", "e = 1, β = 0, I = 10, μ = 1", 1, 0, 1, 10),
    Case("slippery", "e = 1, β = 0, I = 10, μ = 0.1", 1, 0, 0.1, 10),
)


# --- Runs -----------------------------------------------------------------------------------------


def state_of(gas):
    """T, T_s, the excess a₂ = ⟨v⁴⟩/2⟨v²⟩² − 1, and the correlation ⟨v²ω²⟩/⟨v²⟩⟨ω²⟩ − 1, NaN without
    spins."""
    now = gas.snapshot()
    v2, w2 = np.sum(now.velocity**2, axis=1), now.spin**2
    correlation = np.mean(v2 * w2) / (v2.mean() * w2.mean()) - 1 if w2.any() else math.nan
    return (
        0.5 * v2.mean(),
        now.inertia[0] * w2.mean(),
        0.5 * np.mean(v2**2) / v2.mean() ** 2 - 1,
        correlation,
    )


def advance(gas, start, per_disc):
    """To the exact number of collisions of two discs, per disc."""
    target = start + int(0.5 * per_disc * len(gas))
    while (left := target - gas.counts.disc_disc) > 0:
        gas.advance(events=max(1, left // 2))


def cool(gas, case, parameters):
    """Rows T, T_s, time, excess and correlation at all moments, in units of the start."""
    start = gas.snapshot()
    gas = swirl.Simulation(
        position=start.position,
        velocity=start.velocity,
        mu_disc=case.mu,
        mu_wall=0,
        restitution=case.restitution,
        tangential_restitution=max(case.beta, 0),
        inertia=case.inertia,
        container_radius=parameters["container_radius"],
        amplitude=0,
    )
    rows, at_start = [], state_of(gas)[0]
    for tau in MOMENTS:
        advance(gas, 0, tau)
        T, spins, excess, correlation = state_of(gas)
        rows.append(
            [T / at_start, spins / at_start, gas.time * math.sqrt(at_start), excess, correlation]
        )
    return rows


def cooling_run(parameters):
    """The collision rate in equilibrium, in units of Enskog's, and the states of all cases."""
    gas = swirl.Simulation(**parameters)
    advance(gas, 0, TO_MIX)
    begin, before = gas.time, gas.counts.disc_disc
    advance(gas, before, TO_COUNT)
    rate = 2 * (gas.counts.disc_disc - before) / (len(gas) * (gas.time - begin))
    return {
        "rate": rate / (math.sqrt(state_of(gas)[0]) * collision_rate()),
        **{case.case: cool(gas, case, parameters) for case in CASES},
    }


def points(settings):
    return [
        Point(
            settings,
            f"cooling_N{n}",
            settings.chapter_seeds,
            {"discs": n, "container_radius": radius_of(n), "amplitude": 0, "mu": 0},
            work=cooling_run,
            cells={"discs": n, "container_radius": radius_of(n)},
        )
        for n in ((500, 1000) if settings.quick else (500, 1000, 2000, 4000, 8000))
    ]


# --- Tables ---------------------------------------------------------------------------------------


def rows_of_case(case, point):
    """The largest gas, with the theory."""
    discs, rate, rows = point.cells["discs"], collision_rate(), []
    for k, tau in enumerate(MOMENTS):
        found = means([dict(zip(QUANTITIES, run[case.case][k])) for run in point.runs], QUANTITIES)
        found |= {name: found[name] * rate for name in ("time", "time_error")}
        theory = dict(zip(QUANTITIES, (*case.after(tau, discs), case.time_of(tau, discs))))
        rows.append(
            {
                **dataclasses.asdict(case),
                "collisions": tau,
                **found,
                **{f"theory_{name}": value for name, value in theory.items()},
                "seeds": len(point.runs),
            }
        )
    return rows


def largest_deviation(rows, name):
    """ "0.3 ± 0.2 %": the largest relative deviation from the theory during the first
    collisions."""
    found = [
        (
            100 * (row[name] / row[f"theory_{name}"] - 1),
            100 * row[f"{name}_error"] / row[f"theory_{name}"],
        )
        for row in rows
        if row["collisions"] <= FIRST_COLLISIONS and row[f"theory_{name}"] > 0
    ]
    return f"{with_error(*max(found, key=lambda pair: abs(pair[0])))} %"


def table(points, settings):
    rows, findings = [], []
    for case in CASES:
        here = rows_of_case(case, points[-1])
        rows += here
        spins = f" and {largest_deviation(here, 'spins')} for the spins" if case.mu else ""
        findings.append(
            f"{case.words}: the largest deviation from the mean-field theory up to "
            f"{FIRST_COLLISIONS} "
            f"collisions of a disc is {largest_deviation(here, 'translation')} for the "
            f"translation{spins}."
        )
    rates = [
        {
            **point.cells,
            "packing_fraction": FRACTION,
            **means(point.runs, ["rate"]),
            "seeds": len(point.runs),
        }
        for point in points
    ]
    words = [
        f"{with_error(r['rate'], r['rate_error'])} at R/r = {r['container_radius']:.0f}"
        for r in rates
    ]
    return {"": rows, "_rates": rates}, [
        *findings,
        f"Collision rate in units of Enskog's: {', '.join(words)}.",
    ]


# --- Drawing --------------------------------------------------------------------------------------

LAST = 10.5  # collisions of a disc that the figure shows
LINEAR = 15  # per cent: the scale of deviations is logarithmic beyond


def temperatures(axes, rows, look):
    tau = [0.0, *style.column(rows, "collisions")]
    for name, start, face, line in (
        ("translation", 1.0, look["color"], "-"),
        ("spins", 0.0, "white", "--"),
    ):
        if rows[0]["mu"] in (0, STICKS):
            axes.plot(
                tau,
                [start, *style.column(rows, f"theory_{name}")],
                color=look["color"],
                linestyle=line,
                linewidth=0.9,
            )
        style.curve(axes, rows, "collisions", name, linestyle="none", markerfacecolor=face, **look)


def deviations(axes, rows, look, name):
    """Returns the drawn values, in per cent."""
    here = [
        row
        | {
            "deviation": 100 * (row[name] / row[f"theory_{name}"] - 1),
            "deviation_error": 100 * row[f"{name}_error"] / row[f"theory_{name}"],
        }
        for row in rows
        if row[f"theory_{name}"] > 0 and row["collisions"] <= LAST
    ]
    if here:
        style.curve(axes, here, "collisions", "deviation", **look)
    return style.column(here, "deviation")


def draw(table):
    rows, rates = style.read(table), tables.companion(table, "_rates")
    drawing, ((both, translation), (spins, last)) = style.figure(style.PAGE, 5.4, ncols=2, nrows=2)
    cases = [
        (tables.select(rows, case=case), style.look_of(k))
        for k, case in enumerate(dict.fromkeys(row["case"] for row in rows))
    ]
    for here, look in cases:
        temperatures(both, here, look)
    both.set_ylabel("temperature / that at the start")
    for axes, name, words in ((translation, "translation", "T"), (spins, "spins", "T_s")):
        style.zero_line(axes)
        style.fine_near_zero(
            axes, np.concatenate([deviations(axes, *case, name) for case in cases]), LINEAR
        )
        axes.set_ylabel(f"${words}$: simulation / theory − 1 (%)")
    for axes in (both, translation, spins):
        axes.set(xlim=(0, LAST), xlabel=r"collisions per disc $\tau$")
    rates = [row | {"inverse": 1 / row["container_radius"]} for row in rates]
    style.curve(last, rates, "inverse", "rate", color=style.BLACK, marker="o", linestyle="none")
    last.axhline(1.0, color=style.GREY, linewidth=0.7, linestyle=":")
    last.set_xlim(0, 1.1 * max(style.column(rates, "inverse")))
    last.locator_params(axis="x", nbins=5)
    last.set(xlabel="$r/R$", ylabel="collision rate / Enskog's")
    style.legend_of_all(
        drawing,
        [translation.plot([], [], label=here[0]["words"], **look)[0] for here, look in cases],
        ncol=4,
    )
    style.save(drawing, table)


FIGURES = [
    Figure(
        "cooling",
        "chapters",
        "chapter: does a gas of rough discs cool as mean-field theory says?",
        points,
        table,
        draw,
    )
]
