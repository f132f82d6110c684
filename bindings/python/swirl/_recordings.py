"""Recordings: trajectories of runs and tracks of a camera."""

from __future__ import annotations

import dataclasses
import inspect
import json
import math
import numbers
import os
import pathlib
from collections.abc import Iterator, Mapping
from typing import Any, Optional, Protocol, Union, overload

import numpy as np
import numpy.typing as npt

from . import _engine
from ._arguments import file_name, shown
from ._files import exists
from ._estimates import Estimate
from ._results import Measured, Rotation, measured_of, source_of_run
from ._tables import numbers_to_pandas, numbers_to_xarray, rows_of
from ._runs import Measure, CustomBlocks, PathName, split_measure


class Recording:
    """Frames that are read on demand.

    `len(recording)`, `recording[k]` (a Snapshot), `recording[10:200:5]` (Frames), iteration.
    """

    __slots__ = ("_frames", "__weakref__")
    _frames: _engine.Recording

    def __len__(self) -> int:
        return len(self._frames)

    @overload
    def __getitem__(self, k: int) -> _engine.Snapshot:
        ...

    @overload
    def __getitem__(self, k: slice) -> _engine.Frames:
        ...

    def __getitem__(self, k: Union[int, slice]) -> Union[_engine.Snapshot, _engine.Frames]:
        if isinstance(k, slice):
            begin, end, step = k.indices(len(self))
            if step < 1:
                raise ValueError(f"the step is {step}, but it must be 1 or more.")
            return self._frames.frames(begin, max(begin, end), step)
        if isinstance(k, bool) or not hasattr(k, "__index__"):
            raise TypeError(f"the index is {shown(k)}, but it must be a whole number.")
        number = k.__index__()
        if not -len(self) <= number < len(self):
            raise IndexError(f"index {number} is out of range: there are {len(self)} frames.")
        number %= len(self)
        return self._frames.frames(number, number + 1, 1)[0]

    def __iter__(self) -> Iterator[_engine.Snapshot]:
        for k in range(len(self)):
            yield self[k]

    @property
    def same_discs(self) -> bool:
        """True if every frame has the same discs in the same order."""
        return self._frames.same_discs

    def __repr__(self) -> str:
        return f"<swirl.{type(self).__name__.lstrip('_')}: {len(self)} frames>"


class Trajectory(Recording):
    """A recording of `swirl run --trajectory` or swirl.run(trajectory=…), finished or not.

        t = swirl.Trajectory("frames.h5")
        t[0].position, t[10:20].position, t.parameters, t.complete

    Of a recording that is still being written (NAME.partial) it has the frames that were in the
    file when it was opened. Open it again to see later ones."""

    __slots__ = ("file",)

    def __init__(self, file: PathName) -> None:
        self.file = file_name("file", file)
        self._frames = _engine.Recording.open(self.file)

    @property
    def complete(self) -> bool:
        """False if the run was stopped or is still running."""
        return self._frames.complete

    @property
    def provenance(self) -> dict[str, str]:
        """Origin of the file: version, command, configuration, seed, …"""
        return self._frames.about()

    @property
    def parameters(self) -> dict[str, Any]:
        """The resolved parameters of the run."""
        return dict(json.loads(self.provenance.get("parameters", "{}")))

    def __repr__(self) -> str:
        return f"<swirl.Trajectory '{self.file}': {len(self)} frames>"


_COLUMNS = ("frame", "particle", "x", "y")


def _column(table: Any, name: str) -> npt.NDArray[Any]:
    """A column of a table of tracks. It may have any type of numbers, such as those of pandas with
    missing values."""
    try:
        column = np.asarray(table[name])
    except (KeyError, IndexError, TypeError, ValueError):
        there = [str(each) for each in table] if hasattr(table, "keys") else []
        renamed = [each for each in there if each.strip().lower() == name]
        hint = (
            f"\nhint: rename '{renamed[0]}' to '{name}'."
            if renamed
            else f"\nhint: it has {_engine.shortened(', '.join(there))}."
            if there
            else ""
        )
        raise ValueError(
            f"the tracks need the columns frame, particle, x and y, but there is no {name}.{hint}"
        ) from None
    if column.ndim != 1:
        raise TypeError(
            f"column {name} of the tracks must hold numbers, but it has {column.ndim} dimensions."
        )
    if column.dtype.kind in "iuf":
        return column
    for row, value in enumerate(column):
        if not isinstance(value, numbers.Real) or isinstance(value, (bool, np.bool_)):
            raise TypeError(
                f"column {name} of the tracks must hold numbers, but row {row} has {shown(value)}."
            )
    return column.astype(float)


class Tracks(Recording):
    """Tracks of a camera: a table of trackpy (columns frame, particle, x, y; pixels, y downwards).

    table: a pandas DataFrame, or any mapping with these columns. omega: angular velocity of the
    swirl, radians per unit of time. container_radius, amplitude: in disc radii. scale: pixels per
    disc radius. camera_fps: frames per unit of time. centre: the swirl centre in pixels. phase: of
    the container at frame 0, in degrees counter-clockwise from the right in the image. clockwise:
    the swirl ran clockwise in the image. max_invalid: the largest share of frames with discs
    outside the container or overlapping.

    Short gaps are filled. Positions are smoothed according to their noise, and velocities are
    derivatives of the smoothed positions (swirl/io/track_smoothing.hpp). With fewer than a
    hundred frames per period, positions stay as they are, and velocities are differences between
    frames (swirl/io/tracks.hpp).

    Raises ValueError or TypeError for wrong arguments, and swirl.Failure with the likely cause if
    more frames contradict these arguments."""

    __slots__ = ()

    def __init__(
        self,
        table: Any,
        *,
        omega: float,
        container_radius: float,
        amplitude: float = 0.0,
        camera_fps: float = 1.0,
        scale: float = 1.0,
        centre: tuple[float, float] = (0.0, 0.0),
        phase: float = 0.0,
        clockwise: bool = False,
        max_invalid: float = 0.05,
    ) -> None:
        for name, value, minimum in (
            ("omega", omega, 1e-12),
            ("container_radius", container_radius, 1e-12),
            ("amplitude", amplitude, 0.0),
            ("camera_fps", camera_fps, 1e-12),
            ("scale", scale, 1e-12),
            ("phase", phase, -1e9),
            ("max_invalid", max_invalid, 0.0),
        ):
            if isinstance(value, bool) or not hasattr(value, "__float__"):
                raise TypeError(f"{name} is {shown(value)}, but it must be a number.")
            if not minimum <= float(value) < math.inf:
                raise ValueError(
                    f"{name} is {value}, but it must be a number of at least {minimum:g}."
                )
        if isinstance(table, (str, bytes)) or not hasattr(table, "__getitem__"):
            raise TypeError(
                f"table is {shown(table)}, but it must be a DataFrame or a mapping with the "
                "columns frame, particle, x and y.\nhint: read a file with swirl.Tracks.read()."
            )
        columns = {name: _column(table, name) for name in _COLUMNS}
        for name in ("frame", "particle"):
            wrong = np.flatnonzero(columns[name] != np.floor(columns[name]))
            if wrong.size:
                raise ValueError(
                    f"column {name} of the tracks must hold whole numbers, but row {wrong[0]} has "
                    f"{columns[name][wrong[0]]}."
                )
        if not isinstance(clockwise, (bool, np.bool_)):
            raise TypeError(f"clockwise is {shown(clockwise)}, but it must be True or False.")
        try:
            x0, y0 = (float(part) for part in centre)
        except (TypeError, ValueError):
            raise TypeError(f"centre is {shown(centre)}, but it must be two numbers.") from None
        if not (math.isfinite(x0) and math.isfinite(y0)):
            raise ValueError(f"centre is {centre}, but it must be two finite numbers.")
        radius = np.asarray(table["radius"], float) if _is_of_swirl_track(table) else np.empty(0)
        is_timed = isinstance(table, _ReadTracks) and "time" in table
        time = np.asarray(table["time"], float) if is_timed else np.empty(0)
        order = np.lexsort((columns["particle"], columns["frame"]))
        self._frames = _engine.Recording.tracks(
            columns["frame"][order],
            columns["particle"][order],
            columns["x"][order],
            columns["y"][order],
            radius[order] if radius.size else radius,
            time[order] if time.size else time,
            {
                "omega": float(omega),
                "container_radius": float(container_radius),
                "amplitude": float(amplitude),
                "camera_fps": float(camera_fps),
                "scale": float(scale),
                "phase": float(phase),
                "centre_x": x0,
                "centre_y": y0,
                "clockwise": bool(clockwise),
            },
            float(max_invalid),
        )

    @classmethod
    def read(cls, file: PathName, **scale: Any) -> "Tracks":
        """Reads a trackpy table in CSV format. Arguments that are not given come from
        NAME.camera.json next to NAME.csv, which `swirl track` writes."""
        name = file_name("file", file)
        camera_file = pathlib.Path(name).with_suffix(".camera.json")
        if exists(camera_file):
            scale = {**_camera(camera_file), **scale}
        return cls(_ReadTracks(_engine.Recording.read_tracks(name)), **scale)

    @property
    def remarks(self) -> list[str]:
        """Remarks on filled gaps, on the noise of positions, and on misfits with the container."""
        return self._frames.remarks.splitlines()


class _ReadTracks(dict[str, Any]):
    """The columns of a file. A column radius is that of `swirl track`."""


def _is_of_swirl_track(table: Any) -> bool:
    """True for tables of `swirl track`. Other trackers use the column radius differently."""
    if isinstance(table, _ReadTracks):
        return "radius" in table
    names = getattr(table, "columns", ())
    return "seen" in names and "radius" in names


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    if len(dict(pairs)) < len(pairs):
        raise ValueError("a name appears twice")
    return dict(pairs)


def _camera(file: pathlib.Path) -> dict[str, Any]:
    """The arguments of Tracks in a file of `swirl track`. Every field must appear once and have its
    type, because a missing field would silently take its default."""
    numbers = ("omega", "container_radius", "amplitude", "camera_fps", "scale", "phase")
    try:
        found = json.loads(file.read_text(encoding="utf-8"), object_pairs_hook=_unique)["camera"]
        camera = {
            argument: found[argument.replace("_", "-")]
            for argument in (*numbers, "centre", "clockwise")
        }
        for name in numbers:
            if type(camera[name]) not in (int, float):
                raise TypeError(f"{name} is {shown(camera[name])}, but it must be a number")
        centre = camera["centre"]
        if type(centre) is not list or [type(part) in (int, float) for part in centre] != [
            True,
            True,
        ]:
            raise TypeError(f"centre is {shown(centre)}, but it must be two numbers")
        if type(camera["clockwise"]) is not bool:
            raise TypeError(
                f"clockwise is {shown(camera['clockwise'])}, but it must be true or false"
            )
        return camera
    except (ValueError, KeyError, TypeError, RecursionError) as wrong:
        raise _engine.Failure(
            f"'{file}' is not a valid file of `swirl track`: {wrong}.\n"
            "hint: remove it, or track the video again."
        ) from None


@dataclasses.dataclass(frozen=True)
class Analysis:
    """Rotation and measurements of a recording, with the names of Result.

    `rotation.mean_by_time` and `rotation.rigid_by_time` are averages over `frames` frames. A
    recording has no events, so the averages by event are NaN. `warnings` names values that are NaN
    because there are too few frames per period."""

    rotation: Rotation
    frames: int
    measured: Mapping[str, Measured]
    warnings: tuple[str, ...] = ()

    def __str__(self) -> str:
        return f"{self.rotation}, from {self.frames} frames"

    def to_pandas(self) -> Any:
        """The rotation and all measured numbers as a pandas DataFrame, as Result.to_pandas()."""
        return numbers_to_pandas([*self.rotation.rows(), *rows_of(self.measured)])

    def to_xarray(self) -> Any:
        """The same as an xarray Dataset along the dimension quantity."""
        return numbers_to_xarray([*self.rotation.rows(), *rows_of(self.measured)])

    def plot(self, what: Optional[str] = None, *, ax: Any = None) -> Any:
        """Draws a measurement or one of its tables; returns the axes. The default is the first
        one."""
        from . import plot

        return plot.result(self, what, ax=ax)


class _Sampled(Recording):
    """Frames in memory."""

    __slots__ = ()

    def __init__(self, frames: _engine.Frames) -> None:
        self._frames = _engine.Recording.of_frames(frames)


class Columns(Protocol):
    """A table of tracks: a pandas DataFrame or a mapping."""

    def __getitem__(self, column: str, /) -> Any:
        ...


def analyse(
    recording: Union[Recording, _engine.Frames, Columns],
    measure: Optional[Measure] = None,
    *,
    warmup: float = 0.0,
    **camera: Any,
) -> Analysis:
    """Measures a recording, like `swirl measure`.

        swirl.analyse(swirl.Trajectory("frames.h5"), measure=["density"])
        swirl.analyse(table, omega=3.1, container_radius=8.5, camera_fps=25, scale=40.0)

    recording: a Trajectory, Tracks, or Frames from Simulation.sample(), also with custom discs or a
    custom path; or a table of tracks, a DataFrame with the columns frame, particle, x and y.
    camera: the arguments of swirl.Tracks, for a table only. measure: as for swirl.run(); "all"
    selects every measurement that frames allow. warmup: periods at the start that are ignored. Each
    period is one block of the error estimate.

    Raises ValueError for a measurement that the recording does not allow, and TypeError if
    `recording` is not a recording."""
    if _is_table(recording):
        recording = _tracks_of(recording, camera)
    elif camera:
        raise TypeError(
            f"{next(iter(camera))} is given, but only a table of tracks needs it: a recording has "
            "its own scale.\nhint: use swirl.analyse(recording, measure=..., warmup=...)."
        )
    if isinstance(recording, _engine.Frames):
        recording = _Sampled(recording)
    if not isinstance(recording, Recording):
        raise TypeError(
            f"recording is {shown(recording)}, but it must be a swirl.Trajectory, "
            "swirl.Tracks or swirl.Frames."
        )
    if isinstance(warmup, (bool, str)) or not hasattr(warmup, "__float__"):
        raise TypeError(f"warmup is {shown(warmup)}, but it must be a number of periods.")
    names, custom = split_measure(measure)
    is_all = measure == "all"
    reports, mean_by_time, rigid, used, remark = recording._frames.analyse(
        names, is_all, float(warmup)
    )
    source = _source_of(recording)
    found = measured_of(reports, source)
    if custom:
        blocks = CustomBlocks(custom)
        for begin, end in _periods(recording, warmup):
            blocks.period_ended(recording[begin:end])
        found.update(blocks.results(source))
    sources = frozenset((source,))
    no_events = Estimate(math.nan, unit="Ω", _sources=sources)
    rotation = Rotation(
        no_events,
        Estimate(*mean_by_time, unit="Ω", _sources=sources),
        no_events,
        Estimate(*rigid, unit="Ω", _sources=sources),
    )
    return Analysis(rotation, used, found, (remark,) if remark else ())


def _is_table(recording: object) -> bool:
    """True for a mapping or a DataFrame."""
    return (
        isinstance(recording, Mapping)
        or hasattr(recording, "columns")
        and hasattr(recording, "__getitem__")
    )


def _tracks_of(table: Any, camera: dict[str, Any]) -> Tracks:
    missing = [name for name in ("omega", "container_radius") if name not in camera]
    if missing:
        raise TypeError(
            f"a table of tracks needs {' and '.join(missing)}.\n"
            "hint: use swirl.analyse(table, omega=..., container_radius=...); help(swirl.Tracks) "
            "explains all arguments."
        )
    arguments = inspect.signature(Tracks).parameters
    unknown = next((name for name in camera if name not in arguments or name == "table"), None)
    if unknown is not None:
        raise TypeError(
            f"there is no argument '{_engine.shortened(unknown)}'.\n"
            f"hint: a table of tracks takes {', '.join(list(arguments)[1:])}."
        )
    return Tracks(table, **camera)


def _source_of(recording: Recording) -> str:
    """That of the run, or a name that every analysis of the same frames has."""
    if isinstance(recording, Trajectory) and recording.parameters:
        return source_of_run(recording.parameters)
    ends = [recording[k].position.tobytes().hex() for k in (0, -1)] if len(recording) else []
    return _engine.checksum(" ".join(ends))


def _periods(recording: Recording, warmup: float) -> Iterator[tuple[int, int]]:
    """First frame of each period, and the first frame after it."""
    begin, period = None, 0
    for k, snapshot in enumerate(recording):
        if snapshot.time < warmup * snapshot.period:
            continue
        if begin is None:
            begin, period = k, snapshot.whole_periods
        elif snapshot.whole_periods != period:
            yield begin, k
            begin, period = k, snapshot.whole_periods
    if begin is not None:
        yield begin, len(recording)
