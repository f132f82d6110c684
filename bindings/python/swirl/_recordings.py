"""What was recorded: trajectories of runs, and a camera's tracks."""

from __future__ import annotations

import dataclasses
import json
import math
import os
import pathlib
from collections.abc import Iterator, Mapping
from typing import Any, Optional, Union, overload

import numpy as np

from . import _engine
from ._results import Estimate, Measured, Rotation, measured_of
from ._runs import Measure, OwnBlocks, PathName, split_measure


class Recording:
    """Frames that are read when they are asked for.

    `len(recording)`, `recording[k]` (a Snapshot), `recording[10:200:5]` (Frames), iteration.
    """

    _frames: _engine.Recording

    def __len__(self) -> int:
        return len(self._frames)

    @overload
    def __getitem__(self, k: int) -> _engine.Snapshot: ...
    @overload
    def __getitem__(self, k: slice) -> _engine.Frames: ...

    def __getitem__(self, k: Union[int, slice]) -> Union[_engine.Snapshot, _engine.Frames]:
        if isinstance(k, slice):
            begin, end, step = k.indices(len(self))
            if step < 1:
                raise ValueError(f"The step is {step}, but frames go forward: 1 is the least.")
            return self._frames.frames(begin, max(begin, end), step)
        if isinstance(k, bool) or not hasattr(k, "__index__"):
            raise TypeError(f"Frames have whole numbers, not {k!r}.")
        number = k.__index__()
        if not -len(self) <= number < len(self):
            raise IndexError(f"Frame {number} is asked for, but there are {len(self)}.")
        number %= len(self)
        return self._frames.frames(number, number + 1, 1)[0]

    def __iter__(self) -> Iterator[_engine.Snapshot]:
        for k in range(len(self)):
            yield self[k]

    @property
    def same_discs(self) -> bool:
        """Every frame holds the same discs in the same order."""
        return self._frames.same_discs


class Trajectory(Recording):
    """A recording of `swirl run --trajectory`, or of swirl.run(trajectory=…); finished or not.

        t = swirl.Trajectory("frames.h5")
        t[0].position, t[10:20].position, t.parameters, t.complete
    """

    def __init__(self, file: PathName) -> None:
        self.file = os.fspath(file)
        self._frames = _engine.Recording.open(self.file)

    @property
    def complete(self) -> bool:
        """False: the run was stopped, or still goes on."""
        return self._frames.complete

    @property
    def provenance(self) -> dict[str, str]:
        """Who made the file, from what: version, command, configuration, seed, …"""
        return self._frames.about()

    @property
    def parameters(self) -> dict[str, Any]:
        """The parameters of the run, resolved."""
        return dict(json.loads(self.provenance.get("parameters", "{}")))

    def __repr__(self) -> str:
        return f"<swirl.Trajectory '{self.file}': {len(self)} frames>"


class Tracks(Recording):
    """What a camera saw: a table of trackpy (columns frame, particle, x, y; pixels, y downwards).

    table: a pandas DataFrame, or anything with such columns. omega: angular velocity of the swirl, in
    radians per unit of time. container_radius and amplitude: in disc radii. scale: pixels per disc
    radius. camera_fps: frames per unit of time. centre: the swirl centre, in pixels. phase: of the
    container at frame 0, in degrees counter-clockwise from the right, as the camera saw it. clockwise:
    the swirl ran clockwise in the picture.

    misfit: the share of frames that may show discs outside the dish or in each other; where more do,
    swirl.Failure says which of the above is likely to be wrong. `remarks` says what does not quite fit,
    what was mended, and what noise was found.

    Short gaps are filled. Places are smoothed by the noise that they show, and velocities come of that
    (src/swirl/io/track_smoothing.hpp); where frames are fewer than a hundred per swirl, places stay as they
    are and velocities are differences between frames (src/swirl/io/tracks.hpp).
    """

    def __init__(self, table: Any, *, omega: float, container_radius: float, amplitude: float = 0.0,
                 camera_fps: float = 1.0, scale: float = 1.0,
                 centre: tuple[float, float] = (0.0, 0.0), phase: float = 0.0,
                 clockwise: bool = False, misfit: float = 0.05) -> None:
        for name, value, least in (("omega", omega, 1e-12), ("container_radius", container_radius, 1e-12),
                                   ("amplitude", amplitude, 0.0), ("camera_fps", camera_fps, 1e-12),
                                   ("scale", scale, 1e-12), ("phase", phase, -1e9),
                                   ("misfit", misfit, 0.0)):
            if isinstance(value, bool) or not hasattr(value, "__float__"):
                raise TypeError(f"{name} is {value!r}, but it must be a number.")
            if not least <= float(value) < math.inf:
                raise ValueError(f"{name} is {value}, but it must be a number of at least {least:g}.")
        try:
            columns = {name: np.asarray(table[name]) for name in ("frame", "particle", "x", "y")}
        except (KeyError, IndexError, ValueError):
            raise ValueError("The tracks need columns frame, particle, x and y.") from None
        for name, column in columns.items():
            if column.dtype.kind not in "iuf" or column.ndim != 1:
                raise TypeError(f"The column {name} of the tracks must be numbers.")
        for name in ("frame", "particle"):
            if np.any(columns[name] != np.floor(columns[name])):
                raise ValueError(f"The column {name} of the tracks must be whole numbers.")
        x0, y0 = (float(part) for part in centre)
        if not (math.isfinite(x0) and math.isfinite(y0)):
            raise ValueError(f"centre is {centre}, but it must be two finite numbers.")
        radius = np.asarray(table["radius"], float) if _of_our_tracker(table) else np.empty(0)
        order = np.lexsort((columns["particle"], columns["frame"]))
        self._frames = _engine.Recording.tracks(
            columns["frame"][order], columns["particle"][order], columns["x"][order],
            columns["y"][order], radius[order] if radius.size else radius,
            {"omega": float(omega), "container_radius": float(container_radius),
             "amplitude": float(amplitude), "camera_fps": float(camera_fps), "scale": float(scale),
             "phase": float(phase), "centre_x": x0, "centre_y": y0, "clockwise": bool(clockwise)},
            float(misfit))

    @classmethod
    def read(cls, file: PathName, **scale: Any) -> "Tracks":
        """From a table of trackpy as CSV. What is not given is taken from NAME.camera.json beside
        NAME.csv, as `swirl track` writes it."""
        import pandas
        header = pandas.read_csv(file, header=None, nrows=1, dtype=str).iloc[0]
        for name in ("frame", "particle", "x", "y", "seen", "radius"):
            if (header == name).sum() > 1:
                raise _engine.Failure(f"'{file}' has two columns {name!r}.")
        beside = pathlib.Path(file).with_suffix(".camera.json")
        if beside.is_file():
            scale = {**_camera(beside), **scale}
        return cls(pandas.read_csv(file, float_precision="round_trip"), **scale)

    @property
    def remarks(self) -> list[str]:
        """Repairs of the tracks, the noise of the positions, and what does not quite fit the container."""
        return self._frames.remarks.splitlines()

    def __repr__(self) -> str:
        return f"<swirl.Tracks: {len(self)} frames>"


def _of_our_tracker(table: Any) -> bool:
    """Its radii are those of the discs; other trackers call something else so."""
    names = getattr(table, "columns", ())
    return "seen" in names and "radius" in names


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    if len(dict(pairs)) < len(pairs):
        raise ValueError("a name appears twice")
    return dict(pairs)


def _camera(file: pathlib.Path) -> dict[str, Any]:
    """What was found of the dish, as arguments of Tracks. Every field must be there, once and of its
    type, as `swirl measure` has it: a field that is skipped would leave its default."""
    numbers = ("omega", "container_radius", "amplitude", "camera_fps", "scale", "phase")
    try:
        found = json.loads(file.read_text(), object_pairs_hook=_unique)["camera"]
        camera = {argument: found[argument.replace("_", "-")]
                  for argument in (*numbers, "centre", "clockwise")}
        for name in numbers:
            if type(camera[name]) not in (int, float):
                raise TypeError(f"{name} is {camera[name]!r}, but it must be a number")
        centre = camera["centre"]
        if type(centre) is not list or [type(part) in (int, float) for part in centre] != [True, True]:
            raise TypeError(f"centre is {centre!r}, but it must be two numbers")
        if type(camera["clockwise"]) is not bool:
            raise TypeError(f"clockwise is {camera['clockwise']!r}, but it must be true or false")
        return camera
    except (ValueError, KeyError, TypeError) as wrong:
        raise _engine.Failure(f"'{file}' is not what `swirl track` writes beside its tracks: {wrong}. "
                              "Remove it, or track the film again.") from None


@dataclasses.dataclass(frozen=True)
class Analysis:
    """What was seen in a recording: the rotation and the measurements, named as in Result.

    `rotation.by_time` and `rotation.rigid_by_time` are averages over the frames. A recording has no
    events, so the averages by event are NaN.
    """

    rotation: Rotation
    frames: int
    measured: Mapping[str, Measured]


class _Sampled(Recording):
    """Frames that are there already."""

    def __init__(self, frames: _engine.Frames) -> None:
        self._frames = _engine.Recording.of_frames(frames)


def analyse(recording: Union[Recording, _engine.Frames], measure: Optional[Measure] = None, *,
            skip: float = 0.0) -> Analysis:
    """The measurements of a run on recorded frames: `swirl measure`.

    recording: a Trajectory, Tracks, or frames that a Simulation has sampled; with these, dishes with
    discs and paths of your own are measured like others.

    measure: as for swirl.run(); "all" is all that frames can tell. skip: swirls at the start that do
    not count. The frames of one swirl are a block, from which the errors come.
    """
    if isinstance(recording, _engine.Frames):
        recording = _Sampled(recording)
    if not isinstance(recording, Recording):
        raise TypeError(f"{recording!r} is no recording; swirl.Trajectory, swirl.Tracks and "
                        "Simulation.sample() are.")
    if isinstance(skip, (bool, str)) or not hasattr(skip, "__float__"):
        raise TypeError(f"skip is {skip!r}, but it must be a number of swirls.")
    names, own = split_measure(measure)
    is_all = measure == "all"
    reports, by_time, rigid, used = recording._frames.analyse(names, is_all, float(skip))
    found = measured_of(reports)
    if own:
        blocks = OwnBlocks(own)
        for begin, end in _swirls(recording, skip):
            blocks.period_ended(recording[begin:end])
        found.update(blocks.found())
    no_events = Estimate(math.nan, unit="Ω")
    rotation = Rotation(no_events, Estimate(*by_time, unit="Ω"), no_events,
                        Estimate(*rigid, unit="Ω"))
    return Analysis(rotation, used, found)


def _swirls(recording: Recording, skip: float) -> Iterator[tuple[int, int]]:
    """First and last frame of each swirl."""
    begin, swirl = None, 0
    for k, seen in enumerate(recording):
        if seen.time < skip * seen.period:
            continue
        if begin is None:
            begin, swirl = k, seen.swirls
        elif seen.swirls != swirl:
            yield begin, k
            begin, swirl = k, seen.swirls
    if begin is not None:
        yield begin, len(recording)
