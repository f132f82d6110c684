"""The rules by which every claim is judged, in one place.

A number that was measured is a Value: a mean, its standard error (between seeds and within them,
statistics/replicates.hpp), the degrees of freedom of that error (seeds − 1), and the points of the
study that it rests on. A claim asks whether a Value lies above or below a bound. The probability of
three standard deviations decides, which Student's t turns into a number of errors (threshold()):

    holds           it does, by more than that many errors
    does not hold   it does not, by more than that many errors
    undecided       neither: more seeds would tell, and `swirl paper` spends them on the points of
                    the Values concerned, until it is decided or the budget of seeds is spent
    holds in part   of a claim that says several things, some hold and others do not; of a claim
                    that says one thing this is never the verdict

What the paper leaves open ("roughly", "slightly", "nearly") is a bound with a name, in claims.py.
Where what is measured depends on a choice of ours (how thick is the layer at the wall?), a claim is
judged for each of the choices, and decided only if they agree.

Seeds are added until a claim is decided, so a claim is asked several times. An error in a table
already has Student's factor for 95 % in it (replicates.hpp). The threshold multiplies this error,
so it is stricter than an exact test of one look. That pays for the repeated looks: with 8, 16 and 32
seeds a value that lies exactly on its bound is decided in at most 0.6 % of all cases, whatever the
seeds differ by (tests/cli/claims_test.py, ErrorRateOfDecided; docs/paper.md has the table).
"""

import math

HOLDS, IN_PART, FAILS = "holds", "holds in part", "does not hold"
UNDECIDED = "undecided"
UNTESTABLE, MISSING = "not testable by simulation", "not made"

# Standard deviations that make something certain. There is no other such number.
Z = 3.0
# Student's t: the share of three standard deviations, 99.73 %, lies within ± this, for 1, 2, …
# degrees of freedom.
CERTAIN = (235.80, 19.207, 9.2187, 6.6201, 5.5070, 4.9040, 4.5299, 4.2766, 4.0942, 3.9569)


def threshold(freedom):
    """How many standard errors make something certain, if the error has this many degrees of
    freedom. Between whole numbers it is linear in 1/freedom. One seed has none: never."""
    if not freedom >= 1:
        return math.inf
    if freedom >= len(CERTAIN):  # Abramowitz and Stegun, 26.7.5
        return (Z + (Z ** 3 + Z) / (4 * freedom) +
                (5 * Z ** 5 + 16 * Z ** 3 + 3 * Z) / (96 * freedom ** 2) +
                (3 * Z ** 7 + 19 * Z ** 5 + 17 * Z ** 3 - 15 * Z) / (384 * freedom ** 3))
    k = int(freedom)
    share = (1 / k - 1 / freedom) / (1 / k - 1 / (k + 1))
    return CERTAIN[k - 1] + share * (CERTAIN[k] - CERTAIN[k - 1])


class Value:
    """A mean, its standard error, the degrees of freedom of the error (infinite: it is exact), and
    the names of the points that more seeds could be spent on."""

    def __init__(self, mean, error=0.0, points=(), freedom=math.inf):
        self.mean, self.error, self.points = mean, error, frozenset(points)
        self.freedom = freedom

    @property
    def known(self):
        return self.mean == self.mean and self.error == self.error

    @property
    def margin(self):
        """By how much the mean must differ from a bound to be certain."""
        return threshold(self.freedom) * self.error if self.error else 0.0

    def __sub__(self, other):
        other = as_value(other)
        return Value(self.mean - other.mean, math.hypot(self.error, other.error),
                     self.points | other.points, joint_freedom([self, other], [1, 1]))

    def __mul__(self, factor):
        return Value(self.mean * factor, self.error * abs(factor), self.points, self.freedom)

    def __abs__(self):
        return Value(abs(self.mean), self.error, self.points, self.freedom)

    def __neg__(self):
        return self * -1


def as_value(number):
    return number if isinstance(number, Value) else Value(number)


def measured(row, name, error=None):
    """A number of a row of a table, with its error, its point, and its degrees of freedom from the
    column `averaged_runs`. A table without this column has one run only, or errors of another kind;
    these are taken as they are."""
    return Value(row[name], row[error or name + "_error"],
                 [row["point"]] if isinstance(row.get("point"), str) else (),
                 row["averaged_runs"] - 1 if "averaged_runs" in row else math.inf)


def joint_freedom(values, weights):
    """Degrees of freedom of the error of Σ weight × value: Welch and Satterthwaite."""
    squares = [(w * v.error) ** 2 for w, v in zip(weights, values)]
    if any(s and not v.freedom >= 1 for s, v in zip(squares, values)):
        return 0.0
    uncertain = sum(s ** 2 / v.freedom for s, v in zip(squares, values) if s)
    return sum(squares) ** 2 / uncertain if uncertain else math.inf


def mean_of(values, weights=None):
    """The mean of independent values."""
    values = list(values)
    weights = list(weights) if weights is not None else [1.0] * len(values)
    total = sum(weights)
    return Value(sum(w * v.mean for w, v in zip(weights, values)) / total,
                 math.sqrt(sum((w * v.error) ** 2 for w, v in zip(weights, values))) / total,
                 frozenset().union(*(v.points for v in values)), joint_freedom(values, weights))


def scattered(numbers, points=(), least=0.0):
    """The mean of numbers that have no errors of their own: the error is that of their scatter, or
    of the least that it can be. Of a single one nothing is known."""
    numbers = [x for x in numbers if math.isfinite(x)]
    n = len(numbers)
    if n < 2:
        return Value(numbers[0] if n else math.nan, math.nan, points)
    mean = sum(numbers) / n
    scatter = math.sqrt(sum((x - mean) ** 2 for x in numbers) / (n - 1))
    return Value(mean, max(scatter, least) / math.sqrt(n), points,
                 n - 1 if scatter > least else math.inf)


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
    error = math.sqrt(about / (n - 2) / squares)
    return Value(slope, error, points, n - 2) * ((n - 1) / mean)


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
    if gap.mean > gap.margin:
        return Part(HOLDS)
    if gap.error == 0:
        return Part(FAILS)  # what is exact is not above what it equals
    return Part(FAILS) if gap.mean < -gap.margin else Part(UNDECIDED, gap.points)


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


# A curve that rises may fall from any of its points to any later one by this share of its whole rise.
# A tenth is what the symbols of the paper's Figure 4 hide. All pairs are compared, not neighbours alone:
# between the neighbours of a finer grid any curve falls by less.
REVERSAL = 0.1
# Of fewer points one cannot say that they rise all the way.
LEAST_POINTS = 3


def largest_reversal(values):
    """Of a curve that should rise: (i, j), i < j, between which it falls most; None if it never falls."""
    known = [k for k, v in enumerate(values) if v.known]
    falls_by = [(values[i].mean - values[j].mean, (i, j))
                for n, i in enumerate(known) for j in known[n + 1:]]
    most = max(falls_by, default=(0.0, None))
    return most[1] if most[0] > 0 else None


def rises(values, least=0.0):
    """A curve that rises: from its beginning to its end by more than `least`, the size that matters, and
    between no two points does it fall by more than REVERSAL of that rise."""
    values = [v for v in values if v.mean == v.mean]
    if len(values) < LEAST_POINTS:
        return Part(UNDECIDED, frozenset().union(*(v.points for v in values)))
    rise = values[-1] - values[0]
    overall = above(rise, least)
    if overall.verdict != HOLDS:
        return overall
    return every([below(a - b, REVERSAL * rise.mean)
                  for k, a in enumerate(values) for b in values[k + 1:]])


def falls(values, least=0.0):
    return rises([-v for v in values], least)
