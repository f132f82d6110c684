"""The fits of paper/continuum.py recover planted coefficients, and its flow matches two closed
forms."""

import csv
import os
import subprocess
import sys

import numpy as np
import pytest

from paper import continuum
from paper.hard_discs import pressure_ratio

COEFFICIENTS = {
    "rotational_viscosity": 0.7,
    "shear_viscosity": 1.3,
    "spin_diffusion": 0.4,
    "pressure": 1.1,
}


def planted(noise, seeds=8, shared=0.0):
    """Fields of a micropolar fluid with these coefficients in a container of radius 40, and noise
    in each seed.

    `shared` is noise that spin and torque of a seed have in common.
    """
    random = np.random.default_rng(1)
    axis = -39.0 + 2.0 * np.arange(40)
    x, y = (grid.ravel() for grid in np.meshgrid(axis, axis))
    n = len(x)
    f = {name: random.normal(size=n) for name in ("vorticity", "spin", "strain_xx", "strain_xy")}
    f |= {f"spin_gradient_{a}": random.normal(size=n) for a in "xy"}
    f |= {name: random.normal(size=n) for name in ("kinetic_xx", "kinetic_xy", "kinetic_yy")}
    f |= {f"kinetic_couple_{a}": random.normal(size=n) for a in "xy"}
    exact = {
        "x": x,
        "y": y,
        "packing": random.uniform(0.3, 0.4, size=n),
        "temperature": random.uniform(1.0, 4.0, size=n),
    }
    speed = np.sqrt(exact["temperature"])
    f |= {
        "torque": -0.7 * speed * (2.0 * f["spin"] - f["vorticity"]),
        # The stress of a fluid of spinning discs is not symmetric: its antisymmetric part is the
        # torque.
        "collisional_xy": 2.0 * 1.3 * speed * f["strain_xy"] - f["kinetic_xy"] - 0.25,
        "collisional_yx": 2.0 * 1.3 * speed * f["strain_xy"] - f["kinetic_xy"] + 0.25,
        "collisional_xx": -1.0 + 2.0 * 1.3 * speed * f["strain_xx"] - f["kinetic_xx"],
        "collisional_yy": -1.0 - 2.0 * 1.3 * speed * f["strain_xx"] - f["kinetic_yy"],
        "collisional_couple_x": 0.4 * speed * f["spin_gradient_x"] - f["kinetic_couple_x"],
        "collisional_couple_y": 0.4 * speed * f["spin_gradient_y"] - f["kinetic_couple_y"],
        "pressure": 1.1
        * exact["packing"]
        / np.pi
        * exact["temperature"]
        * pressure_ratio(exact["packing"]),
    }
    tables = {name: np.tile(value, (seeds, 1)) for name, value in exact.items()}
    tables |= {name: value + noise * random.normal(size=(seeds, n)) for name, value in f.items()}
    common = shared * random.normal(size=(seeds, n))
    tables["spin"] = tables["spin"] + common
    tables["torque"] = tables["torque"] + 3.0 * common
    return tables


@pytest.mark.parametrize("name", COEFFICIENTS)
def test_fits_recover_planted_coefficients(name):
    exact = continuum.closure(planted(0.0), 0.3, 0.4)[name]
    # The sums are differences of squares of 8 equal seeds.
    assert exact.coefficient[0] == pytest.approx(COEFFICIENTS[name], rel=1e-10)
    assert exact.explained[0] == pytest.approx(1.0, abs=1e-10)
    # A plain fit of D with this noise would give 0.4/(1 + noise²), since ⟨x²⟩ = 1.
    noisy = continuum.closure(planted(1.0), 0.3, 0.4)[name]
    (value, error), (explained, its_error) = noisy.coefficient, noisy.explained
    assert 0.0 < error < 0.05
    assert abs(value - COEFFICIENTS[name]) < 4.0 * error
    assert abs(explained - 1.0) < 4.0 * its_error


def test_noise_that_spin_and_torque_share_does_not_bias_the_fit():
    # A plain fit would give (0.7 · 5 − 3 · 2)/(5 + 4) < 0, since ⟨x²⟩ = 5.
    value, error = continuum.closure(planted(0.1, shared=1.0), 0.3, 0.4)[
        "rotational_viscosity"
    ].coefficient
    assert abs(value - 0.7) < 4.0 * error
    assert error < 0.1


def test_points_near_the_wall_or_of_another_packing_fraction_do_not_count():
    f = planted(0.1)
    far = np.hypot(f["x"][0], f["y"][0]) >= 40.0 - 5.0
    f["torque"][:, far] = 1e3
    f["packing"][:, ::3] = 0.45
    inner = int(np.sum(~far & (f["packing"][0] < 0.4)))
    fit = continuum.closure(f, 0.3, 0.4)["rotational_viscosity"]
    assert fit.points == inner
    assert abs(fit.coefficient[0] - 0.7) < 4.0 * fit.coefficient[1]


def test_nothing_is_explained_where_nothing_is_planted():
    f = planted(0.1)
    f["torque"] = np.tile(np.random.default_rng(2).normal(size=f["torque"].shape[1]), (8, 1))
    fit = continuum.closure(f, 0.3, 0.4)["rotational_viscosity"]
    assert (
        fit.explained[0] < 0.01
    )  # the correlation of 960 random pairs is 1/√960, and its square is below 10/960


def test_fewer_than_four_seeds_have_no_fit():
    for seeds in (1, 3):
        assert np.isnan(
            continuum.closure(planted(0.1, seeds=seeds), 0.3, 0.4)["pressure"].coefficient
        ).all()
    assert np.isfinite(
        continuum.closure(planted(0.1, seeds=4), 0.3, 0.4)["pressure"].coefficient
    ).all()


def test_the_measured_rotation_has_the_error_of_all_means_over_seeds():
    f = planted(0.0, seeds=4)
    rates = np.array([0.1, 0.2, 0.4, 0.5])
    f["u_x"], f["u_y"] = -rates[:, None] * f["y"], rates[:, None] * f["x"]
    mean, error = continuum.measured_rotation(f, 2.0 * np.pi)
    assert mean == pytest.approx(0.3)
    # √(Σ (m − 0.3)²/(4 · 3)) with Student's factor for three degrees of freedom, 3.1824/1.96.
    assert error == pytest.approx(np.sqrt(0.1 / 12) * 3.1824463 / 1.9599640, rel=1e-6)


@pytest.mark.parametrize("couple, slip", [(0.0, False), (0.0, True), (0.6, True)])
def test_the_closed_forms_solve_the_equations(couple, slip):
    eta, gamma, diffusion, friction, speed = 1.3, 0.7, 0.4, 0.8, -1.0
    if slip:
        u, omega = continuum.closed_form_with_slip(
            3.0, friction, speed, couple, eta, gamma, diffusion
        )
    else:
        u, omega = continuum.closed_form(3.0, speed, 0.5, eta, gamma, diffusion)
        assert u(3.0) == pytest.approx(speed)
        assert omega(3.0) == pytest.approx(0.5)
    h = 1e-3
    vorticity = lambda x: ((x + h) * u(x + h) - (x - h) * u(x - h)) / (2.0 * h * x)  # noqa: E731
    slope = lambda f, x: (f(x + h) - f(x - h)) / (2.0 * h)  # noqa: E731
    r = np.linspace(0.5, 2.5, 9)
    laplacian = (omega(r + h) - 2.0 * omega(r) + omega(r - h)) / h**2 + slope(omega, r) / r
    # Differences of order h²; the fields are of order 1.
    assert diffusion * laplacian + couple == pytest.approx(
        gamma * (2.0 * omega(r) - vorticity(r)), abs=1e-4
    )
    assert (eta + 0.5 * gamma) * slope(vorticity, r) == pytest.approx(
        gamma * slope(omega, r), abs=1e-4
    )
    if not slip:
        return
    # At the wall, the stress σ_θr and the couple stress are the wall's force and torque per length.
    force = -friction * (u(3.0) + omega(3.0) - speed)
    strain = slope(lambda x: u(x) / x, 3.0) * 3.0
    torque = -gamma * (2.0 * omega(3.0) - vorticity(3.0))
    assert eta * strain + 0.5 * torque == pytest.approx(force, abs=1e-4)
    assert diffusion * slope(omega, 3.0) == pytest.approx(force, abs=1e-4)


def deviations(flow, closed_form):
    points, velocities, spins = flow
    u, omega = closed_form
    r = np.hypot(*points)
    inner = r > 0.1
    azimuthal = (points[0] * velocities[1] - points[1] * velocities[0])[inner] / r[inner]
    return np.abs(azimuthal - u(r[inner])).max(), np.abs(spins - omega(r)).max()


FLUID = (1.3, 0.7, 0.4)


def test_finite_elements_match_the_closed_form_with_given_values_at_the_wall():
    pytest.importorskip("skfem")
    flow = continuum.micropolar_flow(3.0, *FLUID, wall_speed=-1.0, wall_spin=0.5)
    # The circle is a polygon of 64 sides: its area is 0.2 % too small.
    assert max(deviations(flow, continuum.closed_form(3.0, -1.0, 0.5, *FLUID))) < 0.005


def test_finite_elements_match_the_closed_form_with_slip_and_drive():
    pytest.importorskip("skfem")
    flow = continuum.micropolar_flow(3.0, *FLUID, wall_speed=-1.0, friction=0.8, couple=0.6)
    assert (
        max(deviations(flow, continuum.closed_form_with_slip(3.0, 0.8, -1.0, 0.6, *FLUID))) < 0.005
    )


def test_a_fluid_of_uniform_density_in_a_turning_frame_rests_relative_to_a_rough_container():
    """Gravity and pressure balance, so u = 0 although the container's frame turns."""
    pytest.importorskip("skfem")
    _, velocities, spins = continuum.micropolar_flow(
        3.0, *FLUID, friction=2.0, density=0.2, frame_rate=0.5, gravity=(0.3, -1.0), steps=3
    )
    assert np.abs(velocities).max() < 1e-6  # the penalty of flow through the wall
    assert np.abs(spins).max() < 1e-6


def test_an_off_centre_cluster_moves_with_its_place_in_the_frame():
    """∇·ρ(u − Ωẑ×x) = 0 makes the mean velocity of the mass that of its centre, Ωẑ × x."""
    skfem = pytest.importorskip("skfem")
    density = lambda x: 0.02 + np.exp(-((x[0] - 1.0) ** 2 + x[1] ** 2))  # noqa: E731
    points, velocities, _ = continuum.micropolar_flow(
        3.0, *FLUID, friction=2.0, density=density, frame_rate=0.5
    )
    mesh = skfem.MeshTri.init_circle(4).scaled(3.0)
    area = skfem.LinearForm(lambda v, _: v).assemble(skfem.Basis(mesh, skfem.ElementTriP1()))
    weights = density(points) * area
    centre, mean = ((field * weights).sum(axis=1) / weights.sum() for field in (points, velocities))
    # The sum over the vertices has an error of the order (0.2)², the size of a triangle, times a
    # tenth.
    assert mean == pytest.approx(0.5 * np.array([-centre[1], centre[0]]), abs=0.03)


def test_the_wall_law_recovers_a_planted_coefficient():
    pytest.importorskip("scipy")
    f = planted(0.0)
    radius = np.hypot(f["x"], f["y"])
    f["u_x"], f["u_y"], f["spin"] = -f["y"] / 40.0, f["x"] / 40.0, 0.0 * radius + 0.25
    f["temperature"] = 0.0 * radius + 4.0
    theta = np.tile(np.arange(2.5, 360.0, 5.0), (8, 1))
    slip = 39.0 / 40.0 + 0.25
    pressure = 1.0 + np.random.default_rng(3).uniform(size=theta.shape)
    law, friction, _ = continuum.wall_law(
        f, {"theta": theta, "pressure": pressure, "traction": -0.3 * pressure * slip / 2.0}
    )
    assert law.coefficient[0] == pytest.approx(-0.3, rel=1e-9)
    assert friction == pytest.approx(0.3 * pressure.mean(axis=0) / 2.0, rel=1e-9)


def script(*words):
    call = [sys.executable, os.path.join(os.environ["SWIRL_SOURCE"], "paper"), "continuum", *words]
    return subprocess.run(call, capture_output=True, text=True)


def write(path, columns):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows(zip(*columns.values()))


def test_bad_tables_are_errors(tmp_path):
    other = str(tmp_path / "other.csv")
    write(other, {"x": [0.0], "y": [0.0]})
    assert "error:" in script(str(tmp_path / "none.csv")).stderr
    done = script(other)
    assert done.returncode == 1 and "no table of fields" in done.stderr
    (tmp_path / "empty.csv").write_text("x,y\n")
    assert "has no rows" in script(str(tmp_path / "empty.csv")).stderr
    first, second = planted(0.1, seeds=1), planted(0.1, seeds=1)
    second["x"] = second["x"] * 2.0
    for name, table in (("a.csv", first), ("b.csv", second)):
        write(tmp_path / name, {column: values[0] for column, values in table.items()})
    done = script(str(tmp_path / "a.csv"), str(tmp_path / "b.csv"))
    assert done.returncode == 1 and "has other points" in done.stderr
    done = script("--flow", str(tmp_path / "a.csv"))
    assert done.returncode == 1 and "wall.profile.csv" in done.stderr
