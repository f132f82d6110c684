"""The longest axis of a cluster: how it turns, and the moments of flow, collisions and wall along
and across it.

With positions x and velocities u relative to the centre of mass, the moments of an axis a are Σ m
u_a u_a of the flow, Σ ℓ_a J_a per time of the collisions (branch vector ℓ, impulse J), and Σ x_a
J_a per time of the wall. Negative moments compress; a stress, integrated over the cluster, is the
moment with the opposite sign. By the virial theorem, the sum is ∓ Ω_a² m Σ (x_1² − x_2²) along and
across the axis of a steady shape that turns with the rate Ω_a. The pulse of the wall is |Σ J
exp(2iφ)| / Σ J, with φ the angle of the axis to the line from the swirl centre to the container's
centre: 0 if the axis does not matter, 1 if the wall acts at one angle only. Limits: discs of radius
and mass 1; a step uses the axis at its start, and the centre of mass by linear interpolation."""

import math

import numpy as np
from paper.engine import swirl

STEPS = 100  # in a period, on average
STATE = ("elongation", "rotation")
TORQUES = (
    "wall_normal",
    "wall_tangential",
    "transfer",
)  # on the orbital motion; the last one is that between discs
MOMENTS = tuple(
    f"{part}_{way}" for part in ("flow", "collisions", "wall") for way in ("along", "across")
)


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def axis_of(parameters):
    """Means over a run after its warm-up. The rate of the axis is relative to Ω, the scatter is
    that of its advance in a period, in degrees."""
    simulation = swirl.Simulation(
        **{name: parameters[name] for name in parameters if name not in ("warmup", "periods")}
    )
    simulation.advance(periods=parameters["warmup"])
    count = max(1, round(simulation.counts.total / (STEPS * parameters["warmup"])))
    steps, now = [], simulation.snapshot()
    while simulation.whole_periods < parameters["periods"]:
        before, events = now, simulation.step(count)
        now = simulation.snapshot()
        steps.append(step_of(before, now, events))
    steps = {name: np.array([step[name] for step in steps]) for name in steps[0]}
    lasted = np.diff(steps["time"], append=now.time)
    found = {name: float(steps[name] @ lasted / lasted.sum()) for name in STATE}
    found |= {name: float(steps[name].sum() / lasted.sum()) for name in (*TORQUES, *MOMENTS)}
    angles, periods = np.unwrap(steps["angle"], period=math.pi), steps["time"] / now.period
    advance = np.diff(np.interp(np.arange(math.ceil(periods[0]), periods[-1]), periods, angles))
    return found | {
        "rotation": found["rotation"] * now.period / (2 * math.pi),
        "axis_rate": float(advance.mean()) / (2 * math.pi),
        "axis_scatter": float(np.degrees(advance.std(ddof=1))),
        "pulse": float(abs(steps["pulse"].sum()) / steps["impulse"].sum()),
    }


def step_of(before, after, events):
    """The state at the start of a step, and sums over its events."""
    x, u = (
        values - values.mean(axis=0)
        for values in (np.asarray(before.position), np.asarray(before.velocity))
    )
    square = x.T @ x
    angle = 0.5 * math.atan2(2 * square[0, 1], square[0, 0] - square[1, 1])
    axes = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    x, u = x @ axes.T, u @ axes.T
    normal = np.column_stack([events["normal_x"], events["normal_y"]]) @ axes.T
    # Impulses on j or on the wall, along the normal and along (n_y, −n_x).
    push = events["normal_impulse"][:, None] * normal
    friction = events["tangential_impulse"][:, None] * np.column_stack(
        [normal[:, 1], -normal[:, 0]]
    )
    pairs, walls = (
        events["kind"] == kind for kind in (swirl.EventKind.disc_disc, swirl.EventKind.disc_wall)
    )
    # From the centre of mass to the disc at a contact with the wall.
    first, last = (
        np.asarray(s.container_centre) - np.asarray(s.position).mean(axis=0)
        for s in (before, after)
    )
    passed = ((events["time"] - before.time) / (after.time - before.time))[:, None]
    arm = ((1 - passed) * first + passed * last) @ axes.T + (before.container_radius - 1) * normal
    moments = (
        (u * u).sum(axis=0) * (after.time - before.time),
        (2 * normal * (push + friction))[pairs].sum(axis=0),
        (-(arm * (push + friction))[walls].sum(axis=0)),
    )
    impulse = np.hypot(*(push + friction)[walls].T).sum()
    longest, shortest = np.sqrt((x * x).sum(axis=0))
    return {
        "time": before.time,
        "angle": angle,
        "elongation": longest / shortest,
        "rotation": cross(x, u).sum() / (x * x).sum(),
        "wall_normal": -cross(arm, push)[walls].sum(),
        "wall_tangential": -cross(arm, friction)[walls].sum(),
        "transfer": 2 * cross(normal, friction)[pairs].sum(),
        **dict(zip(MOMENTS, np.concatenate(moments))),
        "impulse": impulse,
        "pulse": impulse * np.exp(2j * (angle - math.atan2(*before.container_centre[::-1]))),
    }
