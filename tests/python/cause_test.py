"""The table of the pages on the cause of the reversal (docs/explanation/why.md, docs/results/stopping_the_spins.md): runs at
N = 8, 24 and 48 give its rows, for discs and spheres. tests/layers/numbers_test.py compares the pages with the table."""

import csv
import math
import os
import sys

import pytest

import swirl
from scenes import SOURCE

sys.path.insert(0, os.path.join(SOURCE, "paper"))
from chapters import cause  # noqa: E402

TABLE = os.path.join(SOURCE, "docs", "data", "figure_cause.csv")


def rows():
    with open(TABLE, encoding="utf-8", newline="") as table:
        return list(csv.DictReader(table))


COLUMNS = {"slip": ("slip", "cluster"), "wall_spin": ("frustration", "wall_spin"),
           "wall_sticking": ("frustration", "wall_sticking"), "disc_sticking": ("frustration", "disc_sticking"),
           "stay": ("residence", "length")}
CASES = [(body, spins, contacts, discs) for body in cause.BODIES
         for spins, contacts in (("free", "all contacts"), ("stopped", "none between particles")) for discs in (8, 24, 48)]


def near(found, error, row, column):
    """Within five standard errors. The errors of short runs are uncertain, so that they count twice."""
    apart = abs(found - float(row[column]))
    assert apart <= 5 * math.hypot(2 * error, float(row[f"{column}_error"])) + 1e-12, (column, found, error, row[column])


@pytest.mark.parametrize("body, spins, contacts, discs", CASES)
def test_runs_give_the_numbers_of_the_table(body, spins, contacts, discs):
    """Seeds that the table does not have."""
    case = dict(body=body, spins=spins, contacts=contacts, discs=str(discs))
    row, = [row for row in rows()
            if all(row[name] == value for name, value in case.items())]
    given = cause.given(body, spins, contacts, discs)
    run = swirl.run(**given, periods=160 if body == "discs" else 80, warmup=30, seed=101, measure="slip,frustration,residence")
    near(run.rotation.mean_by_time.mean, run.rotation.mean_by_time.error, row, "mean_by_time")
    for column, (measurement, name) in COLUMNS.items():
        estimate = run.measured[measurement][name]
        near(estimate.mean, estimate.error, row, column)
    if row["load"]:
        load = cause.loads({**given, "warmup": 30, "periods": 60, "seed": 102})["load"]
        near(load, 0.1 * load, row, "load")


@pytest.mark.parametrize("body", cause.BODIES)
def test_spins_that_are_stopped_decide_the_direction(body):
    """The causal sentence, from the table: without friction between particles only those that cannot spin reverse, and
    without friction at the wall they do not."""
    here = [row for row in rows() if row["body"] == body]

    def rotation(spins, contacts):
        return {int(row["discs"]): float(row["mean_by_time"]) / float(row["mean_by_time_error"]) for row in here
                if (row["spins"], row["contacts"]) == (spins, contacts)}
    assert min(rotation("free", "none between particles").values()) > 5
    assert rotation("stopped", "none between particles")[48] < -5
    # Spheres have a floor, too: without friction at the wall, that between them is enough at N = 48.
    assert min(rotation("stopped", "none at the wall" if body == "discs" else "none at all").values()) > 5
    if body == "spheres":
        assert rotation("free", "none at the wall")[48] < -5
