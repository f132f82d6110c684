"""Combines the runs of a point, which differ only in their seeds, into one result of the same form.

Every average becomes the mean over the runs, with the error within and between them
(src/swirl/statistics/replicates.hpp, which also decides which runs are too short to count, and
their weights). Angles are averaged as directions. Counts of visits add up; lengths become means.
Failed runs are not averaged.

"seeds" has the number of runs, and how many of them were averaged, steady, drifting, jumping,
switching, too short for the test, too short to average, and failed; also the scatter of ϖ by event
in units of the runs' own errors.
"""

import math

import numpy as np
from paper.engine import swirl

RATES = ("mean_by_event", "mean_by_time", "rigid_by_event", "rigid_by_time")
COUNTS = (
    "runs",
    "averaged",
    "steady",
    "drifting",
    "jumping",
    "switching",
    "too_short",
    "too_short_to_average",
    "failed",
)


def at(result, *path):
    """result["a"]["b"]…, or None if it does not exist, as in the result of a failed run."""
    for name in path:
        if not isinstance(result, dict) or name not in result:
            return None
        result = result[name]
    return result


def number(value):
    """A number; NaN for anything else."""
    return (
        float(value)
        if isinstance(value, (int, float)) and not isinstance(value, bool)
        else math.nan
    )


def means(runs, names):
    """{name: mean over the runs, name_error: its error} of quantities of single runs."""
    return {
        f"{name}{end}": value
        for name in names
        for end, value in zip(("", "_error"), swirl.mean([number(run[name]) for run in runs]))
    }


def failed(result):
    return "failed" in result


def steadiness(result):
    """ "steady", "drifting", "jumping", "switching", "too short to tell", or "failed"."""
    return at(result, "steady_state", "verdict") or "failed"


def min_periods():
    """The length of a run that is averaged, if any run is that long; from the program."""
    return swirl.min_averaged_periods


def too_short_to_average(run):
    """True if a run ended before its warm-up, or soon after it."""
    return (
        number(at(run, "warmup", "periods")) == 0 and at(run, "config", "warmup") != 0
    ) or not number(at(run, "rotation", "mean_by_event", "blocks")) >= min_periods()


def is_average(node):
    return isinstance(node, dict) and "mean" in node and "error" in node


def average(nodes, periods, direction=False):
    """The mean of averages over runs that count as these lengths, or the same if there are none."""
    columns = [
        [number(node.get(name)) for node in nodes]
        for name in ("mean", "error", "effective_samples")
    ]
    mean, error, effective, scatter, disagree = swirl.mean(
        columns[0],
        columns[1],
        periods=periods,
        effective_samples=np.nan_to_num(columns[2]),
        directions=direction,
    )
    found = {
        "mean": mean,
        "error": error,
        "effective_samples": effective,
        "scatter": scatter,
        "disagree": disagree,
    }
    for name in nodes[0]:  # further numbers have no errors: counts add up, others are averaged
        if name not in found and name != "blocks":
            values = [number(node.get(name)) for node in nodes]
            found[name] = sum(values) if name == "count" else sum(values) / len(values)
    return found


def mean_cell(cells):
    """The common value of all runs, bitwise, or their mean."""
    cells = [cell for cell in cells if not math.isnan(cell)]
    return (
        math.nan
        if not cells
        else cells[0]
        if cells.count(cells[0]) == len(cells)
        else sum(cells) / len(cells)
    )


def table(nodes, periods, path):
    """A table of a measurement: {column: values}. Errors are in the columns NAME_error."""
    found = {}
    for name in nodes[0]:
        if name in found:
            continue  # an error, added with its mean
        cells = np.array([[number(cell) for cell in node[name]] for node in nodes]).T
        if f"{name}_error" in nodes[0]:
            errors = np.array(
                [[number(cell) for cell in node[f"{name}_error"]] for node in nodes]
            ).T
            column = swirl.mean(
                cells, errors, periods=periods, directions=swirl.is_direction(f"{path}.{name}")
            )
            found[name], found[f"{name}_error"] = column.mean.tolist(), column.error.tolist()
        else:
            found[name] = [
                sum(row) if name == "visits" else mean_cell(list(row)) for row in cells.tolist()
            ]
    return found


def measured(nodes, periods, path):
    """Combines averages, tables and numbers, at any depth. `path`: the name in the registry of
    quantities, as in "residence.sensitivity"."""
    first = nodes[0]
    if is_average(first):
        return average(nodes, periods, swirl.is_direction(path))
    if not isinstance(first, dict):
        return mean_cell([number(node) for node in nodes])
    column = next(iter(first.values()), None)
    if isinstance(column, list) and column and not isinstance(column[0], (list, dict)):
        return table(nodes, periods, path)
    return {
        name: measured([node[name] for node in nodes], periods, f"{path}.{name}") for name in first
    }


def common_measurements(runs, periods):
    """{"measured": …} with the measurements of all runs. Points share runs, so some may have more
    than others."""
    made = [run.get("measured", {}) for run in runs]
    names = [name for name in made[0] if all(name in each for each in made)]
    return (
        {
            "measured": {
                name: measured([each[name] for each in made], periods, name) for name in names
            }
        }
        if names
        else {}
    )


def verdict_of(seeds):
    """ "steady" if all runs are, otherwise the worst verdict."""
    for verdict in ("drifting", "jumping", "switching"):
        if seeds[verdict]:
            return verdict
    return "too short to tell" if seeds["too_short"] or not seeds["steady"] else "steady"


def count_seeds(results):
    count = dict.fromkeys(COUNTS, 0)
    for run in results:
        count["runs"] += 1
        if failed(run):
            count["failed"] += 1
        elif too_short_to_average(run):
            count["too_short_to_average"] += 1
            count["too_short"] += 1
        else:
            count["averaged"] += 1
            count[steadiness(run).replace("too short to tell", "too_short")] += 1
    return count


def combined(results):
    """The result of a point. Results that are not those of runs are returned as {"runs": those that
    did not fail}."""
    if not any("rotation" in r and "state_hash" in r for r in results):
        good = [r for r in results if not failed(r)]
        return {"runs": good} if good else results[0]
    seeds = count_seeds(results)
    runs = [r for r in results if number(at(r, "rotation", "mean_by_event", "blocks")) >= 1]
    if not runs:
        reason = next(
            (r["failed"] for r in results if failed(r)),
            "no run has a whole period after its warm-up, so nothing is averaged.",
        )
        return (
            {"failed": reason} if any(map(failed, results)) else {"failed": reason, "seeds": seeds}
        )
    if not all(map(too_short_to_average, runs)):
        runs = [r for r in runs if not too_short_to_average(r)]
    seeds["averaged"] = len(runs)
    periods = [number(r["periods"]) - number(at(r, "warmup", "periods")) for r in runs]

    def mean(*path):
        return sum(number(at(run, *path)) for run in runs) / len(runs)

    rotation = {
        rate: average(
            [run["rotation"][rate] for run in runs], () if rate.endswith("by_event") else periods
        )
        for rate in RATES
    }
    hashes = [run["state_hash"] for run in runs]
    return {
        "config": runs[0]["config"],
        "rotation": rotation,
        "periods": mean("periods"),
        "events": {"total": int(mean("events", "total") + 0.5)},
        "warmup": {"periods": int(mean("warmup", "periods") + 0.5)},
        **common_measurements(runs, periods),
        "seeds": {
            **seeds,
            "scatter": rotation["mean_by_event"]["scatter"],
            "disagree": rotation["mean_by_event"]["disagree"],
        },
        "steady_state": {"verdict": verdict_of(seeds)},
        "state_hash": hashes[0] if len(hashes) == 1 else swirl.checksum("".join(hashes)),
    }
