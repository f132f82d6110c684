"""The rules by which every claim is judged.

A measured number is a Value: a mean, its standard error (src/swirl/statistics/replicates.hpp), the
degrees of freedom of that error (seeds − 1), and the points of the study behind it. A claim asks
whether a Value lies above or below a bound. The decision needs the probability of three standard
deviations; Student's t turns it into a number of standard errors (threshold()):

    holds           it does, by more than that many errors
    does not hold   it does not, by more than that many errors
    undecided       neither. More seeds would decide, and `swirl paper` adds them to the points of
                    these Values until the claim is decided or the budget of seeds is spent
    holds in part   only for a claim with several statements, of which some hold and others do not

Bounds that the paper leaves open ("roughly", "slightly", "nearly") are in claims/thresholds.py.
Some measured quantities depend on a choice of the analysis, for example the thickness of the layer
at the wall. Such a claim is judged for each choice, and decided only if all choices agree.

Seeds are added until a claim is decided, so a claim is tested repeatedly. An error in a table
already contains Student's factor for 95 % (replicates.hpp). The threshold multiplies this error, so
it is stricter than an exact single test. That compensates for the repetition: with 4, 8, 16 and 32
seeds, a value that lies exactly on its bound is decided in at most 0.6 % of all cases, whatever the
scatter between seeds (paper/tests/verdicts_test.py, FalseDecisions).
"""

import math

HOLDS, IN_PART, FAILS = "holds", "holds in part", "does not hold"
UNDECIDED = "undecided"
UNTESTABLE, MISSING = "not testable by simulation", "not made"

# Number of standard deviations that makes a statement certain. All verdicts use it.
Z = 3.0
# Quantiles of Student's t for 1, 2, … degrees of freedom: 99.73 % of the distribution lies within ±
# this value, as within three standard deviations of a normal distribution.
STUDENT_T = (235.80, 19.207, 9.2187, 6.6201, 5.5070, 4.9040, 4.5299, 4.2766, 4.0942, 3.9569)


def threshold(freedom):
    """The number of standard errors that makes a statement certain, for this many degrees of
    freedom. Between integers it is linear in 1/freedom. A single seed has no degree of freedom:
    infinite."""
    if not freedom >= 1:
        return math.inf
    if freedom >= len(STUDENT_T):  # Abramowitz and Stegun, 26.7.5
        return (
            Z
            + (Z**3 + Z) / (4 * freedom)
            + (5 * Z**5 + 16 * Z**3 + 3 * Z) / (96 * freedom**2)
            + (3 * Z**7 + 19 * Z**5 + 17 * Z**3 - 15 * Z) / (384 * freedom**3)
        )
    k = int(freedom)
    share = (1 / k - 1 / freedom) / (1 / k - 1 / (k + 1))
    return STUDENT_T[k - 1] + share * (STUDENT_T[k] - STUDENT_T[k - 1])


class Value:
    """A mean, its standard error, the degrees of freedom of the error (infinite: the error is
    exact), and the names of the points that could get more seeds."""

    def __init__(self, mean, error=0.0, points=(), freedom=math.inf):
        self.mean, self.error, self.points = mean, error, frozenset(points)
        self.freedom = freedom

    @property
    def known(self):
        return self.mean == self.mean and self.error == self.error

    @property
    def margin(self):
        """The least distance between the mean and a bound that decides."""
        return threshold(self.freedom) * self.error if self.error else 0.0

    def __sub__(self, other):
        other = as_value(other)
        return Value(
            self.mean - other.mean,
            math.hypot(self.error, other.error),
            self.points | other.points,
            joint_freedom([self, other], [1, 1]),
        )

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
    column `averaged_runs`. Without this column the error counts as exact."""
    return Value(
        row[name],
        row[error or name + "_error"],
        [row["point"]] if isinstance(row.get("point"), str) else (),
        row["averaged_runs"] - 1 if "averaged_runs" in row else math.inf,
    )


def joint_freedom(values, weights):
    """Degrees of freedom of the error of Σ weight × value, by Welch and Satterthwaite."""
    squares = [(w * v.error) ** 2 for w, v in zip(weights, values)]
    if any(s and not v.freedom >= 1 for s, v in zip(squares, values)):
        return 0.0
    uncertain = sum(s**2 / v.freedom for s, v in zip(squares, values) if s)
    return sum(squares) ** 2 / uncertain if uncertain else math.inf


def mean_of(values, weights=None):
    """The mean of independent values."""
    values = list(values)
    weights = list(weights) if weights is not None else [1.0] * len(values)
    total = sum(weights)
    return Value(
        sum(w * v.mean for w, v in zip(weights, values)) / total,
        math.sqrt(sum((w * v.error) ** 2 for w, v in zip(weights, values))) / total,
        frozenset().union(*(v.points for v in values)),
        joint_freedom(values, weights),
    )


def scattered(numbers, points=(), least=0.0):
    """The mean of numbers without errors. Its error follows from their scatter, which counts as
    `least` at least. The error of a single number is unknown."""
    numbers = [x for x in numbers if math.isfinite(x)]
    n = len(numbers)
    if n < 2:
        return Value(numbers[0] if n else math.nan, math.nan, points)
    mean = sum(numbers) / n
    scatter = math.sqrt(sum((x - mean) ** 2 for x in numbers) / (n - 1))
    return Value(
        mean, max(scatter, least) / math.sqrt(n), points, n - 1 if scatter > least else math.inf
    )


def trend(numbers, points=()):
    """The rise of a straight line, fitted to equally spaced numbers, from the first to the last
    number, in units of their mean. Its error follows from the scatter about the line."""
    n = len(numbers)
    if n < LEAST_POINTS or not all(math.isfinite(x) for x in numbers):
        return Value(math.nan, math.nan, points)
    mean, middle = sum(numbers) / n, (n - 1) / 2
    squares = sum((k - middle) ** 2 for k in range(n))
    slope = sum((k - middle) * x for k, x in enumerate(numbers)) / squares
    about = sum((x - mean - slope * (k - middle)) ** 2 for k, x in enumerate(numbers))
    error = math.sqrt(about / (n - 2) / squares)
    return Value(slope, error, points, n - 2) * ((n - 1) / mean)


class Judgement:
    """The verdict on one statement, and the points that could decide it if it is undecided."""

    def __init__(self, verdict, points=()):
        self.verdict = verdict
        self.points = frozenset(points) if verdict == UNDECIDED else frozenset()

    def __eq__(self, other):
        return self.verdict == (other.verdict if isinstance(other, Judgement) else other)

    def __repr__(self):
        return self.verdict


def above(value, bound):
    """Is the value above the bound (a number or another Value)?"""
    gap = as_value(value) - bound
    if not gap.known:
        return Judgement(UNDECIDED, gap.points)
    if gap.mean > gap.margin:
        return Judgement(HOLDS)
    if gap.error == 0:
        return Judgement(FAILS)  # an exact value is not above an equal bound
    return Judgement(FAILS) if gap.mean < -gap.margin else Judgement(UNDECIDED, gap.points)


def below(value, bound):
    return above(-as_value(value), -as_value(bound))


def within(value, low, high):
    """Above `low` and below `high`: holds if both hold, fails if one fails."""
    return every([above(value, low), below(value, high)])


def fact(flag):
    """The judgement on a fact that is not measured."""
    return Judgement(HOLDS if flag else FAILS)


def undecided(judgements):
    """Undecided, with the points of all `judgements`."""
    return Judgement(UNDECIDED, frozenset().union(*(j.points for j in judgements)))


def every(judgements):
    """One statement about many cases: it must hold in each."""
    return decided_by(FAILS, HOLDS, judgements)


def any_holds(judgements):
    """One statement that is true if it holds in any case."""
    return decided_by(HOLDS, FAILS, judgements)


def decided_by(decisive, otherwise, judgements):
    """One `decisive` verdict decides; `otherwise` needs all cases decided."""
    judgements = list(judgements)
    verdicts = {j.verdict for j in judgements}
    if decisive in verdicts:
        return Judgement(decisive)
    if UNDECIDED in verdicts or not judgements:
        return undecided(judgements)
    return Judgement(IN_PART if IN_PART in verdicts else otherwise)


def agreed(judgements):
    """One statement, judged once for each choice of the analysis. Choices that certainly disagree
    leave it undecided, without points: no seeds would decide it."""
    judgements = list(judgements)
    verdicts = {j.verdict for j in judgements}
    if len(verdicts - {UNDECIDED}) > 1:
        return Judgement(UNDECIDED)
    if UNDECIDED in verdicts or not judgements:
        return undecided(judgements)
    return Judgement(verdicts.pop())


def combined(*judgements):
    """A claim with several statements. Only here can a claim hold in part."""
    verdicts = {j.verdict for j in judgements}
    if IN_PART in verdicts or {HOLDS, FAILS} <= verdicts:
        return Judgement(IN_PART)
    if UNDECIDED in verdicts:
        return undecided(judgements)
    return Judgement(HOLDS if HOLDS in verdicts else FAILS)


# A rising curve may fall from any point to any later one by this share of its whole rise: the
# symbols of the paper's Figure 4 hide a tenth. All pairs are compared, not only neighbours, since
# between the neighbours of a finer grid any curve falls by less.
REVERSAL = 0.1
# Fewer points do not show that a curve rises throughout.
LEAST_POINTS = 3


def largest_reversal(values):
    """The pair (i, j), i < j, between which a rising curve falls most; None if it never falls."""
    known = [k for k, v in enumerate(values) if v.known]
    falls_by = [
        (values[i].mean - values[j].mean, (i, j))
        for n, i in enumerate(known)
        for j in known[n + 1 :]
    ]
    largest, pair = max(falls_by, default=(0.0, None))
    return pair if largest > 0 else None


def rises(values, least=0.0):
    """A rising curve: from its beginning to its end it rises by more than `least`, and between no
    two points does it fall by more than REVERSAL of that rise."""
    values = [v for v in values if v.mean == v.mean]
    if len(values) < LEAST_POINTS:
        return undecided(values)
    rise = values[-1] - values[0]
    overall = above(rise, least)
    if overall.verdict != HOLDS:
        return overall
    return every(
        [below(a - b, REVERSAL * rise.mean) for k, a in enumerate(values) for b in values[k + 1 :]]
    )


def falls(values, least=0.0):
    return rises([-v for v in values], least)
