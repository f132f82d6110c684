"""N_c against a parameter, from the table of `swirl crossing --csv`, with its errors.

    /usr/bin/python3 paper crossing_table N_c.csv

The parameter along x is the one with the most numbers; each combination of the others is a curve.
An N_c that is known as an interval only is a bar without a symbol. Searches without N_c are named
below the figure.
"""

import sys

import numpy as np
from paper import optional_file, style


def parameters_of(rows):
    names = list(rows[0])
    if "N_c_lower" not in names or "rate" not in names:
        sys.exit(
            "error: the table has no column 'N_c_lower'.\nhint: `swirl crossing --csv` writes it."
        )
    return [name for name in names[: names.index("rate")] if len({row[name] for row in rows}) > 1]


def along_x(rows, parameters):
    numbers = [name for name in parameters if all(isinstance(row[name], float) for row in rows)]
    return max(numbers, key=lambda name: len({row[name] for row in rows}), default=None)


def draw(axes, rows, places, **look):
    """Points with standard errors, and intervals where N_c itself is unknown."""
    known = [k for k, row in enumerate(rows) if np.isfinite(row["N_c"])]
    brackets = [
        k
        for k, row in enumerate(rows)
        if not np.isfinite(row["N_c"]) and np.isfinite(row["N_c_lower"])
    ]
    axes.errorbar(
        [places[k] for k in known],
        [rows[k]["N_c"] for k in known],
        [rows[k]["N_c_error"] for k in known],
        **look,
    )
    axes.vlines(
        [places[k] for k in brackets],
        [rows[k]["N_c_lower"] for k in brackets],
        [rows[k]["N_c_upper"] for k in brackets],
        color=look["color"],
        linewidth=0.7,
    )


def main():
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print(f"usage: /usr/bin/python3 {sys.argv[0]} N_c.csv", file=sys.stderr)
        sys.exit(0 if sys.argv[1:] in (["-h"], ["--help"]) else 2)
    table = sys.argv[1]
    if not optional_file.exists(table):
        sys.exit(
            f"error: the table '{table}' does not exist.\nhint: `swirl crossing --csv` writes it."
        )
    rows = style.read(table)
    parameters = parameters_of(rows)
    if not parameters:
        sys.exit(
            "error: the table has one search only, so nothing is drawn.\n"
            "hint: give a list, such as --mu 0.2:0.2:1."
        )
    x = along_x(rows, parameters)
    words = sorted({str(row[parameters[0]]) for row in rows}) if x is None else []
    others = [name for name in parameters if name != (x or parameters[0])]
    drawing, axes = style.figure()
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[name] for name in others), []).append(row)
    for k, (values, here) in enumerate(groups.items()):
        if x:
            here = sorted(here, key=lambda row: row[x])
        places = [row[x] if x else words.index(str(row[parameters[0]])) for row in here]
        label = ", ".join(
            f"{name} = {value:g}" if isinstance(value, float) else f"{name} = {value}"
            for name, value in zip(others, values)
        )
        draw(axes, here, places, **style.look_of(k % len(style.CYCLE)), label=label or None)
    without = [
        ", ".join(
            f"{name} {row[name]:g}" if isinstance(row[name], float) else f"{name} {row[name]}"
            for name in parameters
        )
        + f" {row['verdict']}"
        for row in rows
        if not np.isfinite(row["N_c_lower"])
    ]
    if without:
        style.note(drawing, "no N_c: " + "; ".join(without))
    if words:
        axes.set_xticks(range(len(words)), words)
    names = {"mu": r"friction coefficient $\mu$", "container_radius": "container radius $R$"}
    name = x or parameters[0]
    axes.set(xlabel=names.get(name, name.replace("_", " ")), ylabel="$N_c$")
    if others:
        style.legend(axes)
    style.save(drawing, table)
