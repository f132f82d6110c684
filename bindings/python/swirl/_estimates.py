"""Values with errors: their text, and the arithmetic that keeps the errors right."""

from __future__ import annotations

import dataclasses
import math
import numbers
import uuid
from collections.abc import Iterator, Mapping
from typing import Union

import numpy as np
import numpy.typing as npt

from . import _engine

FloatArray = npt.NDArray[np.float64]
_TYPES_OF_NUMBERS = "eEfFgG"


def with_error(mean: float, error: float = math.nan) -> str:
    """ "−0.037 ± 0.001" as reports print it: as many digits as the error supports.

    The error has two digits if it begins with 1, otherwise one. Without an error the mean has three
    digits, and a mean that is not available is "n/a"."""
    return _engine.with_error(mean, error)


def _new_source() -> frozenset[str]:
    return frozenset((uuid.uuid4().hex,))


@dataclasses.dataclass(frozen=True)
class Estimate:
    """A mean with its standard error, from blocks of whole periods.

        mean, error = estimate
        print(estimate, f"{estimate:.3f}")          # −0.0370 ± 0.0009 Ω, −0.037 ± 0.001 Ω
        2 * estimate, estimate / 3, estimate - 0.1  # exact numbers
        a - b, a + b                                # estimates of independent runs

    The errors of two estimates of one run are correlated, so their sum or difference raises
    ValueError. Runs are one run if they differ only in their length. A product or quotient of two
    estimates raises TypeError.

    A value that is not available is NaN, such as an error from too few blocks. `unit` is in terms
    of docs/explanation/physics.md: r radius of a disc, m its mass, v speed of the container, Ω =
    2π/T; "1" if there is no unit."""

    mean: float
    error: float = math.nan
    effective_samples: float = math.nan
    blocks: int = 0
    unit: str = "1"
    description: str = ""
    details: Mapping[str, float] = dataclasses.field(default_factory=dict)
    # numpy's numbers leave the arithmetic to this class.
    __array_ufunc__ = None
    # What the estimate was computed from. Estimates that share a source are correlated.
    _sources: frozenset[str] = dataclasses.field(
        default_factory=_new_source, repr=False, compare=False
    )

    def __float__(self) -> float:
        return self.mean

    def __iter__(self) -> Iterator[float]:
        yield self.mean
        yield self.error

    def __str__(self) -> str:
        return self._in_units(with_error(self.mean, self.error))

    def __format__(self, spec: str) -> str:
        """A format of numbers, such as ".3f", applies to the mean and to the error, any other to
        the text."""
        if spec[-1:] not in tuple(_TYPES_OF_NUMBERS):
            return format(str(self), spec)
        if not math.isfinite(self.mean):
            return self._in_units("n/a")
        value = format(self.mean, spec).replace("-", "−", 1)
        return self._in_units(
            f"{value} ± {format(self.error, spec)}" if math.isfinite(self.error) else value
        )

    def _in_units(self, value: str) -> str:
        return value if self.unit in ("1", "") else f"{value} {self.unit}"

    def __neg__(self) -> "Estimate":
        return self._scaled(-1.0)

    def __pos__(self) -> "Estimate":
        return self

    def __add__(self, other: Union["Estimate", float]) -> "Estimate":
        if isinstance(other, Estimate):
            return self._plus(other, 1.0)
        if not _is_exact(other):
            return NotImplemented
        return self._derived(self.mean + float(other), self.error)

    def __radd__(self, other: float) -> "Estimate":
        return self.__add__(other)

    def __sub__(self, other: Union["Estimate", float]) -> "Estimate":
        if isinstance(other, Estimate):
            return self._plus(other, -1.0)
        if not _is_exact(other):
            return NotImplemented
        return self._derived(self.mean - float(other), self.error)

    def __rsub__(self, other: float) -> "Estimate":
        return (-self).__add__(other)

    def __mul__(self, factor: float) -> "Estimate":
        if isinstance(factor, Estimate):
            raise _not_linear("product", "a.mean * b.mean")
        if not _is_exact(factor):
            return NotImplemented
        return self._scaled(float(factor))

    def __rmul__(self, factor: float) -> "Estimate":
        return self.__mul__(factor)

    def __truediv__(self, divisor: float) -> "Estimate":
        if isinstance(divisor, Estimate):
            raise _not_linear("quotient", "a.mean / b.mean")
        if not _is_exact(divisor):
            return NotImplemented
        return self._derived(self.mean / float(divisor), self.error / abs(float(divisor)))

    def _scaled(self, factor: float) -> "Estimate":
        return self._derived(factor * self.mean, abs(factor) * self.error)

    def _plus(self, other: "Estimate", sign: float) -> "Estimate":
        if self.unit != other.unit:
            raise ValueError(
                f"one estimate is in units of {self.unit}, the other in units of {other.unit}."
            )
        if self._sources & other._sources:
            raise ValueError(
                "both estimates are of the same run, so their errors are correlated.\n"
                "hint: measure the sum or the difference in each period, with a measurement of "
                "your own (docs/how-to/own_measurement.md); or use other seeds."
            )
        return dataclasses.replace(
            self._derived(self.mean + sign * other.mean, math.hypot(self.error, other.error)),
            effective_samples=min(
                self.effective_samples, other.effective_samples, key=_or_infinity
            ),
            blocks=min(self.blocks, other.blocks),
            _sources=self._sources | other._sources,
        )

    def _derived(self, mean: float, error: float) -> "Estimate":
        # The description and the details are those of the measured number only.
        return dataclasses.replace(self, mean=mean, error=error, description="", details={})


def _or_infinity(value: float) -> float:
    return math.inf if math.isnan(value) else value


def _is_exact(value: object) -> bool:
    return isinstance(value, numbers.Real) and not isinstance(value, (bool, np.bool_))


def _not_linear(what: str, of_means: str) -> TypeError:
    return TypeError(
        f"the {what} of two estimates has an error that depends on how they are distributed.\n"
        f"hint: measure the {what} in each period with a measurement of your own "
        f"(docs/how-to/own_measurement.md), or use the means: {of_means}."
    )


@dataclasses.dataclass(frozen=True)
class ArrayEstimate:
    """An array of means with their standard errors from blocks. All arrays have the same shape.

    mean, error = estimate
    """

    mean: FloatArray
    error: FloatArray
    effective_samples: FloatArray
    blocks: int

    def __iter__(self) -> Iterator[FloatArray]:
        yield self.mean
        yield self.error

    def __str__(self) -> str:
        return f"{self.mean.shape} numbers with errors, from {self.blocks} blocks"
