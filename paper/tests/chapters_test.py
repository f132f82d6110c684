"""The statistics of the chapters, on curves and fields whose answers are known in closed form."""

import csv
import math
import os
import types

import numpy as np
import pytest
import swirl

from paper import catalogue, cluster_axis, curves, study
from paper.chapters import coexistence, cooling, gear_order, lifetimes
from paper.chapters.critical import power_law, scaling_tables, verdict_on
from paper.coarse_zero import crossing_of_curve, last_zero, zero_of_curve
from paper.standard_runs import direction_changes, kind_of, shares_of_the_states
from paper.hard_discs import kinematic_viscosity, sound_speed
from paper.jackknife import jackknife
from paper.micropolar import RELATIONS, Relation, fit_relation
from paper.swirled_state import densities, fit_hypotrochoids

EXACT = 1e-12  # rounding errors of sums of a few hundred terms


# Columns of the tables.
COLUMNS = {
    "size": {
        "container_radius",
        "amplitude_ratio",
        "packing_fraction",
        "discs",
        "largest",
        "binder_error",
        "susceptibility",
    },
    "torque": {
        "discs",
        "wall_normal",
        "transfer_loose",
        "transfer_loose_error",
        "unaccounted_share",
    },
    "fields": {
        "x",
        "y",
        "packing",
        "packing_error",
        "torque",
        "torque_error",
        "relation",
        "relation_error",
    },
    "closure": {
        "container_radius",
        "discs",
        "relation",
        "packing_low",
        "coefficient",
        "coefficient_error",
        "explained",
    },
    "gears": {"mu", "discs", "correlation_by_impulse", "resident_error", "wall_sticking"},
    "cause": {
        "body",
        "spins",
        "contacts",
        "discs",
        "slip",
        "wall_spin",
        "wall_sticking",
        "stay",
        "load",
        "load_error",
    },
    "turns": {"case", "kind", "x", "y", "x2", "y2", "value"},
    "material_inertia": {
        "inertia",
        "restitution",
        "crossing",
        "crossing_error",
        "lowest",
        "highest",
    },
}


# The suite slow makes this one: its runs take a third of the time of all chapters, and
# cause_test.py makes runs like them.
SLOW = {"cause"}
CHAPTERS = [
    figure
    for figure in catalogue.named(["chapters"])
    if (figure.name in SLOW) == ("SWIRL_SLOW_CHAPTERS" in os.environ)
]


@pytest.mark.parametrize("figure", CHAPTERS, ids=lambda figure: figure.name)
def test_every_chapter_makes_its_table_and_drawing_from_runs(figure, tmp_path):
    """With the shortest runs that each allows: their means are worthless, but no step from points
    to the drawing fails."""
    settings = study.Settings(quick=True, events=1, out=str(tmp_path), threads=1)
    points = figure.points(settings)
    study.make(points, settings)
    table = figure.write(points, settings)[1][0]
    with open(table, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert rows and COLUMNS.get(figure.name, set()) <= set(rows[0])
    figure.draw(table)
    for kind in ("png", "pdf"):
        assert (tmp_path / f"figure_{figure.name}.{kind}").stat().st_size > 5000


def curve(function, numbers, error=1e-6):
    return [(n, function(n), error) for n in numbers]


def test_the_zero_of_a_parabola_is_exact():
    zero, falls = last_zero(curve(lambda n: 1 - (n / 30) ** 2, (20, 26, 35, 44)))
    assert falls and zero.discs == pytest.approx(30, abs=EXACT) and zero.interpolation < EXACT


def test_the_zero_of_a_cubic_is_within_its_interpolation_error():
    zero = zero_of_curve(
        curve(lambda n: -(((n - 30) / 10) ** 3) - 0.1 * (n - 30), (18, 26, 36, 46)), 1
    )
    # The two parabolas bound the zero, more closely than the two points alone do.
    assert abs(zero.discs - 30) <= zero.interpolation < 10 / math.sqrt(12)


def test_two_points_leave_the_uniform_error_of_their_distance():
    zero = zero_of_curve(curve(lambda n: 30 - n, (28, 34)), 0)
    assert (zero.discs, zero.interpolation) == pytest.approx((30, 6 / math.sqrt(12)), abs=EXACT)


def test_n_c_contains_the_distance_of_the_points():
    """Part of the way from 26 to 32 is not part of the way from 26 to 27."""
    for step in (1, 3, 6):
        found, error = crossing_of_curve(curve(lambda n: 28.5 - n, range(8, 48, step)))
        # Straight lines are exact, and both points of a line have the error 10⁻⁶.
        assert found == pytest.approx(28.5, abs=EXACT) and error < 1e-5
    # Two points of a coarse curve tell little: N_c has the error of their distance.
    assert crossing_of_curve(curve(lambda n: 28.5 - n, (26, 32))) == pytest.approx(
        (28.5, 6 / math.sqrt(12)), abs=1e-6
    )
    assert crossing_of_curve(curve(lambda n: n - 28.5, range(8, 48))) is None  # to rotation
    assert crossing_of_curve([]) is None


def test_a_curve_without_a_certain_sign_has_no_zero():
    assert last_zero(curve(lambda n: 30 - n, (28, 34), error=10)) == (None, False)
    assert last_zero([]) == (None, False)


def test_the_jackknife_of_a_mean_is_its_standard_error():
    values = np.random.default_rng(1).normal(size=12)
    assert jackknife(12, lambda k: values[k].mean()) == pytest.approx(
        (values.mean(), values.std(ddof=1) / math.sqrt(12)), abs=EXACT
    )
    assert all(map(math.isnan, jackknife(3, lambda k: 1.0)))


def seeds_with(noise, **more):
    """Six seeds of a stress with η = 2 that is turned by 10° against the strain rate; its columns
    have independent errors."""
    random = np.random.default_rng(7)
    xx, xy = random.normal(size=(2, 400))
    even, odd = np.array([xx, xy]), np.array([-xy, xx])
    stress = 4 * (even + math.tan(math.radians(20)) * odd)  # √(mT) = 1
    seeds = []
    for _ in range(6):

        def noisy(column):
            return column + noise * random.normal(size=400)

        zero = np.zeros(400)
        seeds.append(
            {
                "x": zero,
                "y": zero,
                "packing": np.full(400, 0.5),
                "temperature": np.ones(400),
                "strain_xx": noisy(xx),
                "strain_xy": noisy(xy),
                "kinetic_xx": noisy(stress[0]),
                "kinetic_yy": noisy(-stress[0]),
                "kinetic_xy": noisy(stress[1]),
                "collisional_xx": zero,
                "collisional_yy": zero,
                "collisional_xy": zero,
                "collisional_yx": zero,
                **more,
            }
        )
    return seeds


def coefficients(seeds):
    return [
        fit_relation(seeds, relation, 0.4, 0.6, 1).coefficient
        for relation in (RELATIONS[1], RELATIONS[4])
    ]


def test_viscosity_and_angle_of_the_stress_are_separated():
    (eta, _), (angle, _) = coefficients(seeds_with(0))
    # The even part alone is not biased, because e and e* are orthogonal at every point.
    assert (eta, angle) == pytest.approx((2, 10), abs=EXACT)
    fit = fit_relation(seeds_with(0), RELATIONS[4], 0.4, 0.6, 1)
    assert fit.explained[0] == pytest.approx(1, abs=EXACT) and fit.points == 400


def test_noise_does_not_bias_the_coefficients():
    # Ordinary least squares would give η = 2/(1 + 0.5²) = 1.6.
    for (found, error), exact, largest in zip(coefficients(seeds_with(0.5)), (2, 10), (0.1, 2)):
        assert abs(found - exact) < 4 * error and error < largest


def test_points_outside_the_range_or_with_a_missing_value_are_omitted():
    seeds = seeds_with(0)
    seeds[3]["strain_xx"][:10] = math.nan
    seeds[0]["packing"][10:20] = 3  # a mean of 0.92
    assert fit_relation(seeds, RELATIONS[1], 0.4, 0.6, 1).points == 380
    assert fit_relation(seeds, RELATIONS[1], 0.7, 0.8, 1).points == 0
    assert fit_relation([], Relation("", "", "", (), None), 0, 1, 1).points == 0


def test_a_smooth_gas_cools_by_its_collisions_and_its_wall():
    haff = cooling.CASES[0]
    rate = (1 - 0.9**2) / 2
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
    # T = 1/(1 + 1/2) when T = T_s; after 30 collisions what remains of the difference is below
    # e^{-10}.
    assert (translation, spins) == pytest.approx((2 / 3, 2 / 3), abs=1e-4)


def test_the_path_of_a_disc_of_a_rolling_cluster_is_recognised():
    times = 2 * np.pi * np.arange(240)[:, None] / 60
    paths = 3 * np.exp(1j * times) + np.array([1, 2j, 4]) * np.exp(-0.1j * times)
    rotation, distance = fit_hypotrochoids(paths)
    # ϖ is on the grid of the search; the distance is the root of a difference of squares, so of √ε.
    assert rotation == pytest.approx(-0.1, abs=EXACT) and distance < 1e-6
    assert fit_hypotrochoids(paths + 0.5 * np.exp(0.7j * times**2))[1] > 0.3


def test_the_density_in_rings_counts_every_particle_once():
    distance = np.sqrt(np.random.default_rng(1).uniform(0, 9, size=(50, 40)))
    found = densities(distance)
    rings = np.arange(len(found) + 1) / 5
    assert np.sum(found * np.pi * np.diff(rings**2)) == pytest.approx(40, abs=1e-9)


def test_a_power_law_is_recovered_and_two_sizes_have_none():
    sizes = (8.6, 12, 17.2, 24)
    exponent, error, factor, chi_square, count = power_law(
        [(R, 3 * R**1.5, 0.01 * R**1.5) for R in sizes]
    )
    assert (
        (exponent, factor, count) == pytest.approx((1.5, 3, 4), abs=EXACT)
        and chi_square < EXACT
        and error < 0.01
    )
    assert math.isnan(power_law([(R, R, 0.1) for R in sizes[:2]])[0])
    # Points without a positive finite value or error are omitted.
    omitted = power_law([(1, 1, 0.1), (2, 2, 0.1), (3, -1, 0.1), (4, 1, 0), (5, math.nan, 0.1)])
    assert omitted[4] == 2 and math.isnan(omitted[0]) and math.isnan(omitted[1])


def test_the_error_of_a_power_law_grows_with_the_scatter():
    # Equal relative errors e at ln x = −1, 0, 1: the error of the slope is e/√2.
    points = [(math.exp(x), math.exp(2 * x), 0.02 * math.exp(2 * x)) for x in (-1, 0, 1)]
    assert power_law(points)[1] == pytest.approx(0.02 / math.sqrt(2), abs=EXACT)
    # Weighted residuals of 0.2/0.01: the errors alone would give an error below 0.01.
    _, error, _, chi_square, _ = power_law(
        [(1, 1, 0.01), (2, 1.5, 0.01), (4, 1, 0.01), (8, 1.5, 0.01)]
    )
    assert chi_square > 100 and error > 0.1


GROWS, ENDED, UNKNOWN = (
    (1.0, 0.1),
    (0.1, 0.1),
    (1.0, 5.0),
)  # exponents; the error of the last is no evidence
NONE = (math.nan, math.nan)


@pytest.mark.parametrize(
    "all_sizes, largest, binder, verdict",
    [
        ((GROWS, GROWS), (GROWS, GROWS), 0.0, "critical"),
        ((ENDED, ENDED), (ENDED, ENDED), 0.0, "smooth"),
        ((GROWS, ENDED), (ENDED, ENDED), 0.0, "smooth"),  # the growth has ended
        ((GROWS, GROWS), (ENDED, GROWS), 0.0, "undecided"),
        ((GROWS, ENDED), (GROWS, ENDED), 0.0, "undecided"),
        ((ENDED, ENDED), (UNKNOWN, ENDED), 0.0, "undecided"),
        ((NONE, ENDED), (NONE, ENDED), 0.0, "undecided"),
        ((ENDED, ENDED), (ENDED, ENDED), 0.6, "first order"),
        ((NONE, NONE), (NONE, NONE), 0.0, "too few sizes to tell"),
    ],
)
def test_missing_evidence_leaves_the_verdict_open(all_sizes, largest, binder, verdict):
    laws, last = (dict(zip(("slope", "correlation"), pair)) for pair in (all_sizes, largest))
    assert verdict_on(laws, last, (binder, 0.05)) == verdict


def change_of(radius, slope, **more):
    return {
        "container_radius": radius,
        "amplitude_ratio": 0.4,
        "direction": "counterrotation",
        "kind": "wall",
        "packing_fraction": 0.47,
        "slope": -slope,
        "slope_error": 0.02 * slope,
        "correlation": 1.3,
        "correlation_error": 0.05,
        "susceptibility": radius,
        "susceptibility_error": 0.1 * radius,
        "binder": 0.0,
        "binder_error": 0.05,
        "granular": 0.06,
        "granular_error": 0.001,
        **more,
    }


@pytest.mark.parametrize(
    "slopes, verdict",
    [
        # A correlation time that is flat rules out that a slope which grows without an end is
        # smooth.
        (lambda R: R / 20, "undecided"),
        (lambda R: 1.06 * (1 - math.exp(-((R / 12) ** 2))), "smooth"),
        # Between R = 24 and 60 this still grows by a third, but no power law has its bend.
        (lambda R: 1.3 * math.tanh(R / 26), "smooth"),
    ],
)
def test_a_slope_that_saturates_is_told_from_one_that_grows(slopes, verdict):
    rows = scaling_tables([change_of(R, slopes(R)) for R in (8.6, 12.0, 24.0, 34.4, 60.0)])[0][
        "_scaling"
    ]
    assert {row["verdict"] for row in rows} == {verdict}


def test_a_limit_is_recovered_and_rough_slopes_show_no_saturation():
    def rows(error):
        changes = [
            change_of(R, s := 1.3 * math.tanh(R / 26), slope_error=error * s)
            for R in (8.6, 12.0, 24.0, 34.4, 60.0)
        ]
        return scaling_tables(changes)[0]["_scaling"]

    assert rows(0.02)[0]["limit"] == pytest.approx(
        1.3, rel=2e-3
    )  # neighbouring b of the search differ by so much
    assert {row["verdict"] for row in rows(0.3)} == {"undecided"}


def test_the_occupied_wall_names_a_change_before_its_elongation():
    names = {
        kind_of({"direction": direction, "elongation": elongation, "occupied": occupied})
        for direction, elongation, occupied in (
            ("counterrotation", 1.25, 0.19),
            ("counterrotation", 1.1, 0.1),
        )
    }
    assert names == {"wall"}
    assert (
        kind_of({"direction": "counterrotation", "elongation": 1.4, "occupied": 0.05})
        == "elongated"
    )


def test_sound_and_viscosity_of_a_dilute_gas_are_those_of_kinetic_theory():
    # c² = 2T (two degrees of freedom), η = η_0; at φ = 10⁻⁶ density corrections are 10⁻⁵ and less.
    assert sound_speed(1e-6, 3.0) == pytest.approx(math.sqrt(6), rel=1e-5)
    assert kinematic_viscosity(1e-6, 3.0) * 1e-6 / math.pi == pytest.approx(
        1.022 * math.sqrt(3 / math.pi) / 4, rel=1e-5
    )
    (row,) = scaling_tables([change_of(34.4, 1.0, kind="free")])[0]["_times"]
    # Sound crosses the dish in the same number of periods in every dish, viscosity takes longer in
    # proportion to R.
    (half,) = scaling_tables([change_of(17.2, 1.0, kind="free")])[0]["_times"]
    assert (row["sound"], row["viscosity"]) == pytest.approx(
        (half["sound"], 2 * half["viscosity"]), rel=1e-9
    )


def point_of(rates, disagree):
    runs = [{"rotation": {"rigid_by_time": {"mean": mean, "error": 0.01}}} for mean in rates]
    return types.SimpleNamespace(runs=runs, result={"seeds": {"disagree": disagree}})


def test_seeds_in_two_states_are_counted_where_they_disagree():
    assert shares_of_the_states(point_of([0.1, -0.1, -0.2, 0.01], True)) == {
        "share_rotating": 0.25,
        "share_counterrotating": 0.5,
    }
    assert set(shares_of_the_states(point_of([0.1, -0.1], False)).values()) == {None}
    # Spins above and below the threshold of −5: two runs leave the gas after 40 periods, one stays
    # in it.
    runs = [
        {"spin": spins, "rotation": [0.1 if spin > -5 else 0.9 for spin in spins]}
        for spins in ([0, 0, -9], [0, 0, -9], [0, 0, 0])
    ]
    rows = lifetimes.table([types.SimpleNamespace(runs=runs)], None)[0][""]
    assert [row["share_ended"] for row in rows] == [1 / 3, 2 / 3]
    assert [(row["lifetime"], row["rotation"]) for row in rows] == [
        (70, pytest.approx(0.1)),
        (40 / 3, 0.9),
    ]


def test_a_change_between_long_lived_states_has_the_share_of_the_seeds_in_each():
    known = {"mean": 0.1, "error": 0.01}
    measured = {
        family: dict.fromkeys(names.split(), known)
        for family, names in (
            ("contact_network", "wall largest"),
            ("centre", "elongation distance"),
            ("slip", "cluster_perimeter"),
            ("fluctuations", "susceptibility correlation binder"),
            ("temperature", "granular"),
        )
    }
    points = [
        point_of([rate, rate, -0.1, rate], disagree)
        for rate, disagree in ((0.1, True), (-0.2, False))
    ]
    for point, mean, discs in zip(points, (0.05, -0.2), (300, 320)):
        point.cells = {"container_radius": 34.4, "amplitude_ratio": 0.22, "discs": discs}
        point.result |= {
            "measured": measured,
            "rotation": {"rigid_by_time": {"mean": mean, "error": 0.01}},
        }
    ((row,),) = direction_changes(points).values()
    # Where the seeds agree, the mean is that of a state, and there are no shares.
    assert (row["share_rotating_before"], row["share_rotating_after"]) == (0.75, None)


def test_the_sign_changes_of_a_curve_are_listed_in_order():
    points = [
        types.SimpleNamespace(
            cells={"discs": n},
            result={"rotation": {rate: {"mean": mean, "error": 0.01} for rate in curves.RATES}},
        )
        for n, mean in ((8, 0.0), (20, 0.2), (28, -0.1), (36, 0.3), (44, 0.0))
    ]
    found = curves.sign_change_rows(curves.Curve("", points), {})
    assert [(row["before"], row["after"], row["direction"]) for row in found] == [
        (8, 8, "undetermined"),
        (20, 28, "counterrotation"),
        (28, 36, "rotation"),
        (44, 44, "undetermined"),
    ]


# --- Gears and slip -----------------------------------------------------------------------------

NUMBERS = np.arange(24.0, 49.0)


def curves_of_gears(lost_at, risen_at, strength=0.4):
    """Eight seeds of the gear order and the slip parameter, whose halves are at these N."""
    noise = 0.002 * np.random.default_rng(3).normal(size=(2, 8, len(NUMBERS)))
    order = strength / (1 + np.exp((NUMBERS - lost_at) / 2))
    slip = 0.5 + 0.5 / (1 + np.exp(-(NUMBERS - risen_at) / 2))
    return order + noise[0], slip + noise[1]


@pytest.mark.parametrize(
    "lost_at, risen_at, words",
    [
        (40, 34, "the loss follows"),
        (33, 39, "the loss precedes"),
        (36, 36, "neither comes first for certain"),
    ],
)
def test_a_loss_of_gear_order_is_timed_against_the_slip(lost_at, risen_at, words):
    rows = gear_order.timing(NUMBERS, *curves_of_gears(lost_at, risen_at))
    assert gear_order.verdict(rows) == words
    # The ends of the range cut the tails of the logistic curves, whose width is 2.
    assert rows[1]["lag"] == pytest.approx(lost_at - risen_at, abs=0.5)


def test_without_gear_order_nothing_is_lost():
    for strength in (0.0, 0.05):  # the weak order of discs is below the least order of gears
        rows = gear_order.timing(NUMBERS, *curves_of_gears(36, 36, strength))
        assert gear_order.verdict(rows) == "no gear order to lose" and math.isnan(rows[1]["loss"])
    order, slip = curves_of_gears(90, 36)  # order that stays to the last N has no loss, either
    assert gear_order.verdict(gear_order.timing(NUMBERS, order, slip)) == "no gear order to lose"


def test_contacts_have_the_amplitude_and_the_friction_of_their_setting():
    measured = {
        "frustration": {
            name: {"mean": 0.1, "error": 0.01}
            for name in ("chain_correlation", "triangle_correlation", "triangles")
        },
        "slip": {"resident": {"mean": 0.9, "error": 0.01}},
    }

    def row(parameters, cells):
        return gear_order.row_of(
            types.SimpleNamespace(
                tasks=[types.SimpleNamespace(parameters=parameters)],
                runs=[{}] * 8,
                cells=cells | {"discs": 24},
                result={"measured": measured},
            )
        )

    wide = row({"amplitude": 0.44 * 8.6}, {"mu": 1})
    half = row({"preset": "experiment-half"}, {"setting": "half", "mu_disc": 0.33})
    columns = ("particles", "mu", "amplitude_ratio", "seeds", "triangles", "slip")
    assert [wide[name] for name in columns] == ["discs", 1, 0.44, 8, 0.1, 0.9]
    # The radius of the path is 5.75 mm, that of the dish 25.5 mm.
    assert [half[name] for name in columns[:3]] == ["spheres", 0.33, round(5.75 / 25.5, 4)]


# --- The axis of a cluster ----------------------------------------------------------------------

SMALL = dict(
    discs=30,
    container_radius=8.6,
    period=11.866071,
    ramp="amplitude=1.892:1.892@0..4",
    warmup=4,
    periods=12,
    seed=3,
)


def test_torques_and_moments_of_an_axis_are_those_of_all_events():
    found = cluster_axis.axis_of(SMALL)
    torques = swirl.run(measure=["torque", "centre"], **SMALL).measured
    # The centre of mass is interpolated between 30 samples of a period, and a step begins before
    # the first whole period.
    for name in cluster_axis.TORQUES:
        assert found[name] == pytest.approx(torques["torque"][name].mean, rel=0.02)
    assert found["elongation"] == pytest.approx(torques["centre"]["elongation"].mean, rel=0.01)
    # The moments of both axes add up to the change of Σ x·u: nothing, within the fluctuation at
    # both ends.
    parts = {
        part: found[f"{part}_along"] + found[f"{part}_across"]
        for part in ("flow", "collisions", "wall")
    }
    assert (
        parts["flow"] > 0
        and parts["collisions"] > 0
        and abs(sum(parts.values())) < 0.05 * abs(parts["wall"])
    )


# --- Two states ---------------------------------------------------------------------------------


def runs_of_two_states(lifetimes, count, windows=60):
    """Windows of runs that jump between two states at random, half of them prepared in each."""
    random, runs = np.random.default_rng(5), []
    for k in range(count):
        state, values = k % 2, []
        for _ in range(windows):
            values.append((1.06, 1.35)[state] + 0.03 * random.normal())
            state ^= random.uniform() < coexistence.WINDOW / lifetimes[state]
        runs.append(
            {"rotation": [(-0.04, 0.04)[value > 1.2] for value in values], "elongation": values}
        )
    return runs


def test_lifetimes_of_cut_runs_are_recovered():
    runs = runs_of_two_states((200, 600), 64)
    states = [coexistence.states_of(run["elongation"]) for run in runs]
    for k, exact in enumerate((200, 600)):
        value, error = lifetimes.lifetime_of(*lifetimes.visits(states, k, coexistence.WINDOW))
        assert abs(value - exact) < 4 * error and error < 0.25 * value
    # Most runs are shorter than the longer lifetime: the mean over completed visits alone would be
    # too short by half.
    assert lifetimes.lifetime_of(300, 0)[0] == 100


def test_a_noisy_state_is_not_left_at_the_middle():
    assert list(coexistence.states_of([1.2, 1.06, 1.2, 1.1, 1.2, 1.3, 1.2, 1.24])) == [
        -1,
        0,
        0,
        0,
        0,
        1,
        1,
        1,
    ]
    assert lifetimes.visits([np.array([-1, 0, 0, 1, 1])], 0, coexistence.WINDOW) == (
        2 * coexistence.WINDOW,
        1,
    )


def test_equal_lifetimes_follow_from_exits_at_two_amplitudes():
    def row(ratio, round_, elongated):
        """Exits as expected from ln τ_round = 6 − 400 x and ln τ_elongated = 6 + 200 x with x = A/R
        − 0.21."""
        lives = math.exp(6 - 400 * (ratio - 0.21)), math.exp(6 + 200 * (ratio - 0.21))
        return {
            "amplitude_ratio": ratio,
            "periods_round": round_,
            "exits_round": round_ / lives[0],
            "periods_elongated": elongated,
            "exits_elongated": elongated / lives[1],
        }

    rows = [row(0.204, 4000, 2000), row(0.21, 3000, 3000), row(0.216, 2000, 4000)]
    (found, error), (lifetime, _) = coexistence.equal_lifetimes(rows)
    assert (found, lifetime) == pytest.approx((0.21, math.exp(6)), rel=1e-9) and 0 < error < 0.002
    # A state that is never left at one of two amplitudes still counts by its time, but one with
    # exits at a single amplitude has no slope.
    never = [rows[0], rows[1] | {"exits_round": 0}, rows[2]]
    assert coexistence.equal_lifetimes(never)[0][0] > found
    assert coexistence.equal_lifetimes([rows[0] | {"exits_round": 0}, rows[1]]) is None


def test_equal_lifetimes_are_not_extrapolated():
    """ln τ_round = 20 − 400 x and ln τ_elongated = 20 + 200 x with x = A/R − 0.21, measured only
    where they are short."""

    def row(ratio, state, lifetime):
        return {
            "amplitude_ratio": ratio,
            "periods_round": 0,
            "exits_round": 0,
            "periods_elongated": 0,
            "exits_elongated": 0,
            f"periods_{state}": 1000,
            f"exits_{state}": 1000 / lifetime,
        }

    rows = [row(ratio, "round", math.exp(20 - 400 * (ratio - 0.21))) for ratio in (0.25, 0.2525)]
    rows += [
        row(ratio, "elongated", math.exp(20 + 200 * (ratio - 0.21))) for ratio in (0.125, 0.13)
    ]
    assert coexistence.equal_lifetimes(rows) is None


def test_a_table_whose_runs_all_failed_is_empty(tmp_path):
    curves.write_table(str(tmp_path / "empty.csv"), [])
    assert (tmp_path / "empty.csv").read_text() == "\n"
