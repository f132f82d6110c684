"""A dish, event by event."""

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
from ._results import EventCounts, write_aside
from ._runs import PathName, Value, call_text, with_parameters

Array = npt.ArrayLike
_columns = ("position", "velocity", "angle", "spin", "radius", "mass", "inertia")


class EventKind(enum.IntEnum):
    """What an event is; `Event.kind` and the column `kind` of events are these."""

    disc_disc = 0
    disc_wall = 1
    path_vertex = 2
    begins_to_roll = 3


def _is_array(value: object) -> bool:
    return not isinstance(value, (str, tuple, int, float)) and hasattr(value, "__len__")


class Simulation:
    def __init__(self, *, position: Optional[Array] = None, velocity: Optional[Array] = None,
                 angle: Optional[Array] = None, spin: Optional[Array] = None,
                 path: Union[str, Array, None] = None, path_times: Optional[Array] = None,
                 **parameters: Any) -> None:
        given = {"position": position, "velocity": velocity, "angle": angle, "spin": spin}
        discs = {name: values for name, values in given.items() if values is not None}
        for name in ("radius", "mass", "inertia"):
            if name in parameters and _is_array(parameters[name]):
                discs[name] = parameters.pop(name)
        if discs and position is None:
            raise ValueError(f"{next(iter(discs))} is given for each disc, but not their position.")
        columns = {name: _floats(name, values) for name, values in discs.items()}
        for name in ("discs", "mixture"):
            if columns and parameters.get(name) is not None:
                raise ValueError(f"{name} is given, but the discs are those of position; leave one of "
                                 "the two away.")
        own_path = None
        if path is not None and not isinstance(path, str):
            own_path = _floats("path", path)
            for name in ("amplitude", "sides", "speed"):
                if parameters.get(name) is not None:
                    raise ValueError(f"{name} is given, but the path has its own; leave one of the "
                                     "two away.")
        elif path is not None:
            parameters["path"] = path
        for name in ("events", "periods", "warmup"):
            if parameters.get(name) is not None:
                raise TypeError(f"{name} is given, but a simulation goes on for as long as it is "
                                "asked to; swirl.run() takes it.")
        times = None if path_times is None else _floats("path_times", path_times)
        self._dish = _engine.Dish(parameters, columns, own_path, times)

    # --- going on -----------------------------------------------------------------------------

    def step(self, count: int = 1) -> npt.NDArray[np.void]:
        """Executes `count` events; returns them as a structured array, one row each.

        Columns: swirls and clock (when: whole periods, and the time since the last of them), time,
        kind (EventKind), i and j (the discs; j = i at the wall), normal_x and normal_y (from i to j,
        or to the wall), normal_impulse and tangential_impulse (on j, or on the wall), overlap (a
        rounding error). Ctrl-C leaves the simulation behind the last event that was executed.
        """
        return self._dish.step(_whole("count", count))

    def events(self, count: Optional[int] = None) -> Iterator[_engine.Event]:
        """Executes events one by one; the simulation can be looked at in between. Without a count it
        does not end."""
        left = math.inf if count is None else _whole("count", count)
        while left > 0:
            yield self._dish.next()
            left -= 1

    def advance(self, *, periods: Optional[float] = None, time: Optional[float] = None,
                events: Optional[float] = None) -> None:
        """Goes on for so many swirls, so much time, or so many events, and stands there.

        Where one stops to look never changes a bit of what comes after.
        """
        given = [value for value in (periods, time, events) if value is not None]
        if len(given) != 1:
            raise TypeError("advance() takes one of periods, time and events.")
        if events is not None:
            self._dish.run(_whole("events", events))
            return
        name, value = ("periods", periods) if periods is not None else ("time", time)
        length = _number(name, value)
        if not 0.0 <= length <= 1e15:
            raise ValueError(f"{name} is {length}, but it must be a number from 0 to 1e15.")
        if periods is not None and length == math.floor(length):
            # Exactly a period later, with no rounding.
            swirls, clock = self._dish.now()
            self._dish.advance_to(swirls + int(length), clock)
        else:
            self._dish.advance(length * self.period if periods is not None else length)

    def advance_to(self, swirls: int, clock: float = 0.0) -> None:
        """Goes on up to a moment: whole swirls, and the time since."""
        self._dish.advance_to(_whole("swirls", swirls), _number("clock", clock))

    def sample(self, periods: float = 1.0, per_period: int = _engine.samples_per_period
               ) -> _engine.Frames:
        """Goes on for so many swirls and looks at equal steps of time, `per_period` in each.

        The first frame is of now; the simulation stands where the next one would be. All columns are
        numpy arrays: frames.position is [frame, disc, xy].
        """
        n = _whole("per_period", per_period)
        if not 1 <= n <= 1_000_000:
            raise ValueError(f"per_period is {n}, but it must be from 1 to 1000000.")
        count = _number("periods", periods) * n
        if not count >= 0:
            raise ValueError(f"periods is {periods}, but it must be a number from 0 on.")
        if not count * len(self) <= 1e8:
            raise ValueError(f"periods is {periods}, which makes {count:g} frames of {len(self)} discs; "
                             "fewer would be right.")
        return self._dish.sample(round(count), n)

    # --- looking ------------------------------------------------------------------------------

    def snapshot(self) -> _engine.Snapshot:
        """All discs and the container, now. It stays what it is when the simulation goes on."""
        return self._dish.snapshot()

    @property
    def swirls(self) -> int:
        """Whole periods since the beginning."""
        return self._dish.now()[0]

    @property
    def clock(self) -> float:
        """The time since the last whole period."""
        return self._dish.now()[1]

    @property
    def time(self) -> float:
        """The time since the beginning."""
        swirls, clock = self._dish.now()
        return swirls * self.period + clock

    @property
    def periods(self) -> float:
        """The same in swirls."""
        swirls, clock = self._dish.now()
        return swirls + clock / self.period

    @property
    def counts(self) -> EventCounts:
        """How many events of each kind so far."""
        discs, wall, vertex, elastic, rolls = self._dish.counts()
        return EventCounts(discs + wall + vertex + rolls, discs, wall, vertex, elastic, rolls)

    @property
    def state_hash(self) -> str:
        """64 bits of every disc's state: equal states, equal hash, on every machine."""
        return self._dish.state_hash()

    @property
    def period(self) -> float:
        return self._dish.period

    @property
    def omega(self) -> float:
        """Ω, the angular velocity of the swirl."""
        return 2.0 * math.pi / self.period

    @property
    def container_radius(self) -> float:
        return self._dish.container_radius

    @property
    def config(self) -> dict[str, Any]:
        """Every parameter, resolved. Discs and a path of one's own are not in it."""
        return dict(json.loads(self._dish.config()))

    def container_path(self) -> npt.NDArray[np.float64]:
        """Where the container's centre goes: rows of time, x and y at the beginning of each leg."""
        return np.array(self._dish.path()).reshape(-1, 3)

    def __len__(self) -> int:
        return len(self._dish)

    def __repr__(self) -> str:
        return (f"<swirl.Simulation of {len(self)} discs after {self.periods:.3f} swirls and "
                f"{self.counts.total:,} events>")

    def _repr_svg_(self) -> str:
        return str(self.snapshot()._repr_svg_())

    # --- keeping ------------------------------------------------------------------------------

    def save(self, file: PathName) -> None:
        """Everything that it takes to go on with the same bits; swirl.load() reads it."""
        write_aside(file, self._dish.archive())

    @classmethod
    def _of_archive(cls, archive: bytes) -> "Simulation":
        simulation = cls.__new__(cls)
        simulation._dish = _engine.Dish.of_archive(archive)
        return simulation

    def __reduce__(self) -> Any:
        return type(self)._of_archive, (self._dish.archive(),)


def load(file: PathName) -> Simulation:
    """A simulation that was saved."""
    with open(file, "rb") as opened:
        archive = opened.read()
    try:
        return Simulation._of_archive(archive)
    except _engine.FileError as error:
        raise _engine.FileError(f"'{os.fspath(file)}': {error}") from None


def _number(name: str, value: object) -> float:
    if isinstance(value, (bool, str)) or not hasattr(value, "__float__"):
        raise TypeError(f"{name} is {value!r}, but it must be a number.")
    number = float(value)
    if not math.isfinite(number):
        raise ValueError(f"{name} is {number}, but it must be a finite number.")
    return number


def _whole(name: str, value: object) -> int:
    number = _number(name, value)
    if number != math.floor(number) or not 0 <= number <= 2**53:
        raise ValueError(f"{name} is {value!r}, but it must be a whole number from 0 to 2^53.")
    return int(number)


def _floats(name: str, values: Array) -> npt.NDArray[np.float64]:
    """A copy: what the caller does with his own later does not matter."""
    try:
        array = np.asarray(values)
        if array.dtype.kind not in "iuf":
            raise TypeError
        return np.array(array, dtype=np.float64, order="C")
    except (TypeError, ValueError):
        raise TypeError(f"{name} must be an array of numbers.") from None


with_parameters(Simulation.__init__, """A simulation that goes on as long as it is asked to.

    sim = swirl.Simulation(discs=48, seed=3)
    for event in sim.events(1000): ...
    sim.advance(periods=2.5)
    sim.snapshot().position                     # numpy, [disc, xy], read-only
    frames = sim.sample(periods=10)             # frames.position: [frame, disc, xy]

position, velocity, angle, spin: discs of your own, in the lab frame: the swirl centre is the origin,
    and the container begins at the first vertex of its path, (amplitude, 0). radius, mass and inertia
    may then be arrays too. Without velocities they begin at rest in the container.
path: "polygon", "circle", or vertices of your own (N × 2, closed), which the container's centre runs
    through in one period at constant speed, or at path_times, which begin with 0.

It can be copied, pickled and saved; copies go on independently with the same bits. Several threads
may use different simulations at the same time, and one, in turns.
""")
Simulation.__doc__ = Simulation.__init__.__doc__
