"""Checks of the arguments of many runs: measurements, counts, and tables of points."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any, Optional

from ._arguments import shown
from ._runs import Measure, split_measure


def names_of(measure: Optional[Measure], where: str) -> list[str]:
    names, custom = split_measure(measure)
    if custom:
        raise TypeError(f"{where} does not take custom measurements.\nhint: use swirl.map().")
    return names


def given_values(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Without None, which stands for a parameter that is not given."""
    return {name: value for name, value in parameters.items() if value is not None}


def count(name: str, value: object, lowest: int) -> int:
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        raise TypeError(f"{name} is {shown(value)}, but it must be a whole number.")
    number = int(value.__index__())
    if not lowest <= number <= 1_000_000:
        raise ValueError(
            f"{name} is {number}, but it must be a whole number from {lowest} to 1000000."
        )
    return number


def rows_of(points: Any) -> Optional[list[dict[str, Any]]]:
    """The rows of a table: a DataFrame, a dictionary of columns, or a list of dictionaries."""
    if points is None:
        return None
    if hasattr(points, "columns") and hasattr(points, "to_dict"):
        if not points.columns.is_unique:
            twice = sorted({str(name) for name in points.columns[points.columns.duplicated()]})
            raise ValueError(f"points has two columns {', '.join(twice)}.")
        rows: list[dict[str, Any]] = points.to_dict("records")
    elif isinstance(points, Mapping):
        if any(
            isinstance(values, str) or not hasattr(values, "__len__") for values in points.values()
        ):
            raise TypeError(
                "points is a dictionary, but not each of its values is a column, a list of values."
            )
        lengths = {name: len(values) for name, values in points.items()}
        if len(set(lengths.values())) > 1:
            raise ValueError(f"the columns of points have different lengths: {lengths}.")
        rows = [dict(zip(points, row)) for row in zip(*points.values())]
    elif isinstance(points, Sequence) and all(isinstance(row, Mapping) for row in points):
        rows = [dict(row) for row in points]
    else:
        raise TypeError(
            f"points is {shown(points)}, but it must be a DataFrame, a list of dictionaries, or a "
            "dictionary "
            'of columns.\nhint: read a file with pandas.read_csv("points.csv", comment="#").'
        )
    if not rows:
        raise ValueError("points has no rows.")
    return [_row(number, row) for number, row in enumerate(rows, 1)]


def _row(number: int, row: Mapping[Any, Any]) -> dict[str, Any]:
    """As the reader of files takes it: names in lower case, and no decimal commas in texts."""
    found: dict[str, Any] = {}
    for given, value in row.items():
        name = str(given).lower()
        if name in found:
            raise ValueError(f"points has two columns {name}.")
        if isinstance(value, str) and re.fullmatch(r"\s*[-+]?\d+,\d+\s*", value):
            raise ValueError(
                f"points, row {number}: {name} is {shown(value)}, but it must be a number.\n"
                'hint: read decimal commas with pandas.read_csv(file, sep=";", decimal=",").'
            )
        found[name] = value
    return found
