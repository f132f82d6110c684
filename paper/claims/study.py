"""The tables of one call of `swirl paper`."""

import math
import os

from paper import tables
from paper.paper_parameters import LAST_N
from paper.verdicts import UNDECIDED, Judgement, Value, fact

from paper.claims.thresholds import NEAR_CROSSING
from paper.claims.wording import number


class Study:
    """The tables in one folder."""

    def __init__(self, path):
        self.path, self._tables = path, {}

    def table(self, name):
        if name not in self._tables:
            self._tables[name] = tables.read(os.path.join(self.path, f"figure_{name}.csv"))
        return self._tables[name]

    def curve(self, name, last=LAST_N, **selected):
        """Rows in order of N, up to `last`; failed points are left out."""
        rows = [
            row
            for row in tables.select(self.table(name), **selected)
            if row.get("steady_state") != "failed" and row["discs"] <= last
        ]
        return sorted(rows, key=lambda row: row["discs"])

    def crossing(self, name, curve):
        """The crossing of a curve of a figure, with the points whose seeds improve it."""
        row = [row for row in self.table(f"{name}_crossings") if is_named(row, "curve", curve)][0]
        near = self.rows_near(name, curve, row)
        runs = [r["averaged_runs"] for r in near if "averaged_runs" in r]
        return Crossing(
            row, {r["point"] for r in near if "point" in r}, min(runs) - 1 if runs else math.inf
        )

    def rows_near(self, name, curve, crossing):
        """Rows of this curve at the numbers of discs that decide its crossing, or its lowest
        point."""
        try:
            rows = self.table(name)
        except FileNotFoundError:
            return []
        at = (
            crossing_value(crossing).mean
            if crossing["verdict"] == "crosses"
            else crossing["lowest_discs"]
        )
        return [
            row
            for row in rows
            if any(key in row and is_named(row, key, curve) for key in ("setting", "curve"))
            and abs(row["discs"] - at) <= NEAR_CROSSING
        ]


def is_named(row, key, curve):
    """True if the row belongs to this curve. A table reader returns a numeric name as a number."""
    return curve == (f"{row[key]:g}" if isinstance(row[key], float) else row[key])


def crossing_value(row, points=(), freedom=math.inf):
    """N_c of a row; `freedom`: degrees of freedom of the points' errors. For a bracket, the value
    is its middle with the standard deviation of a uniform distribution, which is exact."""
    at, error = row["crossing"], row["crossing_error"]
    if at != at and "lower" in row:
        lower, upper = row["lower"], row["upper"]
        return Value((lower + upper) / 2, (upper - lower) / math.sqrt(12), points)
    return Value(at, error, points, freedom)


def crossing_words(row):
    if row["crossing"] != row["crossing"] and "lower" in row:
        return f"between {row['lower']:g} and {row['upper']:g}"
    return number(Value(row["crossing"], row["crossing_error"]))


def crossing_sentence(words):
    """N_c, for a sentence: "N_c = 38.2 ± 0.1" or "N_c between 36 and 40"."""
    return f"N_c {words}" if words.startswith("between") else f"N_c = {words}"


class Crossing:
    def __init__(self, row, points, freedom=math.inf):
        self.verdict, self.points = row["verdict"], points
        self.at, self.words = crossing_value(row, points, freedom), crossing_words(row)
        # Of a known N_c, an interval of 95 %: claims need no more, and N_c itself stands in
        # docs/results/paper.md alone.
        self.interval = (
            (row.get("lower", math.nan), row.get("upper", math.nan))
            if row["crossing"] == row["crossing"]
            else None
        )
        self.lowest = Value(row["lowest"], row["lowest_error"], points, freedom)
        self.lowest_discs = row["lowest_discs"]

    @property
    def crosses(self):
        if self.verdict == "undecided":
            return Judgement(UNDECIDED, self.points)
        return fact(self.verdict == "crosses")

    @property
    def text(self):
        if self.verdict == "crosses":
            if self.interval and self.interval[0] == self.interval[0]:
                return f"N_c between {self.interval[0]:.1f} and {self.interval[1]:.1f}"
            return crossing_sentence(self.words)
        return (
            f"no crossing ({self.verdict}; lowest ϖ/Ω = {number(self.lowest)} at N = "
            f"{self.lowest_discs:.0f})"
        )
