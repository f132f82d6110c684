"""How much the predictions for the experiment depend on what the paper does not state.

    ./swirl python paper sensitivity OUT

Each scenario changes one assumption of `--preset experiment`, and fits one friction coefficient of
all contacts again, so that smooth spheres change their direction at N = 36. All other numbers are
then predictions: the slip parameter of the pinned spheres, the rotation, the correlation of the
spins of touching spheres in no triangle (−1: gears), and how often the direction changes between N
= 24 and 48. What varies little from scenario to scenario is a result of the model; what varies as
much as it deviates from the paper is not.

OUT receives the runs and sensitivity.csv; the table for docs/results/spheres.md is printed. Another
call with the same OUT makes only the missing runs. Takes about 25 minutes on two cores.
"""

import csv
import io
import math
import os
import re
import sys

import swirl

from paper import atomic_file
from paper.coarse_zero import changes_of_sign, crossing_of_curve
from paper.curves import with_error
from paper.paper_parameters import SMOOTH_CHANGE_N

R_MM = 3.0
LENGTH = {"periods": 110, "warmup": 30}
FITTED_AT = (30, 33, 36, 39, 42)  # N of the fit, two seeds
PREDICTED_AT = (24, 25, 28, 32, 36, 40, 44, 46, 48)  # four seeds
CLOSE = 0.3  # an N_c that is as near to 36 is fitted
PER_E_FOLD = -11.0  # dN_c/d ln μ, for the first two steps of the fit
STEPS = 5
QUANTITIES = {
    "s(25)": (25, "slip.pinned_region"),
    "s(48)": (48, "slip.pinned_region"),
    "hull(25)": (25, "hull"),
    "hull(48)": (48, "hull"),
    "rotation(46)": (46, "mean_by_time"),
    "rotation(48)": (48, "mean_by_time"),
    "gears(25)": (25, "frustration.chain_correlation"),
    "gears(48)": (48, "frustration.chain_correlation"),
}
# Name, first μ, changed parameters, factor of the floor's friction coefficient relative to that of
# the contacts.
SCENARIOS = (
    ("as published: e = 0.9, A = 11.5 mm", 0.33, {}, 1.0),
    ("e = 0.6", 0.24, {"restitution": 0.6}, 1.0),
    ("e = 0.75", 0.29, {"restitution": 0.75}, 1.0),
    ("e = 1", 0.4, {"restitution": 1.0}, 1.0),
    ("floor friction × 0.5", 0.46, {}, 0.5),
    ("floor friction × 2", 0.25, {}, 2.0),
    ("A = 9.5 mm", 0.32, {"amplitude": 9.5 / R_MM}, 1.0),
    ("A = 10.5 mm", 0.33, {"amplitude": 10.5 / R_MM}, 1.0),
    ("A = 12.5 mm", 0.33, {"amplitude": 12.5 / R_MM}, 1.0),
    ("contact duration × 0.1", 0.33, {"contact_duration": 1e-4}, 1.0),
    ("contact duration × 10", 0.33, {"contact_duration": 1e-2}, 1.0),
    ("rolling resistance 0.01", 0.3, {"rolling_resistance": 0.01}, 1.0),
    ("radii ± 5 %", 0.33, {"sizes": "normal:1:0.05"}, 1.0),
    ("A = 5.75 mm, e = 0.6", 0.15, {"amplitude": 5.75 / R_MM, "restitution": 0.6}, 1.0),
)


def rows_at(out, name, mu, changes, floor, numbers, seeds):
    """The rows of a sweep over N at this friction coefficient, as dictionaries."""
    words = re.sub(r"[^a-z0-9.]+", "_", name.lower().replace("×", "times"))
    folder = os.path.join(out, f"{words}_mu{mu:g}_{len(numbers)}N")
    table = swirl.sweep(
        folder,
        preset="experiment",
        mu=mu,
        floor_friction=round(mu * floor, 4),
        discs=list(numbers),
        replicates=seeds,
        measure=["slip", "frustration"],
        **LENGTH,
        **changes,
    )
    rows = table.to_dict("records")
    for row in rows:
        # The perimeter of the hull of the centres, without the radius that P_cluster adds.
        share = 1 - 2 * math.pi / row["slip.cluster_perimeter"]
        row |= {
            "hull": row["slip.pinned_region"] * share,
            "hull_error": row["slip.pinned_region_error"] * share,
        }
    return rows


def curve_of(rows):
    return [(row["discs"], row["mean_by_time"], row["mean_by_time_error"]) for row in rows]


def fit(out, name, mu, changes, floor):
    """(μ, (N_c, its error)) with N_c nearest to 36; None if no μ that was tried has a change of
    direction."""
    tried = []
    for _ in range(STEPS):
        found = crossing_of_curve(curve_of(rows_at(out, name, mu, changes, floor, FITTED_AT, 2)))
        if found is None:
            break
        tried.append((mu, found))
        if abs(found[0] - SMOOTH_CHANGE_N) < CLOSE:
            break
        (before, (at_before, _)), (now, (at_now, _)) = tried[0], tried[-1]
        slope = (at_now - at_before) / math.log(now / before) if now != before else PER_E_FOLD
        step = (SMOOTH_CHANGE_N - found[0]) / (slope if slope < -2 else PER_E_FOLD)
        mu = round(mu * math.exp(max(-0.5, min(0.5, step))), 4)
    return min(tried, key=lambda one: abs(one[1][0] - SMOOTH_CHANGE_N), default=None)


def scenario(out, name, first, changes, floor):
    """A row: the fit, the predictions, and the changes of direction from N = 24 to 48."""
    fitted = fit(out, name, first, changes, floor)
    if not fitted:
        return {"scenario": name}
    mu, (discs, error) = fitted
    rows = rows_at(out, name, mu, changes, floor, PREDICTED_AT, 4)
    at = {row["discs"]: row for row in rows}
    found = {
        "scenario": name,
        "mu": mu,
        "N_c": discs,
        "N_c_error": error,
        "changes": len(changes_of_sign(curve_of(rows))),
    }
    for words, (number, column) in QUANTITIES.items():
        found |= {words: at[number][column], f"{words}_error": at[number][f"{column}_error"]}
    return found


def report(rows):
    def cell(row, name):
        return with_error(row[name], row[f"{name}_error"]) if name in row else "none"

    print(
        "| changed | μ | N_c | changes, 24 to 48 | s(25) | s(48) | ϖ/Ω, N = 46 | 48 | gears, 25 | "
        "48 |\n|---|---|---|---|---|---|---|---|---|---|"
    )
    for row in rows:
        print(
            f"| {row['scenario']} | {row.get('mu', 'none')} | {cell(row, 'N_c')} | "
            f"{row.get('changes', '')} | "
            + " | ".join(
                cell(row, name)
                for name in (
                    "s(25)",
                    "s(48)",
                    "rotation(46)",
                    "rotation(48)",
                    "gears(25)",
                    "gears(48)",
                )
            )
            + " |"
        )


def main():
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print(__doc__, file=sys.stderr)
        sys.exit(0 if sys.argv[1:] in (["-h"], ["--help"]) else 2)
    out = sys.argv[1]
    rows = [scenario(out, *one) for one in SCENARIOS]
    text = io.StringIO()
    writer = csv.DictWriter(text, max(rows, key=len), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    atomic_file.write_or_exit(os.path.join(out, "sensitivity.csv"), text.getvalue())
    report(rows)
