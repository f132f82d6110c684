"""Tables of points, curves ϖ(N), and where they cross zero. A row is a dictionary, and a table a
list of rows."""

import csv
import io
import math

from paper import atomic_file
from paper.combine import RATES, at, number, steadiness
from paper.engine import swirl

RATE_WORDS = {
    "mean_by_event": "mean over the discs, by event",
    "mean_by_time": "mean over the discs, by time",
    "rigid_by_event": "rigid body, by event",
    "rigid_by_time": "rigid body, by time",
}
CERTAIN = 3  # errors from zero that make a sign certain (src/swirl/statistics/zero_crossing.hpp)


def cell(value):
    """Numbers read back as the same double; unknown values are empty cells."""
    if value is None or isinstance(value, float) and not math.isfinite(value):
        return ""
    if isinstance(value, bool):
        return int(value)
    return repr(float(value)).removesuffix(".0") if isinstance(value, float) else value


def write_table(file, rows, columns=None):
    """Writes rows as CSV. Without rows and columns the table is empty."""
    text = io.StringIO()
    out = csv.writer(text, lineterminator="\n")
    out.writerow(columns or next(iter(rows), []))
    out.writerows([cell(value) for value in row.values()] for row in rows)
    atomic_file.write(file, text.getvalue())


def with_error(average, error=None):
    """ "0.123 ± 0.004" from an object with "mean" and "error", or from two numbers; "n/a" if there
    is none."""
    if isinstance(average, dict) or average is None:
        average, error = number(at(average, "mean")), number(at(average, "error"))
    return swirl.with_error(average, math.nan if error is None else error)


def listed(numbers):
    return ", ".join(f"{n:g}" for n in numbers)


# --- Rows -----------------------------------------------------------------------------------------


def averages(result, path, names):
    """Columns with the means and errors of averages; a quantity without an error gets the error 0.

    `names` are {column: key}, or keys that are also columns."""
    found = {}
    for column in names:
        value = at(
            result, *path, *(names[column].split(".") if isinstance(names, dict) else [column])
        )
        plain = isinstance(value, (int, float))
        found[column] = number(value) if plain else number(at(value, "mean"))
        found[f"{column}_error"] = 0.0 if plain else number(at(value, "error"))
    return found


def measured_cells(result, quantities):
    """Columns for these measured quantities and their errors. A quantity is "slip.cluster"; its
    column is "cluster", or what follows a "=", as in "slip.stays=slip_resident"."""
    names = {}
    for quantity in quantities:
        key, _, column = quantity.partition("=")
        names[column or key.partition(".")[2] or key] = key
    return averages(result, ["measured"], names)


def rotation_cells(result):
    """The columns about the rotation; empty cells for a point whose runs failed."""
    return {
        **averages(result, ["rotation"], RATES),
        "effective_samples": number(at(result, "rotation", "mean_by_event", "effective_samples")),
        "events": at(result, "events", "total"),
        "periods": number(at(result, "periods")),
        "warmup_periods": at(result, "warmup", "periods"),
        "steady_state": steadiness(result),
        "point": result["point"],
        "seeds": at(result, "seeds", "runs"),
        "averaged_runs": at(result, "seeds", "averaged"),
        **{
            f"{name}_runs": at(result, "seeds", name)
            for name in ("steady", "drifting", "jumping", "switching")
        },
        "too_short_to_average": at(result, "seeds", "too_short_to_average"),
        "scatter": number(at(result, "seeds", "scatter")),
        "seeds_disagree": int(at(result, "seeds", "disagree") is True),
        "seed": at(result, "config", "seed"),
        "state_hash": at(result, "state_hash") or "",
    }


def rows_of(points, measured=()):
    """A row for each point: its own cells, measured quantities, the rotation."""
    return [
        {**p.cells, **measured_cells(p.result, measured), **rotation_cells(p.result)}
        for p in points
    ]


# --- Curves ---------------------------------------------------------------------------------------


def rate_of(point, rate):
    return (
        point.cells["discs"],
        number(at(point.result, "rotation", rate, "mean")),
        number(at(point.result, "rotation", rate, "error")),
    )


def lowest_of(curve):
    """The point (N, mean, error) with the lowest mean; None if none has a mean."""
    return min((p for p in curve if math.isfinite(p[1])), key=lambda p: p[1], default=None)


def highest_of(curve):
    return max((p for p in curve if math.isfinite(p[1])), key=lambda p: p[1], default=None)


class Curve:
    """ϖ(N) of some points, by every rate; `rate` is the one that the figure shows."""

    def __init__(self, name, points, rate="mean_by_time"):
        self.name, self.rate = name, rate
        self.by_rate = {each: [rate_of(p, each) for p in points] for each in RATES}
        self.crossings = {
            each: swirl.zero_crossing(*map(list, zip(*curve)))
            if curve
            else swirl.zero_crossing([], [], [])
            for each, curve in self.by_rate.items()
        }

    @property
    def points(self):
        return self.by_rate[self.rate]

    def row(self):
        """Where it crosses zero, and its lowest point."""
        found = self.crossings[self.rate]
        lowest = lowest_of(self.points) or (math.nan,) * 3
        return {
            "curve": self.name,
            "rate": self.rate,
            "verdict": found["verdict"],
            "crossing": found["discs"],
            "crossing_error": found["error"],
            "lower": found["lower"],
            "upper": found["upper"],
            "sign_changes": len(found["changes"]),
            "undetermined": " ".join(f"{n:g}" for n in found["undetermined"]),
            "lowest": lowest[1],
            "lowest_error": lowest[2],
            "lowest_discs": lowest[0],
            **crossing_cells(
                {
                    rate: (c["discs"], c["error"], c["lower"], c["upper"])
                    for rate, c in self.crossings.items()
                }
            ),
        }

    def sentence(self):
        """ "crosses zero at N = 36.4 ± 0.3 (95 %: 35.9 to 37.0; …)", "crosses zero between N = 36
        and 40 (…)", or "always rotates" with the lowest point; then the other rates."""
        return f"{self.sentence_of_rate()}.{self.other_rates()}"

    def sentence_of_rate(self):
        found, words = self.crossings[self.rate], RATE_WORDS[self.rate]
        last, undetermined = (
            found["last"],
            f"its sign is undetermined at N = {listed(found['undetermined'])}",
        )
        if last:
            interval = (
                f"95 %: {last['lower']:.1f} to {last['upper']:.1f}; "
                if math.isfinite(last["discs"])
                else ""
            )
            beyond = found["undetermined_after"]
            return f"crosses zero {last['location']} ({interval}{words})" + (
                f"; its sign is undetermined at N = {listed(beyond)}" if beyond else ""
            )
        counterrotates = found["verdict"] == "always counterrotates"
        nearest = (highest_of if counterrotates else lowest_of)(self.points)
        if not nearest:
            return "has no points"
        verdict = found["verdict"]
        if verdict == "undecided":
            verdict = "whether it crosses zero is undecided, " + (
                undetermined if found["undetermined"] else "no sign is certain"
            )
        return (
            f"{verdict}; {'highest' if counterrotates else 'lowest'} is ϖ/Ω = "
            f"{with_error(*nearest[1:])} at N = {nearest[0]:.0f} ({words})"
        )

    def other_rates(self):
        """N_c by the other rates; nothing if no rate crosses."""
        if not any(c["last"] for c in self.crossings.values()):
            return ""
        others = [
            f"{c['words']} ({RATE_WORDS[rate]})"
            for rate, c in self.crossings.items()
            if rate != self.rate and c["points"]
        ]
        return f" By the other rates: {', '.join(others)}." if others else ""


def crossing_cells(by_rate):
    """N_c, its error and its interval for each rate."""
    return {
        f"crossing_{rate}{part}": value
        for rate, values in by_rate.items()
        for part, value in zip(("", "_error", "_lower", "_upper"), values)
    }


def curves_by(points, column, rate="mean_by_time"):
    """A curve for each value of a column, in the order of the points."""
    values = dict.fromkeys(p.cells[column] for p in points)
    return [Curve(value, [p for p in points if p.cells[column] == value], rate) for value in values]


def curve_tables(points, curves, measured=()):
    """The tables of the points and of the crossings of their curves."""
    return {"": rows_of(points, measured), "_crossings": [curve.row() for curve in curves]}


def at_both_ends(points, what, words, quantity):
    """ "what (words): 0.5 at N = 24, 0.9 at N = 48.": a measured quantity, such as "slip.cluster",
    at the first and last N of a curve."""
    known = [(at(p.result, "measured", *quantity.split(".")), p.cells["discs"]) for p in points]
    values = [
        f"{with_error(value)} at N = {discs}"
        for value, discs in known
        if number(at(value, "mean")) == number(at(value, "mean"))
    ]
    return f"{what} ({words}): {values[0]}, {values[-1]}." if values else f"{what} ({words}): n/a."


# --- Changes of sign ------------------------------------------------------------------------------


def direction_of(change):
    return "counterrotation" if change["to_counterrotation"] else "rotation"


def sign_changes_sentence(curve):
    """All changes of the sign, in the order of N."""
    found = curve.crossings[curve.rate]
    if not found["changes"]:
        return curve.sentence()
    times = len(found["changes"])
    undetermined = (
        f"; it is undetermined at N = {listed(found['undetermined'])}"
        if found["undetermined"]
        else ""
    )
    changes = ", ".join(
        f"to {direction_of(change)} {change['location']}" for change in found["changes"]
    )
    discs, mean, error = lowest_of(curve.points)
    return (
        f"its sign changes {'once' if times == 1 else f'{times} times'}: {changes}{undetermined}; "
        f"lowest is ϖ/Ω = {with_error(mean, error)} at N = {discs:.0f} "
        f"({RATE_WORDS[curve.rate]}).{curve.other_rates()}"
    )


def sign_change_rows(curve, cells):
    """Every change of sign, and every N at which the sign is undetermined, in the order of N."""
    found = curve.crossings[curve.rate]
    rows = [
        (
            c["before"],
            1,
            c["discs"],
            c["error"],
            c["lower"],
            c["upper"],
            c["before"],
            c["after"],
            direction_of(c),
        )
        for c in found["changes"]
    ]
    rows += [(n, 0, None, None, n, n, n, n, "undetermined") for n in found["undetermined"]]
    columns = ("crossing", "crossing_error", "lower", "upper", "before", "after", "direction")
    return [
        {**cells, **dict(zip(columns, row[2:]))} for row in sorted(rows, key=lambda row: row[:2])
    ]
