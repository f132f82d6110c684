"""Means with errors: over runs that differ only in their seeds, as sweeps, crossings and the
paper's figures compute it, and over the values of a series."""

from collections.abc import Sequence
from typing import Any, NamedTuple, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _engine
from ._arguments import text
from ._estimates import Estimate

_Numbers = npt.NDArray[np.float64]


class SeedMean(NamedTuple):
    """The result of swirl.mean(): numbers, or arrays with one number for each row of the means.

    `error` is the larger of the errors within and between the runs, with Student's factor. `scatter`
    is that of the runs in units of their own errors; 1 is expected. The runs `disagree` if they
    scatter more than their errors explain.
    """

    mean: Union[float, _Numbers]
    error: Union[float, _Numbers]
    effective_samples: Union[float, _Numbers]
    scatter: Union[float, _Numbers]
    disagree: Union[bool, npt.NDArray[np.bool_]]


def mean(
    means: npt.ArrayLike,
    errors: Optional[npt.ArrayLike] = None,
    *,
    periods: Sequence[float] = (),
    effective_samples: Optional[npt.ArrayLike] = None,
    by_time: bool = True,
    directions: bool = False,
) -> SeedMean:
    """The mean over seeds and its error: the rule of `swirl collect` and of the paper's figures.

        swirl.mean([r.rotation.mean_by_time.mean for r in runs],
                   [r.rotation.mean_by_time.error for r in runs],
                   periods=[r.periods - r.warmup for r in runs])

    means, errors, effective_samples: shape [run], or [quantity, run] for several quantities. The
        result has the unit of the means. Without errors, the error is that between the runs.
    periods: length of each run after its warm-up. Runs with fewer than swirl.min_averaged_periods
        are left out, unless all runs are that short. Averages over time count as these lengths.
        Without periods, all runs count the same.
    by_time: False for averages over events, for which all runs count the same.
    directions: the means are angles in degrees (swirl.is_direction()).

    The error is the larger of two: the error within the runs, from their own errors, and the error
    between them, from their scatter, with Student's factor (src/swirl/statistics/replicates.hpp).
    Raises ValueError if the shapes differ.
    """
    values = np.asarray(means, dtype=float)
    rows = np.atleast_2d(values)

    def like_means(given: Optional[npt.ArrayLike], default: float) -> _Numbers:
        values: _Numbers = (
            np.full(rows.shape, default)
            if given is None
            else np.atleast_2d(np.asarray(given, dtype=float))
        )
        return values

    weights: Any = (
        _engine.replicate_weights([float(each) for each in periods], by_time)
        if len(periods)
        else []
    )
    found = _engine.over_replicates(
        rows, like_means(errors, np.nan), like_means(effective_samples, 0.0), weights, directions
    )
    columns = [*found[:4], found[4] != 0]
    if values.ndim == 1:
        return SeedMean(*(column[0].item() for column in columns))
    return SeedMean(*columns)


def series_mean(values: Sequence[float]) -> Estimate:
    """The mean of a series of correlated values, such as one for each period, with its error.

        elongation = swirl.series_mean(values)
        elongation.error, elongation.details["autocorrelation_time"]

    values: equally spaced in time, shape [time]. The error allows for their autocorrelation, whose
    integrated time `details` has, in units of the spacing; it is NaN for fewer than two values
    (src/swirl/statistics/block_average.hpp).
    """
    numbers = [float(value) for value in values]
    mean, error, effective, time = _engine.estimate_of_series(numbers)
    return Estimate(mean, error, effective, len(numbers), details={"autocorrelation_time": time})


def is_direction(name: str) -> bool:
    """True if a measured number, such as "centre.theta", is an angle of a direction.

    Directions are averaged as unit vectors: the mean of 350° and 10° is 0°. Names that no
    measurement has are no directions.
    """
    return _engine.is_direction(text("name", name))
