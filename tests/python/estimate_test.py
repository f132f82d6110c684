"""Values with errors: their text is that of the report, and their arithmetic keeps the errors
right."""

import copy
import json
import math
import pickle
import re

import numpy as np
import pytest

import swirl
from scenes import command, options


@pytest.fixture(scope="module")
def runs():
    """Three independent runs."""
    return [
        swirl.run(discs=24, periods=40, warmup=4, seed=seed, measure="slip") for seed in (1, 2, 3)
    ]


def rate(result):
    return result.rotation.mean_by_time


def test_the_text_is_that_of_the_report(runs):
    scene = {"discs": 24, "periods": 40, "warmup": 4, "seed": 1}
    report = command("run", *options(scene), "--measure", "slip").stdout
    (said,) = re.findall(r"ϖ/Ω = (.*)", report)
    assert str(runs[0].rotation) == f"ϖ/Ω = {said}" == f"ϖ/Ω = {swirl.with_error(*rate(runs[0]))}"
    assert str(rate(runs[0])) == f"{said} Ω"
    assert re.search(
        rf"slip\.cluster +{re.escape(str(runs[0].measured['slip']['cluster']))}\s", report
    )


@pytest.mark.parametrize(
    "mean, error, text",
    [
        (-0.0369, 0.00123, "−0.0369 ± 0.0012"),
        (36.42, 0.3, "36.4 ± 0.3"),
        (0.5, math.nan, "0.5"),
        (math.nan, 1, "n/a"),
        (1234.5, 21.0, "1234 ± 21"),
        (1.0, 0.0, "1"),
        (-2e-10, 1e-10, "−2e-10 ± 1e-10"),
    ],
)
def test_an_error_decides_the_digits(mean, error, text):
    assert swirl.with_error(mean, error) == str(swirl.Estimate(mean, error)) == text


def test_a_format_applies_to_the_mean_and_to_the_error():
    e = swirl.Estimate(-0.03694, 0.00094, unit="Ω")
    assert f"{e:.3f}" == "−0.037 ± 0.001 Ω" and f"{e:.1e}" == "−3.7e-02 ± 9.4e-04 Ω"
    assert f"{e}" == str(e) == "−0.0369 ± 0.0009 Ω" and f"{e:>20}" == "  −0.0369 ± 0.0009 Ω"
    assert f"{swirl.Estimate(0.25):.3f}" == "0.250" and f"{swirl.Estimate(math.nan):.3f}" == "n/a"


def test_an_estimate_is_unpacked_and_complete_in_its_repr(runs):
    mean, error = rate(runs[0])
    found = json.loads(runs[0].to_json())["rotation"]["mean_by_time"]
    assert (mean, error) == (found["mean"], found["error"])
    assert repr(mean) in repr(rate(runs[0])) and repr(error) in repr(runs[0].rotation)
    assert np.array([rate(r) for r in runs], float).tolist() == [float(rate(r)) for r in runs]
    values = swirl.ArrayEstimate(np.ones(3), np.zeros(3), np.ones(3), 4)
    mean, error = values
    assert mean is values.mean and error is values.error


def test_exact_numbers_scale_and_shift(runs):
    e = rate(runs[0])
    for two in (2, 2.0, np.float64(2), np.int32(2)):
        for scaled in (two * e, e * two, e / (1 / two), -e * -two):
            assert (scaled.mean, scaled.error) == (
                2 * e.mean,
                2 * e.error,
            ) and scaled.unit == e.unit
        for shifted in (e + two, two + e, e - -two, two - -e):
            assert (shifted.mean, shifted.error) == (e.mean + 2, e.error)
    assert (-e).error == e.error and +e == e and (3 - e).mean == 3 - e.mean
    assert (-e).effective_samples == e.effective_samples and (e + 1).blocks == e.blocks


def test_independent_estimates_are_added():
    """The error of the difference is that of a normal distribution."""
    a, b = swirl.Estimate(3.0, 0.3, 20, 30, "r"), swirl.Estimate(1.0, 0.4, 10, 40, "r")
    assert ((a - b).mean, (a + b).mean, (a - b).error, (a + b).error) == (2.0, 4.0, 0.5, 0.5)
    assert ((a + b).effective_samples, (a + b).blocks, (a + b).unit) == (10, 30, "r")
    assert math.isnan((a + swirl.Estimate(1.0, unit="r")).error)
    assert sum([a, b], 0).mean == 4.0


def test_seeds_are_independent(runs):
    a, b, c = map(rate, runs)
    third = (a + b + c) / 3
    assert third.mean == pytest.approx(np.mean([a.mean, b.mean, c.mean]))
    assert third.error == pytest.approx(math.sqrt(a.error**2 + b.error**2 + c.error**2) / 3)


def correlated(runs, tmp_path):
    """Pairs of estimates that share events."""
    a, b = rate(runs[0]), rate(runs[1])
    longer = swirl.run(discs=24, periods=50, warmup=6, seed=1, measure=[lambda snapshot: 1.0])
    yield a, a
    yield a, runs[0].rotation.rigid_by_time
    yield a, runs[0].rotation.mean_by_time * 2
    yield a, pickle.loads(pickle.dumps(a))
    yield a, copy.deepcopy(a)
    yield a + b, b
    yield a, rate(longer)
    yield a * 1.0, swirl.Estimate(
        *longer.measured["<lambda>"]["value"],
        unit="Ω",
        _sources=longer.measured["<lambda>"]["value"]._sources,
    )
    swirl.run(
        discs=24, periods=40, warmup=4, seed=1, trajectory=tmp_path / "a.h5", frames_per_period=200
    )
    yield a, rate(swirl.analyse(swirl.Trajectory(tmp_path / "a.h5")))
    frames = swirl.Simulation(discs=24).sample(periods=5)
    yield rate(swirl.analyse(frames)), rate(swirl.analyse(frames, warmup=2))


def test_correlated_errors_are_not_propagated(runs, tmp_path):
    pairs = 0
    for a, b in correlated(runs, tmp_path):
        for combine in (lambda: a + b, lambda: a - b, lambda: b - a):
            with pytest.raises(
                ValueError, match="of the same run, so their errors are correlated.\nhint: "
            ):
                combine()
        pairs += 1
    assert pairs == 10


def test_what_has_no_error_raises(runs):
    a, b = rate(runs[0]), rate(runs[1])
    with pytest.raises(TypeError, match="product of two estimates.*\nhint: .*a.mean \\* b.mean"):
        a * b
    with pytest.raises(TypeError, match="quotient of two estimates.*\nhint: .*a.mean / b.mean"):
        a / b
    with pytest.raises(ValueError, match="in units of Ω, the other in units of 1"):
        a - swirl.Estimate(0.1)
    for wrong in ("1", True, None, 1j, np.arange(3), [1]):
        for combine in (lambda: a + wrong, lambda: wrong - a, lambda: a * wrong, lambda: a / wrong):
            with pytest.raises(TypeError):
                combine()
    with pytest.raises(TypeError):
        1 / a


def test_a_zero_crossing_of_estimates_is_that_of_numbers(runs):
    discs, means, errors = [40, 34, 36, 38], [-0.02, 0.02, 0.01, -0.01], [0.001] * 4
    found = swirl.zero_crossing(discs, means, errors)
    same = swirl.zero_crossing(discs, [swirl.Estimate(*each) for each in zip(means, errors)])
    assert repr(same) == repr(found)  # NaN is not equal to itself
    assert found["verdict"] == "crosses" and (found["lower"], found["upper"]) == (36, 38)
    assert swirl.zero_crossing([24] * 3, [rate(r) for r in runs])["points"] == 3
    assert swirl.zero_crossing([], [])["verdict"] == "undecided"
    with pytest.raises(TypeError, match="errors of their own"):
        swirl.zero_crossing([24], [rate(runs[0])], [0.1])


def test_the_zero_crossing_is_that_of_a_search():
    search = swirl.crossing(min_discs=34, max_discs=42, tolerance=5, events=2000)
    points = search.to_pandas()
    found = swirl.zero_crossing(points["discs"], points["mean"], points["error"])
    assert (found["discs"], found["error"], found["verdict"]) == (
        search.discs,
        search.error,
        search.verdict,
    )
