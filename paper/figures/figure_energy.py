"""Beyond the paper: the energy without any friction, on polygons and on the circle (first seed)."""

import math

from paper import style
from paper.combine import failed
from paper.curves import with_error
from paper.engine import simulation_of
from paper.figure import Figure
from paper.paper_parameters import ROTATING_N
from paper.runs import sides
from paper.study import Point


def energy_series(parameters):
    """The kinetic energy K, and K − ΩL with the angular momentum L, at the start of every period.
    On a circle K − ΩL is conserved."""
    simulation = simulation_of(parameters)
    frames = simulation.sample(parameters["periods"], 1)
    position, velocity = frames.position, frames.velocity
    K = 0.5 * frames.mass * (velocity**2).sum(axis=2) + 0.5 * frames.inertia * frames.spin**2
    turning = position[..., 0] * velocity[..., 1] - position[..., 1] * velocity[..., 0]
    L = frames.mass * turning + frames.inertia * frames.spin
    K, L = K.sum(axis=1), L.sum(axis=1)
    return {"energy": K.tolist(), "invariant": (K - simulation.omega * L).tolist()}


def points(settings):
    run = {"discs": ROTATING_N, "mu": 0, "warmup": 0, "periods": settings.periods(400, 10)}
    return [
        Point(
            settings,
            f"energy_M{m}_N{ROTATING_N}",
            settings.seeds,
            {**run, **sides(m)},
            work=energy_series,
            cells={"sides": m, "discs": ROTATING_N},
        )
        for m in (6, 30, 300, 0)
    ]


def table(points, settings):
    rows, findings = [], []
    for point in points:
        for k, task in enumerate(point.tasks):
            if failed(task.result):
                continue
            energy, invariant = task.result["energy"], task.result["invariant"]
            rows += [
                {
                    **point.cells,
                    "seed": k + 1,
                    "period": t,
                    "energy": energy[t],
                    "invariant": invariant[t],
                }
                for t in range(len(energy))
            ]
            if k == 0:
                m = point.cells["sides"]
                findings.append(
                    f"No friction, {f'{m} sides' if m else 'the circle'}: in "
                    f"{task.parameters['periods']} periods the energy "
                    f"changes from {energy[0]:.0f} to {energy[-1]:.0f}, and K − ΩL by "
                    f"{with_error(invariant[-1] - invariant[0], math.nan)} (first seed)."
                )
    return {"": (rows, ["sides", "discs", "seed", "period", "energy", "invariant"])}, findings


def draw(table):
    rows = style.select(style.read(table), seed=1)  # one run of each path
    drawing, axes = style.figure()
    for k, sides in enumerate(sorted(style.distinct(rows, "sides"), key=lambda m: m or 1e9)):
        curve = style.select(rows, sides=sides)
        axes.plot(
            style.column(curve, "period"),
            style.column(curve, "energy"),
            markevery=max(len(curve) // 8, 1),
            label=f"{sides:.0f} sides" if sides else "circle",
            **style.look_of(k),
        )
    axes.set(yscale="log", xlabel="periods", ylabel="kinetic energy ($m v_c^2$)")
    style.legend(axes)
    style.save(drawing, table)


FIGURES = [
    Figure("energy", "beyond", "beyond the paper: energy without any friction", points, table, draw)
]
