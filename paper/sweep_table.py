"""A quantity of a sweep against one of its parameters, a curve for each combination of the others.

    /usr/bin/python3 paper sweep_table study/table.csv [QUANTITY] [--points my_points.csv]

`swirl collect study --plot` writes the table and draws it. Points have the columns discs, rate and
error. The parameter along x is the one with the most values. In a chain, rising and falling values
are separate curves.
"""

import sys

from paper import optional_file, style, tables

MAX_CURVES = 24


def parameters_of(rows):
    """The columns of parameters come first; the next is the number of replicates."""
    names = list(rows[0])
    if "replicates" not in names:
        sys.exit(
            "error: the table is not of a sweep: it has no column 'replicates'.\n"
            "hint: `swirl collect` writes it."
        )
    return names[: names.index("replicates")]


def along_x(rows, parameters):
    values = {
        name: {row[name] for row in rows}
        for name in parameters
        if all(isinstance(row[name], float) for row in rows)
    }
    if not values:
        sys.exit("error: the sweep has no parameter of numbers, so nothing is drawn.")
    return max(values, key=lambda name: len(values[name]))


def text_of(name, value):
    if name == "direction":
        return "rising" if value == "up" else "falling"
    return f"{name} = {value:g}" if isinstance(value, float) else f"{name} = {value}"


def curves(rows, others):
    """The rows of each combination of the other parameters, in order of the table."""
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[name] for name in others), []).append(row)
    return groups


def label_of(quantity):
    rates = {
        "mean_by_time": "by time",
        "mean_by_event": "by event",
        "rigid_by_time": "rigid body, by time",
        "rigid_by_event": "rigid body, by event",
    }
    if quantity in rates:
        return rf"rotation $\varpi/\Omega$, {rates[quantity]}"
    return quantity.replace("_", " ")


def arguments():
    """The table, the quantity, and the file of the points or None."""
    words = sys.argv[1:]
    points = None
    if "--points" in words[:-1]:
        at = words.index("--points")
        points = words[at + 1]
        del words[at : at + 2]
    if len(words) not in (1, 2) or words[0] in ("-h", "--help"):
        print(
            f"usage: /usr/bin/python3 {sys.argv[0]} table.csv [QUANTITY] [--points FILE.csv]",
            file=sys.stderr,
        )
        sys.exit(0 if words in (["-h"], ["--help"]) else 2)
    return words[0], words[1] if len(words) == 2 else "mean_by_time", points


def draw_points(axes, file):
    """Points that were measured at a real dish, with their standard errors."""
    rows = style.read(file)
    discs, rates, errors = (style.column(rows, name) for name in ("discs", "rate", "error"))
    axes.errorbar(
        discs,
        rates,
        yerr=errors,
        fmt="*",
        color="black",
        markersize=9,
        capsize=3,
        zorder=5,
        label="my points",
    )


def main():
    table, quantity, points_file = arguments()
    if not optional_file.exists(table):
        sys.exit(f"error: the table '{table}' does not exist.\nhint: `swirl collect` writes it.")
    rows = style.read(table)
    parameters = parameters_of(rows)
    quantities = [
        name
        for name in rows[0]
        if name not in parameters
        and not name.endswith("_error")
        and name not in ("steady_state", "state_hash")
    ]
    if quantity not in quantities:
        sys.exit(
            f"error: the table has no column '{quantity}'.\nhint: it has {', '.join(quantities)}."
        )
    x = along_x(rows, parameters)
    others = [name for name in parameters if len({row[name] for row in rows}) > 1 and name != x]
    groups = curves(rows, others)
    if len(groups) > MAX_CURVES:
        sys.exit(
            f"error: the sweep would have {len(groups)} curves, but at most {MAX_CURVES} can be "
            "distinguished.\nhint: draw a part of the table."
        )
    drawing, axes = style.figure()
    for k, (values, points) in enumerate(groups.items()):
        points = sorted(points, key=lambda row: row[x])
        label = ", ".join(text_of(name, value) for name, value in zip(others, values))
        look = {
            "color": style.CYCLE[k % len(style.CYCLE)],
            "marker": style.MARKERS[k % len(style.MARKERS)],
            "label": label or None,
        }
        if f"{quantity}_error" in rows[0]:
            style.curve(axes, points, x, quantity, **look)
        else:
            axes.plot(style.column(points, x), style.column(points, quantity), **look)
    if quantity in tables.RATES:
        axes.axhline(0, color="0.6", linewidth=0.5, zorder=0)
    names = {"discs": "number of discs $N$", "mu": r"friction coefficient $\mu$"}
    axes.set(xlabel=names.get(x, x.replace("_", " ")), ylabel=label_of(quantity))
    if points_file and x == "discs":
        draw_points(axes, points_file)
    if others or points_file:
        style.legend(axes)
    style.save(drawing, table)
