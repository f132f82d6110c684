"""The mean over runs that differ only in their seeds, as sweeps, crossings and the paper's figures
compute it."""

from collections.abc import Sequence
from typing import Any, NamedTuple, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _engine

_Numbers = npt.NDArray[np.float64]


class SeedMean(NamedTuple):
    """Numbers, or arrays with one number per row of the means."""

    mean: Union[float, _Numbers]
    error: Union[
        float, _Numbers
    ]  # the larger of those within and between the runs, with Student's factor
    effective_samples: Union[float, _Numbers]
    scatter: Union[float, _Numbers]  # of the runs in units of their own errors; 1 is expected
    disagree: Union[bool, npt.NDArray[np.bool_]]  # the runs scatter more than their errors explain


def over_seeds(
    means: npt.ArrayLike,
    errors: Optional[npt.ArrayLike] = None,
    *,
    periods: Sequence[float] = (),
    effective_samples: Optional[npt.ArrayLike] = None,
    by_time: bool = True,
    directions: bool = False,
) -> SeedMean:
    """The mean over seeds and its error: the rule of `swirl collect` and of the paper's figures.

        swirl.over_seeds([r.rotation.mean_by_time.mean for r in runs],
                         [r.rotation.mean_by_time.error for r in runs],
                         periods=[r.periods - r.warmup for r in runs])

    means, errors, effective_samples: one value per run, or rows of them for several quantities.
        Without errors, the error is that between the runs.
    periods: length of each run after its warm-up. Runs with fewer than five periods are left out,
        unless all runs are that short. Averages over time count as these lengths. Without periods,
        all runs count the same.
    by_time: False for averages over events, for which all runs count the same. directions: the
    means are angles in degrees.
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
