"""Fits a micropolar fluid to the fields of several runs, and predicts the rotation
(docs/results/continuum.md).

    for s in 1 2 3 4 5 6 7 8; do
      swirl run --discs 497 --container-radius 34.4 --amplitude 7.568 --warmup 10 --periods 40 --seed $s \\
        --measure fields,wall --tables seed_$s
    done
    ./swirl python paper continuum seed_*/fields.m_frame_4.csv
    ./swirl python paper continuum --flow --amplitude 7.568 seed_*/fields.m_frame_4.csv

The tables must be of runs that differ only in their seeds. The relations of the fluid, and how they
are fitted, are those of micropolar.py. The flow needs scikit-fem (pip install scikit-fem).
"""

import argparse
import csv
import os
import sys

import numpy as np

from paper.curves import CERTAIN, with_error
from paper.engine import swirl
from paper.micropolar import RELATIONS, fit, fit_relation

COEFFICIENTS = [relation for relation in RELATIONS if relation.name != "angle"]


def read(path):
    """The columns of a table of fields as arrays; an empty cell is NaN."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    if not rows:
        raise ValueError(f"'{path}' has no rows")
    return {name: np.array([float(row[name] or "nan") for row in rows]) for name in rows[0]}


def read_seeds(paths):
    """The columns of all tables, each with one row for each seed."""
    tables = [read(path) for path in paths]
    for path, table in zip(paths, tables):
        missing = {"x", "y", "packing", "torque", "vorticity", "spin"} - set(table)
        if missing:
            raise ValueError(
                f"'{path}' has no column {sorted(missing)[0]}: it is no table of fields"
            )
        if len(table["x"]) != len(tables[0]["x"]) or not np.array_equal(table["x"], tables[0]["x"]):
            raise ValueError(f"'{path}' has other points than '{paths[0]}'")
    return {name: np.array([table[name] for table in tables]) for name in tables[0]}


def half_width(fields):
    """The container's radius: half the width of the square with the grid's points."""
    x = np.unique(fields["x"][0])
    return 0.5 * (x[-1] - x[0] + x[1] - x[0])


def closure(fields, low, high, width=4.0):
    """{name: Fit} of the coefficients from all points whose packing fraction, a mean over the
    seeds, is between these two, and whose kernel of this width is out of reach of contacts with the
    wall."""
    reach = (
        half_width(fields) - 1.0 - width
    )  # such a contact extends inwards to the centre of a disc
    seeds = [{name: column[k] for name, column in fields.items()} for k in range(len(fields["x"]))]
    return {
        relation.name: fit_relation(seeds, relation, low, high, reach) for relation in COEFFICIENTS
    }


def bessel_i(order, x):
    """The modified Bessel function I_0 or I_1, by its series."""
    x = np.asarray(x, dtype=float)
    term = (0.5 * x) ** order
    total = term.copy()
    for k in range(1, 200):
        term = term * (0.25 * x * x) / (k * (k + order))
        total += term
    return total


def decay_rate(viscosity, rotational, diffusion):
    """κ of the flow between the wall and the rigid interior."""
    return np.sqrt(4.0 * viscosity * rotational / (diffusion * (2.0 * viscosity + rotational)))


def rotation_profiles(a, b, kappa, viscosity, rotational, couple=0.0):
    """u_θ(r) = a r + b I₁(κr), and the spin ω(r) that belongs to it with this couple on the spins
    per area."""
    factor = kappa * (0.5 + viscosity / rotational)
    return (
        lambda r: a * r + b * bessel_i(1, kappa * r),
        lambda r: a + 0.5 * couple / rotational + b * factor * bessel_i(0, kappa * r),
    )


def closed_form(radius, wall_speed, wall_spin, viscosity, rotational, diffusion):
    """u_θ(r) and ω(r) of the steady flow in a disc with both values given at the wall."""
    kappa = decay_rate(viscosity, rotational, diffusion)
    factor = kappa * (0.5 + viscosity / rotational)
    matrix = [[radius, bessel_i(1, kappa * radius)], [1.0, factor * bessel_i(0, kappa * radius)]]
    a, b = np.linalg.solve(np.array(matrix, dtype=float), [wall_speed, wall_spin])
    return rotation_profiles(a, b, kappa, viscosity, rotational)


def closed_form_with_slip(radius, friction, wall_speed, couple, viscosity, rotational, diffusion):
    """The same with a wall of this speed and friction, and a couple on the spins per area that
    drives the flow.

    The wall's force per length is −friction × slip, and its torque on discs of radius 1 is the
    same. The slip is u_θ + ω − wall_speed."""
    kappa = decay_rate(viscosity, rotational, diffusion)
    i0, i1 = bessel_i(0, kappa * radius), bessel_i(1, kappa * radius)
    factor = kappa * (0.5 + viscosity / rotational)
    # Per a, per b, and without both. σ_θr = η (u' − u/r) + τ/2 with τ = −Γ (2ω − curl u); curl u =
    # 2a + bκ I₀.
    slip = np.array([radius + 1.0, i1 + factor * i0, 0.5 * couple / rotational - wall_speed])
    strain = np.array([0.0, kappa * i0 - 2.0 * i1 / radius, 0.0])
    torque = np.array([0.0, -2.0 * viscosity * kappa * i0, -couple])
    gradient = np.array([0.0, factor * kappa * i1, 0.0])
    force = viscosity * strain + 0.5 * torque + friction * slip
    moment = diffusion * gradient + friction * slip
    a, b = np.linalg.solve([force[:2], moment[:2]], [-force[2], -moment[2]])
    return rotation_profiles(a, b, kappa, viscosity, rotational, couple)


def at(coefficient, x):
    """A coefficient that is a number, or a function of the points x[0], x[1]."""
    return coefficient(x) if callable(coefficient) else coefficient + 0.0 * x[0]


def micropolar_flow(
    radius,
    viscosity,
    rotational,
    diffusion,
    *,
    wall_speed=0.0,
    wall_spin=None,
    friction=0.0,
    couple=0.0,
    density=None,
    inertia=10.0,
    frame_rate=0.0,
    gravity=(0.0, 0.0),
    refinements=4,
    steps=1,
    relax=0.5,
):
    """The steady micropolar flow in a disc by finite elements (Taylor and Hood).

    Returns points, velocities and spins at the vertices. With `wall_spin`, velocity and spin at the
    wall are given. Otherwise the wall does not let the fluid through and acts with `friction` as in
    closed_form_with_slip(). Viscosities, diffusion, friction, couple and density may be functions
    of the points.

    Without `density` the fluid is incompressible and has no inertia. With it, the frame turns at
    `frame_rate` Ω, the velocity u is that relative to the container, and the equations are those of
    the M-frame:

        ∇·ρ(u − Ωẑ×x) = 0,    ρ ((u − Ωẑ×x)·∇u + Ωẑ×u) = ∇·σ + ρ × gravity,
        I ρ (u − Ωẑ×x)·∇ω = D ∇²ω − Γ (2ω − curl u) + couple

    They are solved in `steps` iterations, each of which uses the last velocity in u·∇. `relax` is
    the part of the new solution."""
    import skfem
    from skfem.helpers import ddot, div, dot, grad, sym_grad

    def curl(u):
        return grad(u)[1, 0] - grad(u)[0, 1]

    mesh = skfem.MeshTri.init_circle(refinements).scaled(radius)
    quadratic = skfem.ElementTriP2()
    elements = [skfem.ElementVector(quadratic), skfem.ElementTriP1(), quadratic]
    velocity, pressure, spin = (skfem.Basis(mesh, element, intorder=5) for element in elements)
    wall_velocity, wall_of_spin = (
        skfem.FacetBasis(mesh, element, intorder=5) for element in (elements[0], quadratic)
    )
    weight = density if density is not None else 1.0

    def turning(x):
        return frame_rate * np.array([-x[1], x[0]])

    def along(u, x):
        return (x[0] * u[1] - x[1] * u[0]) / np.hypot(x[0], x[1])

    def through(u, x):
        return (x[0] * u[0] + x[1] * u[1]) / np.hypot(x[0], x[1])

    @skfem.BilinearForm
    def viscous(u, v, w):
        return 2.0 * at(viscosity, w.x) * ddot(sym_grad(u), sym_grad(v)) + 0.5 * at(
            rotational, w.x
        ) * curl(u) * curl(v)

    @skfem.BilinearForm
    def advected(u, v, w):
        flow = w["flow"] - turning(w.x)
        change = np.array([dot(flow, grad(u)[0]), dot(flow, grad(u)[1])])
        return at(weight, w.x) * (dot(change, v) + frame_rate * (u[0] * v[1] - u[1] * v[0]))

    @skfem.BilinearForm
    def expansion(p, v, w):
        return -p * div(v)

    @skfem.BilinearForm
    def continuity(u, q, w):
        return at(weight, w.x) * dot(u, grad(q))

    @skfem.BilinearForm
    def spin_to_flow(omega, v, w):
        return -at(rotational, w.x) * omega * curl(v)

    @skfem.BilinearForm
    def flow_to_spin(u, phi, w):
        return -at(rotational, w.x) * curl(u) * phi

    @skfem.BilinearForm
    def spins(omega, phi, w):
        return (
            at(diffusion, w.x) * dot(grad(omega), grad(phi))
            + 2.0 * at(rotational, w.x) * omega * phi
        )

    @skfem.BilinearForm
    def advected_spin(omega, phi, w):
        return inertia * at(weight, w.x) * dot(w["flow"] - turning(w.x), grad(omega)) * phi

    @skfem.BilinearForm
    def wall_force(u, v, w):
        # The second term keeps the fluid inside; its factor is large compared with viscosity over
        # element size.
        return at(friction, w.x) * along(u, w.x) * along(v, w.x) + 1e6 * through(u, w.x) * through(
            v, w.x
        )

    @skfem.BilinearForm
    def wall_from_spin(omega, v, w):
        return at(friction, w.x) * omega * along(v, w.x)

    @skfem.BilinearForm
    def wall_to_spin(u, phi, w):
        return at(friction, w.x) * along(u, w.x) * phi

    @skfem.BilinearForm
    def wall_torque(omega, phi, w):
        return at(friction, w.x) * omega * phi

    forces = skfem.LinearForm(
        lambda v, w: at(weight, w.x) * (gravity[0] * v[0] + gravity[1] * v[1])
    )
    drift = skfem.LinearForm(lambda q, w: at(weight, w.x) * dot(turning(w.x), grad(q)))
    couples = skfem.LinearForm(lambda phi, w: at(couple, w.x) * phi)
    moving_wall = skfem.LinearForm(lambda v, w: at(friction, w.x) * wall_speed * along(v, w.x))
    moving_wall_on_spin = skfem.LinearForm(lambda phi, w: at(friction, w.x) * wall_speed * phi)

    rhs = [forces.assemble(velocity), drift.assemble(pressure), couples.assemble(spin)]
    flow_flow, flow_spin = viscous.assemble(velocity), spin_to_flow.assemble(spin, velocity)
    spin_flow, spin_spin = flow_to_spin.assemble(velocity, spin), spins.assemble(spin)
    first_spin = velocity.N + pressure.N
    fixed, x = [np.array([velocity.N])], np.zeros(first_spin + spin.N)  # the pressure at one point
    if wall_spin is None:
        flow_flow = flow_flow + wall_force.assemble(wall_velocity)
        flow_spin = flow_spin + wall_from_spin.assemble(wall_of_spin, wall_velocity)
        spin_flow = spin_flow + wall_to_spin.assemble(wall_velocity, wall_of_spin)
        spin_spin = spin_spin + wall_torque.assemble(wall_of_spin)
        rhs[0] = rhs[0] + moving_wall.assemble(wall_velocity)
        rhs[2] = rhs[2] + moving_wall_on_spin.assemble(wall_of_spin)
    else:
        at_wall, spin_at_wall = (
            velocity.get_dofs().flatten(),
            spin.get_dofs().flatten() + first_spin,
        )
        x[at_wall] = velocity.project(lambda p: wall_speed / radius * np.array([-p[1], p[0]]))[
            at_wall
        ]
        x[spin_at_wall] = wall_spin
        fixed += [at_wall, spin_at_wall]
    for step in range(steps):
        more_flow = more_spin = 0.0
        if density is not None:
            flow = velocity.interpolate(x[: velocity.N])
            more_flow = advected.assemble(velocity, flow=flow)
            more_spin = advected_spin.assemble(spin, flow=flow)
        blocks = [
            [flow_flow + more_flow, expansion.assemble(pressure, velocity), flow_spin],
            [continuity.assemble(velocity, pressure), None, None],
            [spin_flow, None, spin_spin + more_spin],
        ]
        matrix = skfem.bmat(blocks, "csr")
        new = skfem.solve(
            *skfem.condense(matrix, np.concatenate(rhs), x=x, D=np.unique(np.concatenate(fixed)))
        )
        x = new if step == 0 else (1.0 - relax) * x + relax * new
    return mesh.p, x[velocity.nodal_dofs], x[first_spin + spin.nodal_dofs[0]]


# --- Prediction of the rotation -------------------------------------------------------------------


def grid_function(fields, values):
    """Linear interpolation of values at the points of the grid; a missing value counts as 0."""
    from scipy.interpolate import RegularGridInterpolator

    axis = np.unique(fields["x"][0])
    table = np.nan_to_num(values).reshape(len(axis), len(axis))
    interpolated = RegularGridInterpolator((axis, axis), table, bounds_error=False, fill_value=None)
    return lambda x: interpolated(np.stack([x[1], x[0]], -1))


def wall_law(fields, walls):
    """k of the wall's law, traction = k × pressure × slip/√(T/m) with the slip u_θ + ω, from
    wall.profile.csv of all seeds; the friction per length at each θ, and θ.

    If every collision with the wall stopped the slip, and the velocities were those of a gas, k
    would be (1 + 1/I)⁻¹/√(2π) = 0.363 for I = 10."""
    theta = np.radians(walls["theta"][0])
    radius = half_width(fields)
    points = (radius - 1.0) * np.array([np.cos(theta), np.sin(theta)])

    def there(name):
        return np.array([grid_function(fields, row)(points) for row in fields[name]])

    slip = there("u_y") * np.cos(theta) - there("u_x") * np.sin(theta) + there("spin")
    speed = np.sqrt(np.maximum(there("temperature"), 1e-3))
    law = fit((walls["pressure"] * slip / speed)[:, None], walls["traction"])
    return law, np.abs(law.coefficient[0]) * (walls["pressure"] / speed).mean(axis=0), theta


def fluid_of(fields, width=4.0):
    """Γ, η and D against the packing fraction: three functions of it. Below the lowest range they
    fall to zero with the packing fraction. A coefficient that is not certainly positive is that of
    the nearest range in which it is."""
    found = {}
    for name in ("rotational_viscosity", "shear_viscosity", "spin_diffusion"):
        middle, values = [], []
        for low in np.arange(0.2, 0.9, 0.1):
            value, error = closure(fields, low, low + 0.1, width)[name].coefficient
            if value > CERTAIN * error:
                middle.append(low + 0.05)
                values.append(value)
        if not values:
            raise ValueError(f"no {name} is certainly positive in these fields")
        found[name] = (np.array([0.0] + middle), np.log([0.01 * values[0]] + values))
    return {
        name: (lambda packing, t=table: np.exp(np.interp(packing, *t)))
        for name, table in found.items()
    }


def rigid_rotation(points, velocities, weights):
    """The rotation rate of the rigid body that fits the velocities best."""
    total = weights.sum()
    r = points - ((points * weights).sum(axis=1) / total)[:, None]
    v = velocities - ((velocities * weights).sum(axis=1) / total)[:, None]
    return np.sum(weights * (r[0] * v[1] - r[1] * v[0])) / np.sum(weights * (r * r).sum(axis=0))


def predicted_rotation(
    fields, walls, amplitude, period, *, diffusion=1.0, width=4.0, refinements=3, steps=6
):
    """ϖ/Ω of the micropolar fluid with the measured density, temperature, coefficients and wall
    law.

    `diffusion` multiplies D. Density and temperature are measured fields; flow and spin are solved
    for."""
    rate = 2.0 * np.pi / period
    radius = half_width(fields)
    packing = grid_function(fields, fields["packing"].mean(axis=0))
    temperature = grid_function(fields, np.nan_to_num(fields["temperature"]).mean(axis=0))
    fluid = fluid_of(fields, width)
    _, friction, theta = wall_law(fields, walls)

    def thermal(name, factor=1.0):
        return (
            lambda x: factor
            * fluid[name](packing(x))
            * np.sqrt(np.clip(temperature(x), 0.01, None))
        )

    def density(x):  # empty regions need a density
        return np.clip(packing(x), 0.01, None) / np.pi

    def friction_at(x):  # per length of the circle on which the discs' centres are
        angle = np.arctan2(x[1], x[0])
        return np.interp(angle, theta, friction, period=2.0 * np.pi) * radius / (radius - 1.0)

    points, velocities, _ = micropolar_flow(
        radius - 1.0,
        thermal("shear_viscosity"),
        thermal("rotational_viscosity"),
        thermal("spin_diffusion", diffusion),
        friction=friction_at,
        density=density,
        frame_rate=rate,
        gravity=(0.0, -amplitude * rate * rate),
        refinements=refinements,
        steps=steps,
    )
    inner = np.hypot(fields["x"][0], fields["y"][0]) < radius - 1.0
    grid = np.array([fields["x"][0], fields["y"][0]])[:, inner]
    from scipy.interpolate import LinearNDInterpolator

    flow = np.array([LinearNDInterpolator(points.T, row)(grid.T) for row in velocities])
    known = np.isfinite(flow[0])
    weights = fields["packing"].mean(axis=0)[inner][known]
    return rigid_rotation(grid[:, known], flow[:, known], weights) / rate


def measured_rotation(fields, period):
    """(mean, error) of the same from the measured velocities, over the seeds."""
    inner = np.hypot(fields["x"][0], fields["y"][0]) < half_width(fields) - 1.0
    grid = np.array([fields["x"][0], fields["y"][0]])[:, inner]
    rates = [
        rigid_rotation(grid, np.nan_to_num(np.array([ux, uy])[:, inner]), packing[inner])
        * period
        / (2.0 * np.pi)
        for ux, uy, packing in zip(fields["u_x"], fields["u_y"], fields["packing"])
    ]
    return swirl.mean(rates)[:2]


def print_flow(arguments):
    fields = read_seeds(arguments.tables)
    walls = read_seeds_of_wall(arguments.tables)
    law = wall_law(fields, walls)[0]
    print(f"wall: k = {with_error(*law.coefficient)}, explains {law.explained[0]:.4f}")
    print(
        f"measured ϖ/Ω = {with_error(*measured_rotation(fields, arguments.period))} "
        f"({len(arguments.tables)} seeds)"
    )
    for factor in (0.1, 1.0, 10.0):
        predicted = predicted_rotation(
            fields,
            walls,
            arguments.amplitude,
            arguments.period,
            diffusion=factor,
            width=arguments.width,
        )
        print(f"predicted ϖ/Ω = {predicted:.4f} with {factor:g} D", flush=True)


def read_seeds_of_wall(paths):
    """wall.profile.csv next to each table of fields."""
    tables = [read(os.path.join(os.path.dirname(path), "wall.profile.csv")) for path in paths]
    return {name: np.array([table[name] for table in tables]) for name in tables[0]}


def print_closure(arguments):
    fields = read_seeds(arguments.tables)
    print("packing, coefficient, value, error, share explained, its error, points")
    for low in np.arange(0.2, 0.9, 0.1):
        for name, found in closure(fields, low, low + 0.1, arguments.width).items():
            if found.points >= 10:
                (value, error), (explained, its_error) = found.coefficient, found.explained
                print(
                    f"{low:.1f}–{low + 0.1:.1f}, {name}, {value:.4g}, {error:.2g}, "
                    f"{explained:.3f}, {its_error:.2g}, {found.points}"
                )


def main():
    parser = argparse.ArgumentParser(
        description="Fits a micropolar fluid to fields, one table for each seed."
    )
    parser.add_argument("tables", nargs="+", help="fields.m_frame_4.csv of each seed")
    parser.add_argument("--width", type=float, default=4.0, help="width of the kernel in radii [4]")
    parser.add_argument(
        "--flow",
        action="store_true",
        help="predict the rotation; needs wall.profile.csv and scikit-fem",
    )
    parser.add_argument(
        "--amplitude", type=float, default=1.892, help="A of the run in radii [1.892]"
    )
    parser.add_argument("--period", type=float, default=11.866071, help="T of the run [11.866071]")
    arguments = parser.parse_args()
    try:
        print_flow(arguments) if arguments.flow else print_closure(arguments)
    except (OSError, ValueError, ImportError) as problem:
        sys.exit(f"error: {problem}")
