"""Fits a micropolar fluid to the fields of a run (docs/explanation/continuum.md).

    swirl run --discs 500 --container-radius 34.4 --amplitude 7.568 --measure fields --tables tables
    python3 examples/continuum.py tables/fields.m_frame_4.csv

Conventions: σ_ab has the force's index first, and the torque of the stress is τ = σ_yx − σ_xy. The
fluid has

    τ = −Γ (2ω − curl u)      C = D ∇ω      deviator of σ = 2 η × (deviator of the strain rate)

Needs numpy. micropolar_flow() needs scikit-fem (pip install scikit-fem), too.
"""

import csv
import sys

import numpy as np


def read(path):
    """The columns of a table of fields as arrays; an empty cell is NaN."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name] or "nan") for row in rows]) for name in rows[0]}


def proportional(x, y, error):
    """The coefficient k of y = k x with its error, and the share R² of y's weighted square that it explains.

    Points are weighted by 1/error². The error is that of the scatter about the line.
    """
    good = np.isfinite(x) & np.isfinite(y) & np.isfinite(error) & (error > 0)
    x, y, weight = x[good], y[good], error[good] ** -2.0
    if len(x) < 3:
        return {"value": np.nan, "error": np.nan, "explained": np.nan, "points": len(x)}
    square = np.sum(weight * x * x)
    value = np.sum(weight * x * y) / square
    rest = np.sum(weight * (y - value * x) ** 2)
    return {
        "value": value,
        "error": np.sqrt(rest / (len(x) - 1) / square),
        "explained": 1.0 - rest / np.sum(weight * y * y),
        "points": len(x),
    }


def henderson(packing):
    """Z = p/(n T) of a gas of smooth elastic hard discs (Henderson 1975, doi:10.1080/00268977500102511)."""
    return 1.0 + 2.0 * packing * (1.0 - 7.0 * packing / 16.0) / (1.0 - packing) ** 2


def closure(fields, low, high):
    """The coefficients from all points whose packing fraction is between these two.

    Keys: rotational_viscosity Γ, shear_viscosity η, spin_diffusion D, and pressure, the ratio of p to that of
    smooth elastic discs.
    """
    chosen = (fields["packing"] >= low) & (fields["packing"] < high)
    f = {name: column[chosen] for name, column in fields.items()}
    stress, strain, stress_error = [], [], []
    for kind in ("xx", "xy"):
        value, error = f[f"kinetic_{kind}"] + f[f"collisional_{kind}"], f[f"collisional_{kind}_error"]
        if kind == "xx":
            value = 0.5 * (value - f["kinetic_yy"] - f["collisional_yy"])
            error = 0.5 * np.hypot(error, f["collisional_yy_error"])
        stress.append(value)
        strain.append(2.0 * f[f"strain_{kind}"])
        stress_error.append(error)
    couple = [f[f"kinetic_couple_{a}"] + f[f"collisional_couple_{a}"] for a in "xy"]
    density = f["packing"] / np.pi  # of discs of radius 1
    expected = density * f["temperature"] * henderson(f["packing"])
    return {
        "rotational_viscosity": proportional(f["vorticity"] - 2.0 * f["spin"], f["torque"], f["torque_error"]),
        "shear_viscosity": proportional(np.concatenate(strain), np.concatenate(stress), np.concatenate(stress_error)),
        "spin_diffusion": proportional(
            np.concatenate([f["spin_gradient_x"], f["spin_gradient_y"]]),
            np.concatenate(couple),
            np.concatenate([f["collisional_couple_x_error"], f["collisional_couple_y_error"]]),
        ),
        "pressure": proportional(expected, f["pressure"], f["pressure_error"]),
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


def closed_form(radius, wall_speed, wall_spin, viscosity, rotational, diffusion):
    """u_θ(r) and ω(r) of the steady flow in a disc: a r + b I₁(κr), with both values given at the wall."""
    kappa = decay_rate(viscosity, rotational, diffusion)
    spin_factor = kappa * (0.5 + viscosity / rotational)
    matrix = [[radius, bessel_i(1, kappa * radius)], [1.0, spin_factor * bessel_i(0, kappa * radius)]]
    a, b = np.linalg.solve(np.array(matrix, dtype=float), [wall_speed, wall_spin])
    return (
        lambda r: a * r + b * bessel_i(1, kappa * r),
        lambda r: a + b * spin_factor * bessel_i(0, kappa * r),
    )


def micropolar_flow(radius, wall_speed, wall_spin, viscosity, rotational, diffusion, refinements=4):
    """The same flow by finite elements (Taylor and Hood): points, velocities and spins at the vertices.

    This solves in two dimensions, so other walls, forces and coefficients need few changes.
    """
    import skfem
    from skfem.helpers import ddot, div, dot, grad, sym_grad

    def curl(u):
        return grad(u)[1, 0] - grad(u)[0, 1]

    mesh = skfem.MeshTri.init_circle(refinements).scaled(radius)
    quadratic = skfem.ElementTriP2()
    elements = [skfem.ElementVector(quadratic), skfem.ElementTriP1(), quadratic]
    velocity, pressure, spin = (skfem.Basis(mesh, element, intorder=4) for element in elements)

    @skfem.BilinearForm
    def viscous(u, v, _):
        return 2.0 * viscosity * ddot(sym_grad(u), sym_grad(v)) + 0.5 * rotational * curl(u) * curl(v)

    @skfem.BilinearForm
    def continuity(u, q, _):
        return -div(u) * q

    @skfem.BilinearForm
    def spin_to_flow(omega, v, _):
        return -rotational * omega * curl(v)

    @skfem.BilinearForm
    def flow_to_spin(u, phi, _):
        return -rotational * curl(u) * phi

    @skfem.BilinearForm
    def spins(omega, phi, _):
        return diffusion * dot(grad(omega), grad(phi)) + 2.0 * rotational * omega * phi

    B = continuity.assemble(velocity, pressure)
    blocks = [
        [viscous.assemble(velocity), B.T, spin_to_flow.assemble(spin, velocity)],
        [B, None, None],
        [flow_to_spin.assemble(velocity, spin), None, spins.assemble(spin)],
    ]
    matrix = skfem.bmat(blocks, "csr")
    x = np.zeros(matrix.shape[0])
    at = velocity.get_dofs()
    first_spin = velocity.N + pressure.N
    turning = velocity.project(lambda p: wall_speed / radius * np.array([-p[1], p[0]]))
    x[at.flatten()] = turning[at.flatten()]
    wall = spin.get_dofs().flatten() + first_spin
    x[wall] = wall_spin
    fixed = np.concatenate([at.flatten(), [velocity.N], wall])  # and the pressure at one point
    x = skfem.solve(*skfem.condense(matrix, np.zeros(len(x)), x=x, D=fixed))
    return mesh.p, x[velocity.nodal_dofs], x[first_spin + spin.nodal_dofs[0]]


def main(paths):
    print("packing, coefficient, value, error, share explained, points")
    for path in paths:
        fields = read(path)
        for low in np.arange(0.2, 0.9, 0.1):
            for name, fit in closure(fields, low, low + 0.1).items():
                if fit["points"] >= 10:
                    print(
                        f"{low:.1f}–{low + 0.1:.1f}, {name}, {fit['value']:.4g}, {fit['error']:.2g}, "
                        f"{fit['explained']:.3f}, {fit['points']}"
                    )


if __name__ == "__main__":
    main(sys.argv[1:])
