"""The table of the pages on the cause of the reversal (docs/explanation/why.md,
docs/results/stopping_the_spins.md): runs at N = 8, 24 and 48 give its rows, for discs and spheres.
tests/layers/numbers_test.py compares the pages with the table."""

import csv
import math
import os

import pytest

import swirl

from paper import crossing_law
from paper.chapters import cause

SOURCE = os.environ["SWIRL_SOURCE"]


def rows(ending=""):
    with open(
        os.path.join(SOURCE, "docs", "data", f"figure_cause{ending}.csv"),
        encoding="utf-8",
        newline="",
    ) as table:
        return list(csv.DictReader(table))


COLUMNS = {
    "slip": ("slip", "cluster"),
    "wall_spin": ("frustration", "wall_spin"),
    "wall_sticking": ("frustration", "wall_sticking"),
    "disc_sticking": ("frustration", "disc_sticking"),
    "stay": ("residence", "length"),
}
CASES = [
    (body, spins, contacts, discs)
    for body in cause.BODIES
    for spins, contacts in (("free", "all contacts"), ("stopped", "none between particles"))
    for discs in (8, 24, 48)
]


def near(found, error, row, column):
    """Within five standard errors. The errors of short runs are uncertain, so that they count
    twice."""
    apart = abs(found - float(row[column]))
    assert apart <= 5 * math.hypot(2 * error, float(row[f"{column}_error"])) + 1e-12, (
        column,
        found,
        error,
        row[column],
    )


@pytest.mark.parametrize("body, spins, contacts, discs", CASES)
def test_runs_give_the_numbers_of_the_table(body, spins, contacts, discs):
    """Seeds that the table does not have."""
    case = dict(body=body, spins=spins, contacts=contacts, discs=str(discs))
    (row,) = [row for row in rows() if all(row[name] == value for name, value in case.items())]
    given = cause.given(body, spins, contacts, discs)
    run = swirl.run(
        **given,
        periods=160 if body == "discs" else 80,
        warmup=30,
        seed=101,
        measure="slip,frustration,residence",
    )
    near(run.rotation.mean_by_time.mean, run.rotation.mean_by_time.error, row, "mean_by_time")
    for column, (measurement, name) in COLUMNS.items():
        estimate = run.measured[measurement][name]
        near(estimate.mean, estimate.error, row, column)
    if row["load"]:
        load = cause.loads({**given, "warmup": 30, "periods": 60, "seed": 102})["load"]
        near(load, 0.1 * load, row, "load")


@pytest.mark.parametrize("body", cause.BODIES)
def test_spins_that_are_stopped_decide_the_direction(body):
    """The causal sentence, from the table: without friction between particles only those that
    cannot spin reverse, and without friction at the wall they do not."""
    here = [row for row in rows() if row["body"] == body]

    def rotation(spins, contacts):
        return {
            int(row["discs"]): float(row["mean_by_time"]) / float(row["mean_by_time_error"])
            for row in here
            if (row["spins"], row["contacts"]) == (spins, contacts)
        }

    assert min(rotation("free", "none between particles").values()) > 5
    assert rotation("stopped", "none between particles")[48] < -5
    # Spheres have a floor, too: without friction at the wall, that between them is enough at N =
    # 48.
    assert (
        min(rotation("stopped", "none at the wall" if body == "discs" else "none at all").values())
        > 5
    )
    if body == "spheres":
        assert rotation("free", "none at the wall")[48] < -5


def test_two_sets_of_seeds_agree_with_each_other_and_with_earlier_measurements():
    """Of 50 differences in units of their errors, the largest is below 3.5 with a probability of
    0.98."""
    apart = [
        float(row[name])
        for row in rows("_repeated")
        for name in ("first_from_before", "second_from_before", "first_from_second")
        if row[name]
    ]
    assert len(apart) > 45
    assert max(map(abs, apart)) < 3.5
    assert 0.6 < math.sqrt(sum(x * x for x in apart) / len(apart)) < 1.4


def test_at_a_smooth_wall_the_floor_reverses_spheres_that_cannot_roll():
    found = {
        (float(row["floor_friction"]), float(row["vertical_disc"])): row for row in rows("_floor")
    }
    assert float(found[0.33, 1]["mean_by_time"]) < -0.05
    for without in (
        (0, 1),
        (0.33, 0),
    ):  # the floor; the friction between spheres that hinders rolling
        assert float(found[without]["mean_by_time"]) > 0.98
    turns = found[0.33, 1]
    assert float(turns["torque_at_wall"]) < -3 < -10 * float(turns["torque_at_wall_error"])
    assert abs(float(turns["torque_inside"])) < 0.3 * abs(float(turns["torque_at_wall"]))


def test_the_law_for_n_c_is_tested_on_30_crossings_and_fails():
    tested = rows("_law")
    assert len(tested) >= 30
    for row in tested:
        expected = crossing_law.law(
            *(float(row[name]) for name in ("mu", "inertia", "cannot_spin", "container_radius"))
        )
        assert math.isclose(expected, float(row["law"]), rel_tol=1e-12)
    assert max(abs(float(row["ratio"]) - 1) for row in tested) > 1


def test_the_preprint_has_at_most_2000_words():
    with open(
        os.path.join(SOURCE, "docs", "results", "stopping_the_spins.md"), encoding="utf-8"
    ) as page:
        assert len(page.read().split()) <= 2000
