"""The error of any statistic of independent points or runs, from leaving out one at a time (Efron,
Tibshirani, An Introduction to the Bootstrap, 1993, ch. 11)."""

import math

import numpy as np


def jackknife(count, statistic):
    """(value, error) of a statistic of the indices of `count` points; NaN with fewer than four."""
    if count < 4:
        return math.nan, math.nan
    everything = np.arange(count)
    without = np.array([statistic(np.delete(everything, k)) for k in everything])
    return statistic(everything), math.sqrt(
        (count - 1) / count * np.sum((without - without.mean()) ** 2)
    )
