"""The fits of examples/continuum.py recover planted coefficients, and its flow matches the closed form."""

import os
import sys

import numpy as np
import pytest

sys.path.insert(0, os.path.join(os.environ["SWIRL_SOURCE"], "examples"))
import continuum  # noqa: E402

COEFFICIENTS = {"rotational_viscosity": 0.7, "shear_viscosity": 1.3, "spin_diffusion": 0.4, "pressure": 1.1}


def planted(noise):
    """Fields of a micropolar fluid with these coefficients, and errors of the size `noise`."""
    random = np.random.default_rng(1)
    n = 4000
    f = {name: random.normal(size=n) for name in ("vorticity", "spin", "strain_xx", "strain_xy")}
    f |= {f"spin_gradient_{a}": random.normal(size=n) for a in "xy"}
    f["packing"] = random.uniform(0.3, 0.4, size=n)
    f["temperature"] = random.uniform(1.0, 2.0, size=n)
    exact = {
        "torque": -0.7 * (2.0 * f["spin"] - f["vorticity"]),
        "collisional_xy": 2.0 * 1.3 * f["strain_xy"],
        "collisional_xx": -1.0 + 2.0 * 1.3 * f["strain_xx"],
        "collisional_yy": -1.0 - 2.0 * 1.3 * f["strain_xx"],
        "collisional_couple_x": 0.4 * f["spin_gradient_x"],
        "collisional_couple_y": 0.4 * f["spin_gradient_y"],
        "pressure": 1.1 * f["packing"] / np.pi * f["temperature"] * continuum.henderson(f["packing"]),
    }
    for name, value in exact.items():
        f[name] = value + noise * random.normal(size=n)
        f[name + "_error"] = np.full(n, max(noise, 1e-3))
    for name in ("kinetic_xx", "kinetic_xy", "kinetic_yy", "kinetic_couple_x", "kinetic_couple_y"):
        f[name] = np.zeros(n)
    return f


@pytest.mark.parametrize("name", COEFFICIENTS)
def test_fits_recover_planted_coefficients(name):
    exact = continuum.closure(planted(0.0), 0.3, 0.4)[name]
    assert exact["value"] == pytest.approx(COEFFICIENTS[name], rel=1e-12)  # rounding
    assert exact["explained"] == pytest.approx(1.0, abs=1e-12)
    noisy = continuum.closure(planted(0.3), 0.3, 0.4)[name]
    assert abs(noisy["value"] - COEFFICIENTS[name]) < 4.0 * noisy["error"]
    assert noisy["error"] < 0.02
    assert noisy["explained"] < 1.0


def test_nothing_is_explained_where_nothing_is_planted():
    f = planted(0.0)
    f["torque"] = np.random.default_rng(2).normal(size=len(f["torque"]))
    fit = continuum.closure(f, 0.3, 0.4)["rotational_viscosity"]
    assert fit["explained"] < 0.01  # 1/√4000 for the correlation, so its square is below 10 / 4000
    assert abs(fit["value"]) < 4.0 * fit["error"]


def test_the_closed_form_solves_the_equations():
    eta, gamma, diffusion = 1.3, 0.7, 0.4
    u, omega = continuum.closed_form(3.0, -1.0, 0.5, eta, gamma, diffusion)
    assert u(3.0) == pytest.approx(-1.0)
    assert omega(3.0) == pytest.approx(0.5)
    r, h = np.linspace(0.5, 2.5, 9), 1e-3
    vorticity = lambda x: ((x + h) * u(x + h) - (x - h) * u(x - h)) / (2.0 * h * x)  # noqa: E731
    slope = lambda f: (f(r + h) - f(r - h)) / (2.0 * h)  # noqa: E731
    laplacian = (omega(r + h) - 2.0 * omega(r) + omega(r - h)) / h**2 + slope(omega) / r
    # Differences of order h²; the fields are of order 1.
    assert diffusion * laplacian == pytest.approx(gamma * (2.0 * omega(r) - vorticity(r)), abs=1e-4)
    assert (eta + 0.5 * gamma) * slope(vorticity) == pytest.approx(gamma * slope(omega), abs=1e-4)


def test_finite_elements_match_the_closed_form():
    pytest.importorskip("skfem")
    arguments = (3.0, -1.0, 0.5, 1.3, 0.7, 0.4)
    u, omega = continuum.closed_form(*arguments)
    points, velocities, spins = continuum.micropolar_flow(*arguments)
    r = np.hypot(*points)
    inner = r > 0.1
    azimuthal = (points[0] * velocities[1] - points[1] * velocities[0])[inner] / r[inner]
    # The circle is a polygon of 64 sides: its area is 0.2 % too small.
    assert azimuthal == pytest.approx(u(r[inner]), abs=0.005)
    assert spins == pytest.approx(omega(r), abs=0.005)
