"""Where a measured curve crosses zero, as searches and the paper's figures decide it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Optional, Union

from . import _engine
from ._arguments import shown
from ._estimates import Estimate


def zero_crossing(
    discs: Sequence[float],
    rates: Sequence[Union[Estimate, float]],
    errors: Optional[Sequence[float]] = None,
) -> dict[str, Any]:
    """Where a measured curve, such as the rotation against the number of discs, changes its sign.

        runs = swirl.map(discs=range(34, 44), periods=200)
        found = swirl.zero_crossing([r.config["discs"] for r in runs],
                                    [r.rotation.mean_by_time for r in runs])
        found["words"], found["discs"], found["error"]

    rates: estimates, or numbers with their `errors`. A sign is certain at three errors
    (src/swirl/statistics/ zero_crossing.hpp). Points may come in any order; a point without an
    error is ignored.

    Returns a dictionary. verdict: "crosses", "always rotates", "always counterrotates" or
    "undecided". discs, error: N_c and its standard error, NaN if only the bracket is known. lower,
    upper: 95 % interval, or the bracket. words: N_c as a text. changes, last: every change of the
    sign and the last one, each with before, after, to_counterrotation, discs, error, lower, upper
    and location. points: number of points. undetermined, undetermined_after: numbers of discs whose
    sign is uncertain, all of them and those beyond the last change."""
    if errors is None:
        without = next((rate for rate in rates if not isinstance(rate, Estimate)), None)
        if without is not None:
            raise TypeError(
                f"rates contains {shown(without)}, which has no error.\n"
                "hint: give estimates, such as result.rotation.mean_by_time, or errors."
            )
        errors = [rate.error for rate in rates if isinstance(rate, Estimate)]
    elif any(isinstance(rate, Estimate) for rate in rates):
        raise TypeError("errors is given, but the estimates in rates have errors of their own.")
    columns = [
        _floats(name, values)
        for name, values in (("discs", discs), ("rates", rates), ("errors", errors))
    ]
    return _engine.zero_crossing(*columns)


def _floats(name: str, values: Sequence[Union[Estimate, float]]) -> list[float]:
    try:
        return [float(value) for value in values]
    except (TypeError, ValueError):
        raise TypeError(f"{name} is {shown(values)}, but it must be a list of numbers.") from None
