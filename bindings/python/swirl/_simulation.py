"""A simulation, event by event."""

from __future__ import annotations

import enum
import json
import math
import os
from collections.abc import Iterator
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _engine
from ._arguments import file_name, shown
from ._lab import Lab, lab, parameters_of
from ._results import EventCounts, write_atomically
from ._runs import PathName, Value, call_text, with_parameters

Array = npt.ArrayLike
_columns = ("position", "velocity", "angle", "spin", "radius", "mass", "inertia", "cannot_spin")


class EventKind(enum.IntEnum):
    """Kinds of events: values of `Event.kind` and of the column `kind` of event arrays."""

    disc_disc = 0
    disc_wall = 1
    path_vertex = 2
    begins_to_roll = 3


def _is_array(value: object) -> bool:
    return not isinstance(value, (str, tuple, int, float)) and hasattr(value, "__len__")


class Simulation:
    __slots__ = ("_engine", "__weakref__")

    def __init__(
        self,
        *,
        position: Optional[Array] = None,
        velocity: Optional[Array] = None,
        angle: Optional[Array] = None,
        spin: Optional[Array] = None,
        motion: Union[str, Array, None] = None,
        motion_times: Optional[Array] = None,
        **parameters: Any,
    ) -> None:
        given = {"position": position, "velocity": velocity, "angle": angle, "spin": spin}
        discs = {name: values for name, values in given.items() if values is not None}
        for name in ("radius", "mass", "inertia", "cannot_spin"):
            if name in parameters and _is_array(parameters[name]):
                discs[name] = parameters.pop(name)
        if discs and position is None:
            raise ValueError(f"{next(iter(discs))} is given for each disc, but position is not.")
        columns = {name: _floats(name, values) for name, values in discs.items()}
        for name in ("discs", "mixture", "sizes", "initial"):
            if columns and parameters.get(name) is not None:
                raise ValueError(f"{name} and position are both given, but both define the discs.")
        custom_path = None
        if motion is None:
            motion = parameters.pop("path", None)  # its key in results
        if motion is not None and not isinstance(motion, str) and np.shape(motion)[1:] == (3,):
            if motion_times is not None:
                raise ValueError("motion_times is given, but motion has a column of times.")
            parameters["motion"] = _floats("motion", motion)
        elif motion is not None and not isinstance(motion, str):
            custom_path = _floats("motion", motion)
            for name in ("amplitude", "sides", "speed"):
                if parameters.get(name) is not None:
                    raise ValueError(
                        f"{name} and a custom motion are both given, but both define the path."
                    )
        elif motion is not None:
            parameters["motion"] = motion
        for name in ("events", "periods", "warmup"):
            if parameters.get(name) is not None:
                raise TypeError(
                    f"{name} is given, but a simulation has no fixed length.\n"
                    "hint: use swirl.run(), or advance() of the simulation."
                )
        times = None if motion_times is None else _floats("motion_times", motion_times)
        self._engine = _engine.Simulation(parameters, columns, custom_path, times)

    # --- advancing ----------------------------------------------------------------------------

    def step(self, count: int = 1) -> npt.NDArray[np.void]:
        """Executes `count` events and returns them as a structured array with one row per event.

        Columns of time: whole_periods, clock (the time since the last whole period) and time.
        Columns of the contact: kind (EventKind), i and j (the discs; j = i at the wall), normal_x
        and normal_y (unit vector from i to j, or to the wall), and overlap (a rounding error).
        Columns of the impulse on j or on the wall: normal_impulse and tangential_impulse. After
        Ctrl-C the simulation is at the last executed event."""
        return self._engine.step(_whole("count", count))

    def events(self, count: Optional[int] = None) -> Iterator[_engine.Event]:
        """Executes and yields events one by one, without end if there is no `count`. The simulation
        can be inspected after each event."""
        remaining = math.inf if count is None else _whole("count", count)
        while remaining > 0:
            yield self._engine.next()
            remaining -= 1

    def advance(
        self,
        *,
        periods: Optional[float] = None,
        time: Optional[float] = None,
        events: Optional[float] = None,
    ) -> None:
        """Advances by a number of periods, a time, or a number of events: give one of them.

        Stopping in between does not alter the trajectory; it stays bitwise identical.
        """
        given = [value for value in (periods, time, events) if value is not None]
        if len(given) != 1:
            raise TypeError("advance() takes exactly one of periods, time and events.")
        if events is not None:
            self._engine.run(_whole("events", events))
            return
        name, value = ("periods", periods) if periods is not None else ("time", time)
        length = _number(name, value)
        if not 0.0 <= length <= 1e15:
            raise ValueError(f"{name} is {length}, but it must be a number from 0 to 1e15.")
        if periods is not None and length == math.floor(length):
            # Whole periods later, without rounding.
            whole_periods, clock = self._engine.now()
            self._engine.advance_to(whole_periods + int(length), clock)
        else:
            (self._engine.advance if periods is None else self._engine.advance_periods)(length)

    def advance_to(self, whole_periods: int, clock: float = 0.0) -> None:
        """Advances to a time: whole periods since the start, and the time since then. Raises
        ValueError for a time in the past."""
        self._engine.advance_to(_whole("whole_periods", whole_periods), _number("clock", clock))

    def sample(
        self, periods: float = 1.0, per_period: int = _engine.samples_per_period
    ) -> _engine.Frames:
        """Advances by `periods` and returns frames at equal time steps, `per_period` in each
        period.

        The first frame is the present state; the simulation ends where the next frame would be. All
        columns are numpy arrays: frames.position is [frame, disc, xy].
        """
        n = _whole("per_period", per_period)
        if not 1 <= n <= 1_000_000:
            raise ValueError(f"per_period is {n}, but it must be from 1 to 1000000.")
        count = _number("periods", periods) * n
        if not count >= 0:
            raise ValueError(f"periods is {periods}, but it must be 0 or more.")
        if not count * len(self) <= 1e8:
            raise ValueError(
                f"periods is {periods}, but {count:g} frames of {len(self)} discs do not "
                "fit into memory.\nhint: reduce periods or per_period."
            )
        return self._engine.sample(round(count), n)

    # --- inspecting ---------------------------------------------------------------------------

    def snapshot(self) -> _engine.Snapshot:
        """All discs and the container now. The snapshot does not change when the simulation
        advances."""
        return self._engine.snapshot()

    @property
    def whole_periods(self) -> int:
        """Whole periods since the start."""
        return self._engine.now()[0]

    @property
    def clock(self) -> float:
        """The time since the last whole period."""
        return self._engine.now()[1]

    @property
    def time(self) -> float:
        """The time since the start."""
        return self._engine.time

    @property
    def periods(self) -> float:
        """The time since the start in periods."""
        whole_periods, clock = self._engine.now()
        return whole_periods + clock / self.period

    @property
    def counts(self) -> EventCounts:
        """Number of events of each kind so far."""
        discs, wall, vertex, elastic, rolls = self._engine.counts()
        return EventCounts(discs + wall + vertex + rolls, discs, wall, vertex, elastic, rolls)

    @property
    def state_hash(self) -> str:
        """64-bit hash of the state as 16 hexadecimal digits. Equal states have equal hashes on
        every machine."""
        return self._engine.state_hash()

    @property
    def period(self) -> float:
        """The present length of a period, T."""
        return self._engine.period

    @property
    def omega(self) -> float:
        """Ω, the angular velocity of the swirl."""
        return 2.0 * math.pi / self.period

    @property
    def container_radius(self) -> float:
        return self._engine.container_radius

    @property
    def config(self) -> dict[str, Any]:
        """All resolved parameters. Custom discs and a custom path are not included."""
        return dict(json.loads(self._engine.config()))

    def container_path(self) -> npt.NDArray[np.float64]:
        """The path of the container's centre: time, x and y at the beginning of each segment,
        [segment, 3]."""
        return np.array(self._engine.path()).reshape(-1, 3)

    def __len__(self) -> int:
        return len(self._engine)

    def __repr__(self) -> str:
        return (
            f"<swirl.Simulation of {len(self)} discs after {self.periods:.3f} periods and "
            f"{self.counts.total:,} events>"
        )

    def _repr_svg_(self) -> str:
        return str(self.snapshot()._repr_svg_())

    def show(
        self, *, page: Optional[PathName] = None, height: int = 640, lang: Optional[str] = None
    ) -> Lab:
        """Shows the browser page with the parameters of this simulation in a notebook. It begins at
        time 0.

        page, height, lang: as for swirl.lab(). Raises ValueError for custom discs or a custom path,
        which the page cannot place."""
        if self._engine.is_custom:
            raise ValueError(
                "the page places the discs by the parameters, but this simulation has discs or a "
                "path of its own.\nhint: plot() draws the discs."
            )
        return lab(page=page, height=height, lang=lang, dish=False, **parameters_of(self.config))

    def plot(self, *, ax: Any = None, **style: Any) -> Any:
        """Draws the discs; returns the axes. `style` is that of swirl.plot.snapshot()."""
        from . import plot

        return plot.snapshot(self, ax=ax, **style)

    # --- saving -------------------------------------------------------------------------------

    def save(self, file: PathName) -> None:
        """Writes the simulation to a file for swirl.load(), which continues bitwise identically."""
        write_atomically(file, self._engine.to_bytes())

    @classmethod
    def _from_bytes(cls, data: bytes) -> "Simulation":
        simulation = cls.__new__(cls)
        simulation._engine = _engine.Simulation.from_bytes(data)
        return simulation

    def __reduce__(self) -> Any:
        return type(self)._from_bytes, (self._engine.to_bytes(),)


def load(file: PathName) -> Simulation:
    """Reads a simulation written by Simulation.save(). Raises FileError for an invalid file."""
    name = file_name("file", file)
    with open(name, "rb") as opened:
        data = opened.read()
    try:
        return Simulation._from_bytes(data)
    except _engine.FileError as error:
        raise _engine.FileError(f"'{name}': {error}") from None


def _number(name: str, value: object) -> float:
    if isinstance(value, (bool, str)) or not hasattr(value, "__float__"):
        raise TypeError(f"{name} is {shown(value)}, but it must be a number.")
    number = float(value)
    if not math.isfinite(number):
        raise ValueError(f"{name} is {number}, but it must be a finite number.")
    return number


def _whole(name: str, value: object) -> int:
    number = _number(name, value)
    if number != math.floor(number) or not 0 <= number <= 2**53:
        raise ValueError(f"{name} is {shown(value)}, but it must be a whole number from 0 to 2^53.")
    return int(number)


def _floats(name: str, values: Array) -> npt.NDArray[np.float64]:
    """A copy, so that the caller may change the original later."""
    try:
        array = np.asarray(values)
        if array.dtype.kind not in "iuf":
            raise TypeError
        return np.array(array, dtype=np.float64, order="C")
    except (TypeError, ValueError):
        raise TypeError(f"{name} must be an array of numbers.") from None


with_parameters(
    Simulation.__init__,
    """A simulation that advances step by step.

    sim = swirl.Simulation(discs=48, seed=3)
    for event in sim.events(1000): ...
    sim.advance(periods=2.5)
    sim.snapshot().position                     # numpy, [disc, xy], read-only
    frames = sim.sample(periods=10)             # frames.position: [frame, disc, xy]

position [disc, xy], velocity [disc, xy], angle [disc], spin [disc]: custom discs in the lab frame. The
    swirl centre is the origin, and the container starts at the first vertex of its path,
    (amplitude, 0). radius, mass, inertia and cannot_spin (0 or 1) may then be arrays [disc]. Without velocities discs start
    at rest relative to the container. If radius is an array and mass is not given, all discs consist
    of one material: mass ~ radius², and a disc of radius 1 has the mass 1.
motion: a shape ("circle", "ellipse:0.5", "lissajous:2:3"), a CSV file, or an array of a closed path: with
    the columns t, x and y, one row per point, the last row equal to the first at the end of the
    period; or vertices [vertex, xy] of a closed polygon. Through the latter the container's centre
    runs in one period at constant speed, or is at each vertex at its time in motion_times [vertex],
    which begin with 0.
sizes: a distribution ("normal:1:0.1", "file:sizes.csv") or an array, radius [disc] or the columns
    radius and mass. Masses that are not given follow from one material: mass ~ radius² for discs,
    radius³ for spheres.

ramp: "mu=0.1:1@20..220" changes parameters at the start of periods, as in swirl.run(). However the
    simulation is advanced, it stays bitwise identical to that run.

A simulation can be copied, pickled and saved; copies continue independently and bitwise identically.
Several threads may use different simulations at the same time. Calls of several threads to one
simulation wait for each other. After a fork during a call, the child cannot use the simulation: it raises
swirl.Failure. A value out of range, or an overlap of discs, raises ValueError, and a collapse swirl.Failure.
""",
)
Simulation.__doc__ = Simulation.__init__.__doc__
