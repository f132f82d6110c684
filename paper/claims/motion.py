"""Claims on forces, on motion without one or both kinds of friction, and on the single ball of the
minimal model."""

import math

from paper import tables
from paper.paper_parameters import (
    CONTAINER_RADIUS,
    COUNTERROTATING_N,
    EVENTS,
    EXPERIMENT_R_OMEGA_SQUARED,
    M_ANGLE,
    MAX_FORCES,
    OMEGA,
    ROTATING_N,
    SHORTEST_TIMES,
    SIDES,
)
from paper.verdicts import (
    UNDECIDED,
    UNTESTABLE,
    Judgement,
    Value,
    above,
    below,
    combined,
    every,
    fact,
    mean_of,
    measured,
    scattered,
    trend,
    within,
)

from paper.claims import thresholds as size
from paper.claims.settings import DISHES, SPHERES
from paper.claims.thresholds import ENERGY_PARTS, SCATTER_OF_SHORTEST
from paper.claims.wording import ends, number, values


# --- Figures 1 and 2: position and forces in the M-frame -----------------------------------------


def left_of_M(study, setting):
    rows = study.curve("1b", setting=setting)
    lag = [M_ANGLE - row["centre_theta"] for row in rows]
    return combined(
        every([above(v, size.LEFT_SHARE) for v in values(rows, "left")]),
        every([below(v, -size.LEFT_SHIFT) for v in values(rows, "centre_x")]),
    ), (
        f"share left of the line from C to M {ends(rows, 'left')}; x of the centre of mass, in "
        f"radii, {ends(rows, 'centre_x')}; it lags behind the swirl by {lag[0]:.0f}° at N = "
        f"{rows[0]['discs']:.0f} and {lag[-1]:.0f}° at N = {rows[-1]['discs']:.0f}"
    )


def forces(study, setting):
    rows = study.curve("1b", setting=setting)
    radius, amplitude = DISHES[setting]
    omega = 1 / amplitude if setting in SPHERES else OMEGA
    per_unit = EXPERIMENT_R_OMEGA_SQUARED / omega**2  # cm/s² per unit of the table
    points = [row["point"] for row in rows if isinstance(row.get("point"), str)]
    # A maximum has no error of its own; the maxima at different N are independent.
    found = {
        name: scattered([row[f"max_{name}"] * per_unit for row in rows], points)
        for name in MAX_FORCES
    }
    mean = mean_of(values(rows, "coriolis")) * per_unit
    # No particle is farther from S than one that touches the wall at M.
    farthest = (radius - 1 + amplitude) * EXPERIMENT_R_OMEGA_SQUARED
    return every(
        within(found[name], paper - size.FORCE_DIGIT, paper + size.FORCE_DIGIT)
        for name, paper in MAX_FORCES.items()
    ), (
        f"the centrifugal force reaches {number(found['centrifugal'])} cm/s² on average over N; "
        "its limit, on a "
        f"particle that touches the wall at M, is (R − r + A)Ω² = {farthest:.1f}. The Coriolis "
        f"force reaches {number(found['coriolis'])}; on average it is {number(mean)}, and about "
        f"{2 * radius * EXPERIMENT_R_OMEGA_SQUARED:.0f} on a particle that moves with the wall"
    )


# --- Without wall friction ----------------------------------------------------------------------


def states_at(study, discs):
    """{setting: row} at this N."""
    return {row["setting"]: row for row in study.table("states") if row["discs"] == discs}


def rim(study):
    rows = states_at(study, COUNTERROTATING_N)
    speed = {
        name: measured(row, "coriolis") * (1 / (2 * OMEGA**2 * CONTAINER_RADIUS))
        for name, row in rows.items()
    }
    return below(speed["no-wall"], size.LITTLE_MOTION), (
        f"Mean speed in the M-frame at N = {COUNTERROTATING_N}, in ΩR: {number(speed['no-wall'])} "
        "without wall "
        f"friction, {number(speed['high'])} with both (little: below {size.LITTLE_MOTION})."
    )


def no_spinning(study):
    """ "Without any internal individual spinning": discs that turn with the cluster all have its
    spin, so the temperature of the spins counts, not their size."""
    found = []
    for discs in NUMBERS:
        rows = states_at(study, discs)
        found.append(
            (measured(rows["no-wall"], "of_the_spin"), reference(rows["high"], "of_the_spin"))
        )
    return every([below(free - both * size.NO_SPIN, 0) for free, both in found]), (
        f"Temperature of the spins in m v²: {compared(found)} (no spinning: below "
        f"{size.NO_SPIN:.0%} of it)."
    )


# --- Without disc friction ----------------------------------------------------------------------

NUMBERS = (ROTATING_N, COUNTERROTATING_N)


def compared(pairs):
    """Text with pairs of values: without one kind of friction, and with both."""
    return ", ".join(
        f"{number(a)} ({number(b)} with both kinds of friction) at N = {n}"
        for n, (a, b) in zip(NUMBERS, pairs)
    )


def reference(row, name):
    """A value without its point: more seeds there would not decide the claim."""
    return Value(row[name], row[f"{name}_error"])


def gas(phase):
    """`phase`: "before" or "after" the cluster condenses. Loose: fewer contacts than with both;
    gas-like: hotter."""

    def judge(study):
        rows = [
            (
                tables.select(study.table("condensation"), discs=n)[0],
                tables.select(study.table("states"), discs=n, setting="high")[0],
            )
            for n in NUMBERS
        ]
        contacts, heat = (
            [(measured(loose, f"{phase}_{name}"), reference(both, name)) for loose, both in rows]
            for name in ("coordination", "granular")
        )
        return combined(
            every([below(a - b, -size.LEAST_CHANGE * b.mean) for a, b in contacts]),
            every([above(a - b, size.LEAST_CHANGE * b.mean) for a, b in heat]),
        ), (
            f"Contacts of a disc: {compared(contacts)} (loose: fewer by {size.LEAST_CHANGE:.0%}); "
            "granular temperature in "
            f"m v²: {compared(heat)} (gas-like: higher by {size.LEAST_CHANGE:.0%}). "
            + "; ".join(waiting_sentence(loose) for loose, _ in rows)
            + "."
        )

    return judge


def waiting_sentence(row):
    """When the cluster condenses, compared with the length of the paper's run."""
    late = row["seeds"] - row["condensed"]
    if not row["condensed"]:
        return f"N = {row['discs']:.0f}: none of {row['seeds']:.0f} runs condenses"
    return (
        f"N = {row['discs']:.0f}: it condenses after {number(measured(row, 'waiting'))} periods "
        f"({row['events']:,.0f} events; the paper's run has {EVENTS:,.0f})"
        + (
            f", {late:.0f} of {row['seeds']:.0f} runs not within {row['longest']:.0f}"
            if late
            else ""
        )
    )


def outer_spins(study):
    rows = [
        (
            tables.select(study.table("condensation"), discs=n)[0],
            tables.select(study.table("4b"), discs=n, setting="high")[0],
        )
        for n in NUMBERS
    ]
    spins = [
        (measured(loose, "before_wall_spin"), reference(both, "wall_spin")) for loose, both in rows
    ]
    coherence = [measured(loose, "before_spin_correlation") for loose, _ in rows]
    return combined(
        every([above(a - b, size.LEAST_CHANGE * b.mean) for a, b in spins]),
        every([within(c, size.ANTIFERROMAGNETIC, -size.ANTIFERROMAGNETIC) for c in coherence]),
    ), (
        f"Before the cluster condenses, ⟨|ω|⟩/Ω of the discs at the wall: {compared(spins)} "
        "(quickly: more by "
        f"{size.LEAST_CHANGE:.0%}); correlation of the spins of discs that touch: "
        + ", ".join(f"{number(c)} at N = {n}" for n, c in zip(NUMBERS, coherence))
        + f" (no coherence: within ±{-size.ANTIFERROMAGNETIC:.3f}). The same wall accelerates the "
        "spin of all discs, so they spin in one direction."
    )


# --- Collision times, energy --------------------------------------------------------------------


def shortest_times(study):
    """The shortest of n independent times falls as 1/n: with friction, log10 of the shortest time
    is −8.77 ± 0.15 for twelve runs of 10^6 events, and −7.72 ± 0.05 for tenths of these runs. So
    times of shorter runs are scaled by that factor. Without friction the discs get faster
    throughout a run, and its beginning does not predict the whole."""
    rows = study.table("times")
    events = rows[0]["events"]
    found = {
        mu: scattered(
            [
                math.log10(row["smallest"] * events / EVENTS)
                for row in tables.select(rows, mu=mu)
                if row["smallest"] > 0
            ],
            {row["point"] for row in tables.select(rows, mu=mu)},
            least=SCATTER_OF_SHORTEST,
        )
        for mu in SHORTEST_TIMES
    }
    spread = math.log10(size.TIMES_AROUND)
    agree = [
        within(found[mu], math.log10(paper) - spread, math.log10(paper) + spread)
        if mu > 0 or events >= EVENTS
        else Judgement(UNDECIDED)
        for mu, paper in SHORTEST_TIMES.items()
    ]

    def in_words(mu):
        v = found[mu]
        return (
            f"{10 ** v.mean:.1g} (uncertain by a factor of {10 ** v.error:.1f})"
            if v.known
            else "n/a"
        )

    scaled = (
        ""
        if events == EVENTS
        else (
            f", estimated from runs of {events:,.0f} events (the shortest of n times falls as 1/n, "
            "except without friction, because discs become faster all the time)"
        )
    )
    return combined(*agree), (
        "The shortest time between two collisions in a run of a million events at N = "
        f"{COUNTERROTATING_N}{scaled}, "
        f"is {in_words(1.0)} with friction, {in_words(0.0)} without (around: within a factor of "
        f"{size.TIMES_AROUND:.0f})."
    )


def blow_up(study):
    rows = study.table("energy")

    def series(sides):
        """The energies of each seed in order of time."""
        here = tables.select(rows, sides=float(sides))
        return [
            [
                row["energy"]
                for row in sorted(tables.select(here, seed=seed), key=lambda row: row["period"])
            ]
            for seed in tables.distinct(here, "seed")
        ]

    def growth(sides):
        """From the second part to the last, once the discs are in motion, in units of the mean; the
        error is that between seeds."""
        found = []
        for energy in series(sides):
            edges = [len(energy) * k // ENERGY_PARTS for k in range(ENERGY_PARTS + 1)]
            found.append(
                trend([sum(energy[a:b]) / (b - a) for a, b in zip(edges[1:], edges[2:])]).mean
            )
        return scattered(found)

    runs = series(SIDES)
    crashed = not all(math.isfinite(energy) for run in runs for energy in run)
    return combined(above(growth(SIDES), size.GROWTH), fact(crashed)), (
        f"In {len(runs[0]) - 1} periods at N = {rows[0]['discs']:.0f} ({len(runs)} seeds), from "
        "the second tenth to "
        f"the last, the energy grows by {number(growth(SIDES))} of its mean on {SIDES} sides, by "
        f"{number(growth(6))} on 6 and by {number(growth(0))} on the true circle (it blows up: "
        f"more than {size.GROWTH}); this program does {'' if crashed else 'not '}crash."
    )


# --- The minimal model --------------------------------------------------------------------------


def rolling_ball(study):
    rolling = tables.select(study.table("ball"), mu=1.0, restitution=0.5)
    gammas, shares = values(rolling, "gamma"), [row["slip"] for row in rolling]
    return every([above(g, 1 + size.LEAST_ROTATION) for g in gammas]), (
        "γ of one large disc with μ = 1 that stays at the wall (e = 0.5): "
        f"{min(g.mean for g in gammas):.3f} to "
        f"{max(g.mean for g in gammas):.3f}, {min(shares):.3f} to {max(shares):.3f} of γ_c."
    )


def slipping_ball(study):
    """Not a result: without friction nothing changes the spin."""
    gammas = values(tables.select(study.table("ball"), mu=0.0), "gamma")
    return Judgement(UNTESTABLE), (
        "Without friction the ball receives no torque and keeps the spin that it started with. "
        "The runs start "
        f"without spin, so that γ = {gammas[0].mean:.3f} for ever; with the start that the paper's "
        "γ = 0 implies, it would be 0. No simulation decides it."
    )


def ball_near_m(study):
    rows = tables.select(study.table("ball"), mu=1.0, restitution=0.5)
    angles = values(rows, "theta")
    return combined(
        every([within(v, M_ANGLE - size.NEAR_M, M_ANGLE + size.NEAR_M) for v in angles]),
        every([below(v, M_ANGLE - size.LEFT_OF_M) for v in angles]),
    ), (
        "Direction of a ball that rolls on the wall (μ = 1, e = 0.5): θ = "
        + ", ".join(
            f"{number(v)}° for a radius of {row['ball_radius']:g}" for v, row in zip(angles, rows)
        )
        + f"; M is at {M_ANGLE:.0f}° (near: within {size.NEAR_M:.0f}°; to the left: by more than "
        f"{size.LEFT_OF_M:.0f}°). A ball "
        "that turns uniformly has no torque, hence no friction, and only at M does the normal "
        "force alone balance the centrifugal force."
    )
