"""Spheres that settle at the wall, seen in frames and in single collisions: whether the resident
spheres move as a rigid body, how many encounters a sphere has before its residence begins, and how
spheres in contact roll, one behind the other or side by side.

Rigidity. From the velocities of a group of n spheres in a frame the best rigid motion is
subtracted, which has three parameters. What is left has 2n − 3 degrees of freedom; its root mean
square is given in units of the wall's speed ΩR in the M-frame. 0 is a rigid body. Groups of fewer
than FEWEST spheres are omitted.

Encounters. A collision counts if its impulse is more than STRONG of m Ω R. Those with the same
partner (or the wall) within MERGED periods are one encounter: spheres that press on each other
bounce many times. The encounters of an arrival are those in the QUARTER period before the residence
begins.

Rolling in contact. Two spheres are in strong contact if their gap is below TOUCHING, and they
advance if their mean speed relative to the floor is more than SLOW of Ω R. Angle between the line
of their centres and their mean velocity: below 30° they move in single file, above 60° side by
side. A sphere rolls if its lowest point does not slip on the floor (ROLLS, a rounding error).
Limits: the frames are a 511th of a period apart."""

import copy
import math

import numpy as np

from paper import style
from paper.combine import means
from paper.curves import with_error
from paper.engine import simulation_of, swirl
from paper.figure import Figure
from paper.runs import ROUGH, SMOOTH, length_of, lengths
from paper.study import Point

PER_PERIOD = 511
FEWEST = 4
STRONG, MERGED, QUARTER = 0.05, 0.02, 0.25
TOUCHING, SLOW, ROLLS = 0.003, 0.2, 1e-9
FILES = {"single_file": (0, 30), "side_by_side": (60, 90)}  # degrees
EVERY = 8  # frames from one sample of rigidity and rolling to the next
QUANTITIES = (
    "rigid_resident",
    "rigid_loose",
    "encounters",
    "two_encounters",
    "rolling_single_file",
    "rolling_side_by_side",
)
NUMBERS = (24, 36, 48)
WORDS = {friction.name: friction.words for friction in (SMOOTH, ROUGH)}


def points(settings):
    made = []
    for friction in (SMOOTH, ROUGH):
        for discs in (24, 48) if settings.quick else NUMBERS:
            run = {"discs": discs, "preset": friction.preset, **lengths(settings, (50, 1), (12, 2))}
            made.append(
                Point(
                    settings,
                    f"settling_{friction.name}_N{discs}_{length_of(run)}",
                    settings.seeds,
                    run,
                    work=settling_run,
                    cells={"setting": friction.name, "discs": discs},
                )
            )
    return made


def nonrigid(x, u):
    """The mean square of what a rigid motion leaves of the velocities u at x, per degree of
    freedom; None for few points."""
    if len(x) < FEWEST:
        return None
    x, u = x - x.mean(axis=0), u - u.mean(axis=0)
    rate = np.sum(x[:, 0] * u[:, 1] - x[:, 1] * u[:, 0]) / np.sum(x * x)
    left = u - rate * np.column_stack([-x[:, 1], x[:, 0]])
    return float(np.sum(left**2) / (2 * len(x) - 3))


def rigidity(frames, speed):
    """{name: root mean square non-rigid velocity/(Ω R)} of the resident spheres and of the loose
    ones (SI)."""
    found = {"rigid_resident": [], "rigid_loose": []}
    for position, velocity, resident, pinned in zip(
        frames.position[::EVERY],
        frames.velocity[::EVERY],
        frames.resident[::EVERY],
        frames.pinned[::EVERY],
    ):
        for name, chosen in (("rigid_resident", resident == 1), ("rigid_loose", pinned == 0)):
            square = nonrigid(position[chosen], velocity[chosen])
            if square is not None:
                found[name].append(square)
    return {
        name: math.sqrt(np.mean(squares)) / speed if squares else math.nan
        for name, squares in found.items()
    }


def arrivals(resident):
    """[(frame, disc)] where a residence begins."""
    began = (resident[1:] == 1) & (resident[:-1] == 0)
    return [(int(k) + 1, int(disc)) for k, disc in zip(*np.nonzero(began))]


def encounters_before(hits, begin, end):
    """The number of encounters in [begin, end) of a sphere's hits (time in periods, partner)."""
    count, last = 0, {}
    for time, partner in hits:
        if begin <= time < end and time - last.get(partner, -math.inf) > MERGED:
            count += 1
        last[partner] = time
    return count


def settling(events, frames, discs, speed):
    """(mean number of encounters before an arrival, share of the arrivals with two or more)."""
    hits = [[] for _ in range(discs)]
    collisions = events[events["kind"] <= int(swirl.EventKind.disc_wall)]
    for event in collisions[collisions["normal_impulse"] > STRONG * speed]:
        time, i, j = event["time"] / frames.period, int(event["i"]), int(event["j"])
        hits[i].append((time, j if j != i else -1))
        if j != i:
            hits[j].append((time, i))
    times = np.asarray(frames.time) / frames.period
    counts = [
        encounters_before(hits[disc], times[k] - QUARTER, times[k])
        for k, disc in arrivals(frames.resident)
        if times[k] - QUARTER >= times[0]
    ]
    return (
        (float(np.mean(counts)), float(np.mean(np.array(counts) >= 2)))
        if counts
        else (math.nan, math.nan)
    )


def rolling_in_contact(position, velocity, rolls, slowest):
    """{name: (spheres that roll, spheres)} of the pairs in strong contact; velocities are relative
    to the floor."""
    found = dict.fromkeys(FILES, (0, 0))
    apart = position[None] - position[:, None]
    distance = np.hypot(apart[..., 0], apart[..., 1])
    for i, j in zip(*np.nonzero(np.triu(distance < 2 + TOUCHING, 1))):
        mean = 0.5 * (velocity[i] + velocity[j])
        speed = math.hypot(*mean)
        if speed <= slowest:
            continue
        angle = math.degrees(
            math.acos(min(1.0, abs(apart[i, j] @ mean) / (distance[i, j] * speed)))
        )
        for name, (low, high) in FILES.items():
            if low <= angle <= high:
                found[name] = (found[name][0] + int(rolls[i]) + int(rolls[j]), found[name][1] + 2)
    return found


def rolling_shares(frames, speed):
    """{name: share of the spheres that roll on the floor} of pairs in single file and side by
    side."""
    sums = dict.fromkeys(FILES, np.zeros(2))
    for k in range(0, len(frames), EVERY):
        frame = frames[k]
        velocity = frame.velocity - frame.container_velocity
        spin = frame.rolling_spin
        slip = velocity + np.column_stack([-spin[:, 1], spin[:, 0]])
        rolls = np.hypot(slip[:, 0], slip[:, 1]) < ROLLS
        here = rolling_in_contact(np.asarray(frame.position), velocity, rolls, SLOW * speed)
        sums = {name: sums[name] + here[name] for name in FILES}
    return {
        f"rolling_{name}": rolling / all_ if all_ else math.nan
        for name, (rolling, all_) in sums.items()
    }


def settling_run(parameters):
    """Frames and events of the same trajectory."""
    simulation = simulation_of(parameters)
    simulation.advance(periods=parameters["warmup"])
    again, periods = copy.deepcopy(simulation), parameters["periods"] - parameters["warmup"]
    frames, events = simulation.sample(periods, PER_PERIOD), []
    while again.whole_periods < parameters["periods"]:
        events.append(again.step(20_000))
    speed = simulation.omega * simulation.container_radius
    found = dict(
        zip(
            ("encounters", "two_encounters"),
            settling(np.concatenate(events), frames, len(simulation), speed),
        )
    )
    return {**rigidity(frames, speed), **found, **rolling_shares(frames, speed)}


def table(points, settings):
    rows = [
        {
            **p.cells,
            **means(p.runs, QUANTITIES),
            "seeds": len(p.tasks),
            "averaged_runs": len(p.runs),
            "point": p.name,
        }
        for p in points
    ]
    return {"": rows}, [
        f"{WORDS[row['setting']]}, N = {row['discs']}: the resident ones move as a rigid body "
        "within "
        f"{with_error(row['rigid_resident'], row['rigid_resident_error'])} of the wall's speed, "
        f"the loose ones within {with_error(row['rigid_loose'], row['rigid_loose_error'])}; "
        f"{with_error(row['encounters'], row['encounters_error'])} encounters before a residence; "
        "in strong contact "
        f"{with_error(row['rolling_single_file'], row['rolling_single_file_error'])} roll in "
        "single file, "
        f"{with_error(row['rolling_side_by_side'], row['rolling_side_by_side_error'])} side by "
        "side."
        for row in rows
    ]


PANELS = (
    (
        "non-rigid velocity (wall's speed)",
        (("rigid_resident", "resident"), ("rigid_loose", "loose")),
    ),
    ("encounters before a residence", (("encounters", "encounters"),)),
    (
        "share that rolls, in contact",
        (("rolling_single_file", "single file"), ("rolling_side_by_side", "side by side")),
    ),
)


def draw(table):
    rows = style.read(table)
    drawing, axes = style.figure(style.PAGE, 2.7, ncols=len(PANELS))
    for panel, (label, quantities) in zip(axes, PANELS):
        for k, (name, words) in enumerate(quantities):
            for setting, filled in (("smooth", style.CYCLE[k]), ("rough", "white")):
                here = style.select(rows, setting=setting)
                if not here:
                    continue
                style.curve(
                    panel,
                    here,
                    "discs",
                    name,
                    color=style.CYCLE[k],
                    marker=style.MARKERS[k],
                    markerfacecolor=filled,
                    label=f"{words}, {'smooth' if setting == 'smooth' else 'roughened'}",
                )
        panel.set(xlabel="number of spheres $N$", ylabel=label)
        panel.set_ylim(bottom=0)
        style.legend(panel, ncol=1)
    style.save(drawing, table)


FIGURES = [
    Figure(
        "settling",
        "rolling",
        "spheres that roll: rigidity, encounters and rolling in contact at the wall",
        points,
        table,
        draw,
    )
]
