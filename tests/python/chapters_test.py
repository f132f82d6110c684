"""The statistics of the chapters, on curves and fields whose answers are known in closed form."""

import math
import os
import sys
import types

import numpy as np
import pytest

sys.path.insert(0, os.path.join(os.environ["SWIRL_SOURCE"], "paper"))
import curves  # noqa: E402
from chapters import cooling, lifetimes  # noqa: E402
from chapters.critical import power_law, verdict_on  # noqa: E402
from coarse_zero import last_zero, zero_of_curve  # noqa: E402
from dishes import fluctuations, shares_of_the_states  # noqa: E402
from jackknife import jackknife  # noqa: E402
from micropolar import RELATIONS, Relation, fit_relation  # noqa: E402
from swirled_state import densities, fit_hypotrochoids  # noqa: E402

EXACT = 1e-12  # rounding errors of sums of a few hundred terms


def curve(function, numbers, error=1e-6):
    return [(n, function(n), error) for n in numbers]


def test_the_zero_of_a_parabola_is_exact():
    zero, falls = last_zero(curve(lambda n: 1 - (n / 30) ** 2, (20, 26, 35, 44)))
    assert falls and zero.discs == pytest.approx(30, abs=EXACT) and zero.interpolation < EXACT


def test_the_zero_of_a_cubic_is_within_its_interpolation_error():
    zero = zero_of_curve(curve(lambda n: -((n - 30) / 10) ** 3 - 0.1 * (n - 30), (18, 26, 36, 46)), 1)
    # The two parabolas bound the zero, more closely than the two points alone do.
    assert abs(zero.discs - 30) <= zero.interpolation < 10 / math.sqrt(12)


def test_two_points_leave_the_uniform_error_of_their_distance():
    zero = zero_of_curve(curve(lambda n: 30 - n, (28, 34)), 0)
    assert (zero.discs, zero.interpolation) == pytest.approx((30, 6 / math.sqrt(12)), abs=EXACT)


def test_a_curve_without_a_certain_sign_has_no_zero():
    assert last_zero(curve(lambda n: 30 - n, (28, 34), error=10)) == (None, False)
    assert last_zero([]) == (None, False)


def test_the_jackknife_of_a_mean_is_its_standard_error():
    values = np.random.default_rng(1).normal(size=12)
    assert jackknife(12, lambda k: values[k].mean()) == pytest.approx(
        (values.mean(), values.std(ddof=1) / math.sqrt(12)), abs=EXACT)
    assert all(map(math.isnan, jackknife(3, lambda k: 1.0)))


def seeds_with(noise, **more):
    """Six seeds of a stress with η = 2, η_o = 0.5 and η_n = −0.3, whose columns have independent errors."""
    random = np.random.default_rng(7)
    xx, xy = random.normal(size=(2, 400))
    vorticity = random.normal(size=400)
    even, odd = np.array([xx, xy]), np.array([-xy, xx])
    stress = 2 * (2 * even + (0.5 - 0.3 * np.sign(vorticity)) * odd)  # √(mT) = 1
    seeds = []
    for _ in range(6):
        def noisy(column):
            return column + noise * random.normal(size=400)
        zero = np.zeros(400)
        seeds.append({"x": zero, "y": zero, "packing": np.full(400, 0.5), "temperature": np.ones(400),
                      "vorticity": vorticity, "strain_xx": noisy(xx), "strain_xy": noisy(xy), "kinetic_xx": noisy(stress[0]),
                      "kinetic_yy": noisy(-stress[0]), "kinetic_xy": noisy(stress[1]), "collisional_xx": zero,
                      "collisional_yy": zero, "collisional_xy": zero, "collisional_yx": zero, **more})
    return seeds


def coefficients(seeds):
    return [fit_relation(seeds, relation, 0.4, 0.6, 1).coefficient for relation in (RELATIONS[1], *RELATIONS[4:])]


def test_even_odd_and_normal_parts_of_the_stress_are_separated():
    (eta, _), (odd, _), (normal, _) = coefficients(seeds_with(0))
    # The even part alone is not biased, because e and e* are orthogonal at every point.
    assert (eta, odd, normal) == pytest.approx((2, 0.5, -0.3), abs=EXACT)
    fit = fit_relation(seeds_with(0), RELATIONS[4], 0.4, 0.6, 1)
    assert fit.explained[0] == pytest.approx(1, abs=EXACT) and fit.points == 400


def test_noise_does_not_bias_the_coefficients():
    # Ordinary least squares would give η = 2/(1 + 0.5²) = 1.6.
    for (found, error), exact in zip(coefficients(seeds_with(0.5)), (2, 0.5, -0.3)):
        assert abs(found - exact) < 4 * error and error < 0.1


def test_a_vorticity_of_one_sign_leaves_odd_and_normal_parts_undetermined():
    seeds = seeds_with(0, vorticity=np.ones(400))
    assert all(math.isnan(found) for found, _ in coefficients(seeds)[1:])
    assert coefficients(seeds)[0][0] == pytest.approx(2, abs=EXACT)


def test_points_outside_the_range_or_with_a_missing_value_are_omitted():
    seeds = seeds_with(0)
    seeds[3]["strain_xx"][:10] = math.nan
    seeds[0]["packing"][10:20] = 3  # a mean of 0.92
    assert fit_relation(seeds, RELATIONS[1], 0.4, 0.6, 1).points == 380
    assert fit_relation(seeds, RELATIONS[1], 0.7, 0.8, 1).points == 0
    assert fit_relation([], Relation("", "", "", (), None), 0, 1, 1).points == 0


def test_a_smooth_gas_cools_by_its_collisions_and_its_wall():
    haff = cooling.CASES[0]
    rate = (1 - 0.9 ** 2) / 2
    # In a large dish the wall takes part in few collisions, so Haff's law remains.
    assert haff.after(3, 1e14)[0] == pytest.approx(math.exp(-3 * rate), rel=1e-6)
    assert haff.after(3, 1000)[0] < math.exp(-3 * rate)
    # T = exp(−aτ), so the time in units of 1/ν is ∫ exp(aτ/2) dτ.
    assert haff.time_of(3, 1e14) == pytest.approx((math.exp(1.5 * rate) - 1) / (rate / 2), rel=1e-6)


def test_perfectly_rough_elastic_discs_keep_their_energy_and_share_it():
    elastic = cooling.CASES[1]
    for tau in (0.5, 3, 30):
        translation, spins = elastic.after(tau, 1000)
        assert translation + spins / 2 == pytest.approx(1, abs=EXACT)
    # T = 1/(1 + 1/2) when T = T_s; after 30 collisions what remains of the difference is below e^{-10}.
    assert (translation, spins) == pytest.approx((2 / 3, 2 / 3), abs=1e-4)


def test_the_path_of_a_disc_of_a_rolling_cluster_is_recognised():
    times = 2 * np.pi * np.arange(240)[:, None] / 60
    paths = 3 * np.exp(1j * times) + np.array([1, 2j, 4]) * np.exp(-0.1j * times)
    rotation, distance = fit_hypotrochoids(paths)
    # ϖ is on the grid of the search; the distance is the root of a difference of squares, so of √ε.
    assert rotation == pytest.approx(-0.1, abs=EXACT) and distance < 1e-6
    assert fit_hypotrochoids(paths + 0.5 * np.exp(0.7j * times ** 2))[1] > 0.3


def test_the_density_in_rings_counts_every_particle_once():
    distance = np.sqrt(np.random.default_rng(1).uniform(0, 9, size=(50, 40)))
    found = densities(distance)
    rings = np.arange(len(found) + 1) / 5
    assert np.sum(found * np.pi * np.diff(rings ** 2)) == pytest.approx(40, abs=1e-9)
def test_a_power_law_is_recovered_and_two_sizes_have_none():
    sizes = (8.6, 12, 17.2, 24)
    exponent, error, factor, chi_square, count = power_law([(R, 3 * R ** 1.5, 0.01 * R ** 1.5) for R in sizes])
    assert (exponent, factor, count) == pytest.approx((1.5, 3, 4), abs=EXACT) and chi_square < EXACT and error < 0.01
    assert math.isnan(power_law([(R, R, 0.1) for R in sizes[:2]])[0])


@pytest.mark.parametrize("slope, correlation, binder, verdict", [
    ((1.0, 0.1), (0.9, 0.2), (0.0, 0.1), "critical"), ((0.1, 0.1), (0.0, 0.1), (0.0, 0.1), "crossover"),
    ((1.0, 5.0), (0.0, 0.1), (0.0, 0.1), "undecided"),  # the error of the slope is no evidence
    ((math.nan, math.nan), (0.0, 0.1), (0.0, 0.1), "undecided"), ((1.0, 0.1), (0.0, 0.1), (0.0, 0.1), "undecided"),
    ((0.1, 0.1), (0.0, 0.1), (0.6, 0.05), "first order"),
    ((math.nan, math.nan), (math.nan, math.nan), (math.nan, math.nan), "too few sizes to tell")])
def test_missing_evidence_leaves_the_verdict_open(slope, correlation, binder, verdict):
    assert verdict_on({"slope": slope, "correlation": correlation}, binder) == verdict


def test_two_equal_states_have_the_binder_cumulant_of_two_thirds():
    found = fluctuations([1.0, 1.0, -1.0, -1.0] * 25, 10)
    assert (found["binder"], found["variance"]) == pytest.approx((2 / 3, 100 / 99), abs=EXACT)
    assert math.isnan(fluctuations([0.1] * 100, 10)["binder"])


def point_of(rates, disagree):
    runs = [{"rotation": {"rigid_by_time": {"mean": mean, "error": 0.01}}} for mean in rates]
    return types.SimpleNamespace(runs=runs, result={"seeds": {"disagree": disagree}})


def test_seeds_in_two_states_are_counted_where_they_disagree():
    assert shares_of_the_states(point_of([0.1, -0.1, -0.2, 0.01], True)) == {"share_rotating": 0.25,
                                                                             "share_counterrotating": 0.5}
    assert set(shares_of_the_states(point_of([0.1, -0.1], False)).values()) == {None}
    runs = [{"periods": [40, 20], "exits": [1, 0], "sums": [4.0, -2.0], "last": last} for last in (1, 1, 0)]
    rows = lifetimes.table([types.SimpleNamespace(runs=runs)], None)[0][""]
    assert [row["share_ended"] for row in rows] == [1 / 3, 2 / 3]
    assert [(row["lifetime"], row["rotation"]) for row in rows] == [(40, 0.1), (20, -0.1)]


def test_the_sign_changes_of_a_curve_are_listed_in_order():
    points = [types.SimpleNamespace(cells={"discs": n}, result={"rotation": {rate: {"mean": mean, "error": 0.01}
                                                                             for rate in curves.RATES}})
              for n, mean in ((8, 0.0), (20, 0.2), (28, -0.1), (36, 0.3), (44, 0.0))]
    found = curves.sign_change_rows(curves.Curve("", points), {})
    assert [(row["before"], row["after"], row["direction"]) for row in found] == [
        (8, 8, "undetermined"), (20, 28, "counterrotation"), (28, 36, "rotation"), (44, 44, "undetermined")]
