"""Numbers, snapshots and frames as tables of pandas and xarray."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Union

import numpy as np

from . import _engine
from ._estimates import ArrayEstimate, Estimate
from ._optional import optional

Rows = Iterable[tuple[str, Union[Estimate, ArrayEstimate]]]
_OF_EACH = ("angle", "spin", "pinned", "resident")  # one number per disc in each frame
_OF_DISCS = ("radius", "mass", "inertia", "can_spin")  # one number per disc


def _columns_of_numbers(rows: Rows) -> dict[str, list[Any]]:
    """The columns of numbers.csv (swirl run --tables). Each element of an array is a row."""
    columns: dict[str, list[Any]] = {
        name: [] for name in ("quantity", "unit", "mean", "error", "effective_samples", "blocks")
    }
    for quantity, estimate in rows:
        if isinstance(estimate, Estimate):
            found = [
                (quantity, estimate.unit, *estimate, estimate.effective_samples, estimate.blocks)
            ]
        else:
            found = [
                (
                    f"{quantity}[{', '.join(map(str, at))}]",
                    "1",
                    estimate.mean[at],
                    estimate.error[at],
                    estimate.effective_samples[at],
                    estimate.blocks,
                )
                for at in np.ndindex(estimate.mean.shape)
            ]
        for row in found:
            for column, value in zip(columns.values(), row):
                column.append(value)
    return columns


def numbers_to_pandas(rows: Rows) -> Any:
    pandas = optional("pandas", "to_pandas()")
    return pandas.DataFrame(_columns_of_numbers(rows))


def numbers_to_xarray(rows: Rows) -> Any:
    xarray = optional("xarray", "to_xarray()")
    columns = _columns_of_numbers(rows)
    quantity = columns.pop("quantity")
    return xarray.Dataset(
        {name: ("quantity", values) for name, values in columns.items()}, {"quantity": quantity}
    )


def rows_of(measured: Mapping[str, Any]) -> Rows:
    """The numbers of all measurements with their complete names."""
    for name, found in measured.items():
        for row, estimate in found.rows.items():
            yield f"{name}.{row}", estimate


def snapshot_to_pandas(self: _engine.Snapshot) -> Any:
    """A pandas DataFrame, one row per disc."""
    pandas = optional("pandas", "to_pandas()")
    columns: dict[str, Any] = {
        "disc": np.arange(len(self)),
        **_plane("x", "y", self.position),
        **_plane("v_x", "v_y", self.velocity),
    }
    if self.rolling_spin is not None:
        columns.update(_plane("spin_x", "spin_y", self.rolling_spin))
    columns.update({name: np.array(getattr(self, name)) for name in _OF_EACH + _OF_DISCS})
    return pandas.DataFrame(columns)


def snapshot_to_xarray(self: _engine.Snapshot) -> Any:
    """An xarray Dataset with the dimensions disc and xy."""
    xarray = optional("xarray", "to_xarray()")
    columns: dict[str, Any] = {
        "position": (("disc", "xy"), np.array(self.position)),
        "velocity": (("disc", "xy"), np.array(self.velocity)),
    }
    if self.rolling_spin is not None:
        columns["rolling_spin"] = (("disc", "xy"), np.array(self.rolling_spin))
    columns.update({name: ("disc", np.array(getattr(self, name))) for name in _OF_EACH + _OF_DISCS})
    columns.update(
        {
            name: ("xy", np.array(getattr(self, name)))
            for name in ("container_centre", "container_velocity")
        }
    )
    return xarray.Dataset(columns, {"xy": ["x", "y"], "time": self.time}, _of_the_container(self))


def frames_to_pandas(self: _engine.Frames) -> Any:
    """A pandas DataFrame, one row per disc of each frame."""
    pandas = optional("pandas", "to_pandas()")
    frames, discs = len(self), self.discs
    columns: dict[str, Any] = {
        "frame": np.repeat(np.arange(frames), discs),
        "time": np.repeat(self.time, discs),
        "disc": np.tile(np.arange(discs), frames),
        **_plane("x", "y", self.position),
        **_plane("v_x", "v_y", self.velocity),
    }
    columns.update({name: np.array(getattr(self, name)).ravel() for name in _OF_EACH})
    columns.update({name: np.tile(getattr(self, name), frames) for name in _OF_DISCS})
    return pandas.DataFrame(columns)


def frames_to_xarray(self: _engine.Frames) -> Any:
    """An xarray Dataset with the dimensions frame, disc and xy."""
    xarray = optional("xarray", "to_xarray()")
    columns: dict[str, Any] = {
        name: (("frame", "disc", "xy"), np.array(getattr(self, name)))
        for name in ("position", "velocity")
    }
    columns.update({name: (("frame", "disc"), np.array(getattr(self, name))) for name in _OF_EACH})
    columns.update({name: ("disc", np.array(getattr(self, name))) for name in _OF_DISCS})
    columns.update(
        {
            name: (("frame", "xy"), np.array(getattr(self, name)))
            for name in ("container_centre", "container_velocity")
        }
    )
    axes: dict[str, Any] = {"xy": ["x", "y"]}
    axes.update(
        {
            name: ("frame", np.array(getattr(self, name)))
            for name in ("time", "whole_periods", "clock")
        }
    )
    return xarray.Dataset(columns, axes, _of_the_container(self))


def _plane(x: str, y: str, values: Any) -> dict[str, Any]:
    return {x: values[..., 0].ravel(), y: values[..., 1].ravel()}


def _of_the_container(source: Union[_engine.Snapshot, _engine.Frames]) -> dict[str, float]:
    return {"container_radius": source.container_radius, "period": source.period}
