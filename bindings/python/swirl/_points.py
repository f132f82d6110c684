"""Points of a real dish beside the curves of a sweep: χ², and the parameter that fits best."""

from __future__ import annotations

import dataclasses
import math
import os
import tempfile
from typing import Any, Optional

from . import _engine

Curve = list[tuple[float, float, float]]  # N, ϖ/Ω, its error


@dataclasses.dataclass(frozen=True)
class PointComparison:
    """How measured points compare with the curves of a sweep.

    `points` has (N, ϖ/Ω, error) of the points in the range of all curves; `left_out` is the number
    of the others. `chi_square` has χ² of each curve, by its parameters as a text. If the curves
    differ in a parameter, `parameter` is its name, `value` the one that fits best, `error` its
    standard error, and `lower` to `upper` its interval of one standard error. `minimum` is the
    least χ², with `freedom` degrees of freedom; the error is scaled where the model does not fit.
    An interval that reaches the end of the curves (`at_the_end`) is open there."""

    points: Curve
    left_out: int
    curves: dict[str, Curve]
    chi_square: dict[str, float]
    parameter: Optional[str]
    value: float
    error: float
    lower: float
    upper: float
    minimum: float
    freedom: int
    at_the_end: bool

    def __str__(self) -> str:
        if self.parameter is None or math.isnan(self.value):
            return ", ".join(
                f"{name or 'the model'}: χ² = {value:.3g}"
                for name, value in self.chi_square.items()
            )
        where = ", at the end of the curves" if self.at_the_end else f" ± {self.error:.2g}"
        return (
            f"{self.parameter} = {self.value:.3g}{where} fits best: χ² = {self.minimum:.3g} "
            f"with {self.freedom} degrees of freedom"
        )

    def plot(self, *, ax: Any = None) -> Any:
        """Draws the curves and the points; returns the axes."""
        from . import plot

        ax = plot._axes(ax)
        for name, curve in self.curves.items():
            numbers, rates, errors = zip(*curve)
            ax.errorbar(numbers, rates, yerr=errors, label=name or None, capsize=2)
        if self.points:
            numbers, rates, errors = zip(*self.points)
            ax.errorbar(numbers, rates, yerr=errors, fmt="k*", capsize=3, label="points", zorder=5)
        ax.axhline(0, color="0.6", linewidth=0.5)
        ax.set(xlabel="number of particles N", ylabel="ϖ/Ω")
        ax.legend()
        return ax


def _read(points: Any, period: Optional[float]) -> Curve:
    """A file; or a DataFrame, a dictionary of columns or rows (N, turns, circles), which pass
    through the same reader."""
    if isinstance(points, (str, os.PathLike)):
        return _engine.read_own_points(os.fspath(points), period)
    if hasattr(points, "to_dict"):
        points = points.to_dict("list")
    if isinstance(points, dict):
        lines = [
            ",".join(map(str, points)),
            *(",".join(map(str, row)) for row in zip(*points.values(), strict=True)),
        ]
    else:
        lines = ["N,turns,circles", *(",".join(map(str, row)) for row in points)]
    with tempfile.TemporaryDirectory(prefix="swirl-points-") as folder:
        file = os.path.join(folder, "points")
        with open(file, "w", encoding="utf-8") as opened:
            opened.write("\n".join(lines) + "\n")
        return _engine.read_own_points(file, period)


def _parameter(varied: list[str], groups: list[dict[str, Any]]) -> Optional[str]:
    """The first varied column of numbers that differs between all curves."""
    for name in varied:
        values = [group[name] for group in groups]
        if all(isinstance(value, (int, float)) for value in values) and len(set(values)) == len(
            values
        ):
            return name
    return None


def compare_points(points: Any, table: Any, *, period: Optional[float] = None) -> PointComparison:
    """Compares measured points with the table of a sweep over the number of particles.

        table = swirl.sweep("mine", preset="experiment", discs=range(8, 53, 4),
                            mu=[0.2, 0.3, 0.4], replicates=2)
        found = swirl.compare_points([(8, 4.4, 20), (36, 0.1, 20), (48, -0.7, 20)], table)
        print(found)
        found.plot()

    points: a file, a DataFrame, a dictionary of columns, or rows (N, turns, circles). Columns are
        N, turns and circles, or N, turns and time (with `period`, the seconds of a circle), or N,
        rate and error. Turns against the swirl are negative, and have the error of reading a mark
        twice to a twelfth of a turn.
    table: a DataFrame of swirl.sweep() or swirl.collect(). The parameter that fits best is the
        first one that differs between all its curves.
    """
    measured = _read(points, period)
    names = list(table.columns)
    parameters = names[: names.index("replicates")]
    if "discs" not in parameters:
        raise ValueError(
            "the table has no column 'discs'.\nhint: sweep over the number of particles."
        )
    varied = [name for name in parameters if name != "discs" and table[name].nunique() > 1]
    groups = (
        table.groupby(varied if len(varied) > 1 else varied[0], sort=True)
        if varied
        else [((), table)]
    )
    curves: dict[str, Curve] = {}
    values: list[dict[str, Any]] = []
    for key, rows in groups:
        here = dict(zip(varied, key if isinstance(key, tuple) else (key,)))
        rows = rows[rows["mean_by_time"].notna()].sort_values("discs")
        name = ", ".join(
            f"{each} = {value:g}" if isinstance(value, float) else f"{each} = {value}"
            for each, value in here.items()
        )
        curves[name] = [
            (float(n), float(rate), 0.0 if math.isnan(error) else float(error))
            for n, rate, error in zip(
                rows["discs"], rows["mean_by_time"], rows["mean_by_time_error"]
            )
        ]
        values.append(here)
    parameter = _parameter(varied, values)
    numbers = [float(here[parameter]) if parameter else math.nan for here in values]
    order = (
        sorted(range(len(numbers)), key=lambda k: numbers[k])
        if parameter
        else list(range(len(numbers)))
    )
    listed = list(curves.items())
    curves = dict(listed[k] for k in order)
    used, chi_squares, best = _engine.compare_curves(
        [numbers[k] for k in order], list(curves.values()), measured
    )
    value, lower, upper, minimum, freedom, open_end = best or (
        math.nan,
        math.nan,
        math.nan,
        math.nan,
        0,
        False,
    )
    return PointComparison(
        used,
        len(measured) - len(used),
        curves,
        dict(zip(curves, chi_squares)),
        parameter,
        value,
        0.5 * (upper - lower),
        lower,
        upper,
        minimum,
        freedom,
        open_end,
    )
