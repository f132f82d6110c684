"""The zero of a curve whose points are several N apart. swirl.zero_crossing() decides whether there
is one, and reports no N for such curves, because the curve between the points is unknown. Here it
is interpolated.

Between the points k and k + 1, of opposite signs, a parabola through these two and a third point
has exactly one zero. There are two such parabolas, one with point k − 1 and one with point k + 2.
Their errors at x are f‴/6 times (x − x_k)(x − x_{k+1})(x − x_third), whose last factor is positive
for one and negative for the other. So the zero of a smooth curve whose third derivative keeps its
sign lies between the zeros of the two parabolas. N_c is their mean, and half of their distance is
the error of the interpolation. At the end of a curve there is one parabola; then the distance from
the zero of the straight line is the error. Two points alone have only the straight line. Its zero
may be anywhere between them: the error is a uniform distribution's, step/√12.

The statistical error follows from the errors of the two points. A curve that jumps between two
points, from one state to another, is not smooth; then the parabolas differ much, but do not bound
the zero.

A point is (N, mean, error), and a curve a list of points.
"""

import dataclasses
import math

import scipy.optimize

from paper.combine import at, number
from paper.curves import with_error
from paper.engine import swirl


def rise_through(x, y, level):
    """The first x at which straight lines between the points rise through the level; NaN if they do
    not."""
    for a, b, c, d in zip(x, x[1:], y, y[1:]):
        if c <= level < d:
            return a + (b - a) * (level - c) / (d - c)
    return math.nan


@dataclasses.dataclass
class CurveZero:
    fraction: float  # of the way from point k to point k + 1
    discs: float
    statistical: float
    interpolation: float

    @property
    def error(self):
        return math.hypot(self.statistical, self.interpolation)

    def __str__(self):
        return f"N = {with_error(self.discs, self.error)}"


def zero_of_parabola(a, b, c):
    """The zero between a and b, of opposite signs, of the parabola through a, b and c."""
    slope = (b[1] - a[1]) / (b[0] - a[0])
    curvature = ((c[1] - b[1]) / (c[0] - b[0]) - slope) / (c[0] - a[0])
    return scipy.optimize.brentq(
        lambda x: a[1] + (x - a[0]) * (slope + (x - b[0]) * curvature), a[0], b[0], xtol=1e-14
    )


def zero_of_curve(curve, k):
    """The zero between the points k and k + 1."""
    a, b = curve[k], curve[k + 1]
    step, f = b[0] - a[0], a[1] / (a[1] - b[1])
    discs, interpolation = a[0] + f * step, step / math.sqrt(12)
    statistical = math.hypot((1 - f) * a[2], f * b[2]) * step / abs(b[1] - a[1])
    thirds = [curve[j] for j in (k - 1, k + 2) if 0 <= j < len(curve)]
    zeros = [zero_of_parabola(a, b, c) for c in thirds]
    if len(zeros) == 2:
        discs, interpolation = 0.5 * (zeros[0] + zeros[1]), 0.5 * abs(zeros[1] - zeros[0])
    elif zeros:
        discs, interpolation = zeros[0], abs(zeros[0] - discs)
    return CurveZero((discs - a[0]) / step, discs, statistical, interpolation)


def changes_of_sign(curve):
    """The certain changes of sign: dictionaries with "before", "after" and "to_counterrotation"."""
    return swirl.zero_crossing(*map(list, zip(*curve)))["changes"] if curve else []


def middle_zero(curve, change):
    """The k for which the zero is between the points k and k + 1, inside the bracket of the change;
    the middle one of several."""
    zeros = [
        k
        for k, (a, b) in enumerate(zip(curve, curve[1:]))
        if a[0] >= change["before"] and b[0] <= change["after"] and (a[1] < 0) != (b[1] < 0)
    ]
    return zeros[len(zeros) // 2]


def last_zero(curve):
    """(CurveZero, True if the curve falls there) of the last certain change of sign; (None, False)
    without one."""
    changes = changes_of_sign(curve)
    if not changes:
        return None, False
    return zero_of_curve(curve, middle_zero(curve, changes[-1])), changes[-1]["to_counterrotation"]


def crossing_of_curve(curve):
    """(N_c, error) of the last certain change to counterrotation; None without one. Where the
    points of its bracket are neighbours, N_c is that of all figures. In a coarse curve the error
    contains that of the interpolation."""
    if not curve:
        return None
    found = swirl.zero_crossing(*map(list, zip(*curve)))
    if math.isfinite(found["discs"]):
        return found["discs"], found["error"]
    changes = [change for change in found["changes"] if change["to_counterrotation"]]
    if not changes:
        return None
    zero = zero_of_curve(curve, middle_zero(curve, changes[-1]))
    return zero.discs, zero.error


def measured_curve(points, quantity):
    """A measured quantity, such as "torque.transfer", against N."""
    values = [at(p.result, "measured", *quantity.split(".")) for p in points]
    return [
        (p.cells["discs"], number(at(value, "mean")), number(at(value, "error")))
        for p, value in zip(points, values)
    ]
