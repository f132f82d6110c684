"""The rules by which every claim is judged, in one place.

A number that was measured is a Value: a mean, its standard error (between seeds and within them,
measure/several_runs.hpp), and the points of the study that it rests on. A claim asks whether a Value
lies above or below a bound, and three standard errors decide:

    holds           it does, by more than three errors
    does not hold   it does not, by more than three errors
    undecided       neither: more seeds would tell, and `swirl paper` spends them on the points of
                    the Values concerned, until it is decided or the budget of seeds is spent
    holds in part   of a claim that says several things, some hold and others do not; of a claim
                    that says one thing this is never the verdict

What the paper leaves open ("roughly", "slightly", "nearly") is a bound with a name, in claims.py.
Where what is measured depends on a choice of ours (how thick is the layer at the wall?), a claim is
judged for each of the choices, and decided only if they agree.
"""

import math

HOLDS, IN_PART, FAILS = "holds", "holds in part", "does not hold"
UNDECIDED = "undecided"
UNTESTABLE, MISSING = "not testable by simulation", "not made"

# Standard errors that make something certain. There is no other such number.
Z = 3.0


class Value:
    """A mean, its standard error, and the names of the points that more seeds could be spent on."""

    def __init__(self, mean, error=0.0, points=()):
        self.mean, self.error, self.points = mean, error, frozenset(points)

    @property
    def known(self):
        return self.mean == self.mean and self.error == self.error

    def __sub__(self, other):
        other = as_value(other)
        return Value(self.mean - other.mean, math.hypot(self.error, other.error),
                     self.points | other.points)

    def __mul__(self, factor):
        return Value(self.mean * factor, self.error * abs(factor), self.points)

    def __abs__(self):
        return Value(abs(self.mean), self.error, self.points)

    def __neg__(self):
        return self * -1


def as_value(number):
    return number if isinstance(number, Value) else Value(number)


def mean_of(values, weights=None):
    """The mean of independent values."""
    values = list(values)
    weights = list(weights) if weights is not None else [1.0] * len(values)
    total = sum(weights)
    return Value(sum(w * v.mean for w, v in zip(weights, values)) / total,
                 math.sqrt(sum((w * v.error) ** 2 for w, v in zip(weights, values))) / total,
                 frozenset().union(*(v.points for v in values)))


# Student's t: 95 % lie within ± this, for 1, 2, … degrees of freedom, and for very many; between,
# linear in 1/freedom.
STUDENT = (12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228)
STUDENT_OF_MANY = 1.960


def student(freedom):
    """What errors from few numbers are multiplied with, as in src/measure/several_runs.hpp."""
    if freedom <= len(STUDENT):
        t = STUDENT[freedom - 1]
    else:
        t = STUDENT_OF_MANY + (STUDENT[-1] - STUDENT_OF_MANY) * len(STUDENT) / freedom
    return t / STUDENT_OF_MANY


def scattered(numbers, points=(), least=0.0):
    """The mean of numbers that have no errors of their own: the error is that of their scatter, or
    of the least that it can be. Of a single one nothing is known."""
    numbers = [x for x in numbers if math.isfinite(x)]
    n = len(numbers)
    if n < 2:
        return Value(numbers[0] if n else math.nan, math.nan, points)
    mean = sum(numbers) / n
    scatter = math.sqrt(sum((x - mean) ** 2 for x in numbers) / (n - 1)) * student(n - 1)
    return Value(mean, max(scatter, least) / math.sqrt(n), points)


def trend(numbers, points=()):
    """How much a straight line through numbers at equal distances rises from the first to the last,
    in units of their mean. The error is that of the scatter about the line."""
    n = len(numbers)
    if n < LEAST_POINTS or not all(math.isfinite(x) for x in numbers):
        return Value(math.nan, math.nan, points)
    mean, middle = sum(numbers) / n, (n - 1) / 2
    squares = sum((k - middle) ** 2 for k in range(n))
    slope = sum((k - middle) * x for k, x in enumerate(numbers)) / squares
    about = sum((x - mean - slope * (k - middle)) ** 2 for k, x in enumerate(numbers))
    error = math.sqrt(about / (n - 2) / squares) * student(n - 2)
    return Value(slope, error, points) * ((n - 1) / mean)


class Part:
    """The verdict on one statement, and the points that could decide it if it is undecided."""

    def __init__(self, verdict, points=()):
        self.verdict = verdict
        self.points = frozenset(points) if verdict == UNDECIDED else frozenset()

    def __eq__(self, other):
        return self.verdict == (other.verdict if isinstance(other, Part) else other)

    def __repr__(self):
        return self.verdict


def above(value, bound):
    """Is the value above the bound (a number or another Value)?"""
    gap = as_value(value) - bound
    if not gap.known:
        return Part(UNDECIDED, gap.points)
    if gap.mean > Z * gap.error:
        return Part(HOLDS)
    if gap.error == 0:
        return Part(FAILS)  # what is exact is not above what it equals
    return Part(FAILS) if gap.mean < -Z * gap.error else Part(UNDECIDED, gap.points)


def below(value, bound):
    return above(-as_value(value), -as_value(bound))


def within(value, low, high):
    """Between two bounds. One bound that fails is enough; both must hold."""
    return every([above(value, low), below(value, high)])


def true(flag):
    """Of what is no measurement: it is so, or it is not."""
    return Part(HOLDS if flag else FAILS)


def every(statements):
    """One statement about many places: it must hold in each of them."""
    statements = list(statements)
    if any(s.verdict == FAILS for s in statements):
        return Part(FAILS)
    open_ones = [s for s in statements if s.verdict == UNDECIDED]
    if open_ones or not statements:
        return Part(UNDECIDED, frozenset().union(*(s.points for s in open_ones)))
    return Part(IN_PART if any(s.verdict == IN_PART for s in statements) else HOLDS)


def either(statements):
    """One statement that is true if it holds in any of the places."""
    statements = list(statements)
    if any(s.verdict == HOLDS for s in statements):
        return Part(HOLDS)
    open_ones = [s for s in statements if s.verdict == UNDECIDED]
    if open_ones or not statements:
        return Part(UNDECIDED, frozenset().union(*(s.points for s in open_ones)))
    return Part(IN_PART if any(s.verdict == IN_PART for s in statements) else FAILS)


def agreed(statements):
    """One statement, judged once for each choice that could have been made of what is measured. If
    for one choice it holds and for another it does not, or in part, that is for certain, and no
    seeds would decide it."""
    statements = list(statements)
    verdicts = {s.verdict for s in statements}
    if len(verdicts - {UNDECIDED}) > 1:
        return Part(UNDECIDED)
    if UNDECIDED in verdicts or not statements:
        return Part(UNDECIDED, frozenset().union(*(s.points for s in statements)))
    return Part(verdicts.pop())


def parts(*statements):
    """A claim that says several things. Only here can something hold in part."""
    verdicts = [s.verdict for s in statements]
    if IN_PART in verdicts or (HOLDS in verdicts and FAILS in verdicts):
        return Part(IN_PART)
    open_ones = [s for s in statements if s.verdict == UNDECIDED]
    if open_ones:
        return Part(UNDECIDED, frozenset().union(*(s.points for s in open_ones)))
    return Part(HOLDS if HOLDS in verdicts else FAILS)


# A step back of this share of the whole rise is none.
STEP_BACK = 0.1
# Of fewer points one cannot say that they rise all the way.
LEAST_POINTS = 3


def step_back(values):
    """Of a curve that should rise: (k, k + 1) of the neighbours between which it falls most, if it
    certainly falls there by more than STEP_BACK of the whole; None if it does so nowhere."""
    known = [k for k, v in enumerate(values) if v.mean == v.mean]
    if not known:
        return None
    rise = values[known[-1]] - values[known[0]]
    steps = [(values[b] - values[a], (a, b)) for a, b in zip(known, known[1:])]
    back = [(step.mean, pair) for step, pair in steps
            if below(step, -STEP_BACK * abs(rise.mean)).verdict == HOLDS]
    return min(back)[1] if back else None


def rises(values):
    """A curve that rises: certainly higher at its end than at its beginning, and with no certain
    fall between neighbours of more than STEP_BACK of the whole."""
    values = [v for v in values if v.mean == v.mean]
    if len(values) < LEAST_POINTS:
        return Part(UNDECIDED, frozenset().union(*(v.points for v in values)))
    overall = above(values[-1] - values[0], 0.0)
    if overall.verdict != HOLDS:
        return overall
    return Part(FAILS if step_back(values) else HOLDS)


def falls(values):
    return rises([-v for v in values])
