"""One run, from its seed to its averages."""

from __future__ import annotations

import inspect
import os
import textwrap
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple, Optional, Protocol, Union

import numpy as np

from . import _engine
from ._results import ArrayEstimate, Estimate, Measured, Result, measured_of

PathName = Union[str, "os.PathLike[str]"]
#: Of a parameter: what the command line would be given; a tuple is one value of several parts.
Value = Union[float, int, str, tuple[Union[float, int, str], ...], None]
Told = Callable[[float, int, float], object]


class Parameter(NamedTuple):
    """A row of the table of parameters (docs/parameters.md)."""

    name: str
    symbol: str
    unit: str
    description: str
    default: str
    lowest: float
    highest: float
    group: str


class SamplesSnapshots(Protocol):
    """A measurement of your own that looks at every sample.

    What sample() returns (a number, an array, or a dict of such; None: nothing this time) is averaged
    over each swirl; mean and error come from these blocks.
    """

    def sample(self, snapshot: _engine.Snapshot) -> Any: ...


class TakesFrames(Protocol):
    """A measurement of your own that is handed the frames of a whole swirl at once.

    frames.position is [frame, disc, xy]; what is returned (a number, an array, or a dict of such) is
    the value of this swirl; mean and error come from these blocks.
    """

    def block(self, frames: _engine.Frames) -> Any: ...


OwnMeasurement = Union[SamplesSnapshots, TakesFrames, Callable[[_engine.Snapshot], Any]]
Measure = Union[str, Iterable[Union[str, OwnMeasurement]]]


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during a run; `result` is what it had found by then."""

    def __init__(self, result: Result) -> None:
        super().__init__("Stopped before the end of the run; what it had found is the `result`.")
        self.result = result


def parameters() -> list[Parameter]:
    """What a run can be given, with defaults, ranges and units; the paper's values by default."""
    return [Parameter(*row) for row in _engine.parameters()]


def measurements() -> dict[str, str]:
    """What can be measured besides the rotation: names, and what each is."""
    return {name: description for name, _, description in _engine.measurement_kinds()}


class OwnBlocks:
    """What the measurements of the caller have said, swirl by swirl."""

    def __init__(self, measurements: list[OwnMeasurement]) -> None:
        self._measurements = measurements
        self._names = [own_name(measurement) for measurement in measurements]
        self._blocks: dict[str, dict[str, list[tuple[Any, Any]]]] = {n: {} for n in self._names}
        for name in self._names:
            if self._names.count(name) > 1 or name in measurements_known():
                raise ValueError(f"measure has two measurements called '{name}'; an attribute "
                                 "`name` would tell them apart.")
        asked = {int(getattr(m, "samples_per_period", _engine.samples_per_period))
                 for m in measurements}
        if len(asked) > 1:
            raise ValueError("Measurements of one run must have the same samples_per_period, but "
                             f"these have {', '.join(map(str, sorted(asked)))}.")
        self.samples_per_period = asked.pop() if asked else _engine.samples_per_period
        if not 1 <= self.samples_per_period <= 1_000_000:
            raise ValueError(f"samples_per_period is {self.samples_per_period}, but it must be from "
                             "1 to 1000000.")

    def period_ended(self, frames: _engine.Frames) -> None:
        for name, measurement in zip(self._names, self._measurements):
            if hasattr(measurement, "block"):
                values = [measurement.block(frames)]
            else:
                look: Any = getattr(measurement, "sample", measurement)
                values = [look(frames[k]) for k in range(len(frames))]
            self._add(name, [value for value in values if value is not None])

    def _add(self, name: str, values: list[Any]) -> None:
        rows: dict[str, list[Any]] = {}
        for value in values:
            named = value if isinstance(value, Mapping) else {"value": value}
            for row, number in named.items():
                rows.setdefault(str(row), []).append(np.asarray(number, dtype=np.float64))
        for row, numbers in rows.items():
            known = self._blocks[name].get(row, [])
            shape = known[0][0].shape if known else numbers[0].shape
            if any(number.shape != shape for number in numbers):
                raise ValueError(f"'{name}' has returned arrays of different shapes.")
            stacked = np.stack(numbers)
            is_known = ~np.isnan(stacked)
            sums = np.where(is_known, stacked, 0.0).sum(axis=0)
            weights = is_known.sum(axis=0).astype(np.float64)
            self._blocks[name].setdefault(row, []).append((sums, weights))

    def found(self) -> dict[str, Measured]:
        return {name: Measured(name, {row: _estimate_of(blocks) for row, blocks in rows.items()}, {})
                for name, rows in self._blocks.items()}


def _estimate_of(blocks: list[tuple[Any, Any]]) -> Union[Estimate, ArrayEstimate]:
    sums, weights = (np.stack(column) for column in zip(*blocks))
    shape, n = sums.shape[1:], len(blocks)
    mean, error, effective = _engine.estimates(sums.reshape(n, -1), weights.reshape(n, -1))
    if shape == ():
        return Estimate(float(mean[0]), float(error[0]), float(effective[0]), n)
    return ArrayEstimate(mean.reshape(shape), error.reshape(shape), effective.reshape(shape), n)


def own_name(measurement: OwnMeasurement) -> str:
    for attribute in ("name", "__name__"):
        if isinstance(getattr(measurement, attribute, None), str):
            return str(getattr(measurement, attribute))
    return type(measurement).__name__


def measurements_known() -> set[str]:
    return {kind[0] for kind in _engine.measurement_kinds()}


def split_measure(measure: Optional[Measure]) -> tuple[list[str], list[OwnMeasurement]]:
    """Names of the list, and measurements of the caller's own."""
    if measure is None:
        return [], []
    if isinstance(measure, str):
        return (list(_engine.measurement_list(measure)) if measure else []), []
    if not isinstance(measure, Iterable):
        measure = [measure]
    names: list[str] = []
    own: list[OwnMeasurement] = []
    for each in measure:
        if isinstance(each, str):
            names += [name for name in _engine.measurement_list(each) if name not in names]
            continue
        if isinstance(each, type):
            each = each()
        if not (hasattr(each, "block") or hasattr(each, "sample") or callable(each)):
            raise TypeError(f"measure has {each!r} in its list, but each must be a name "
                            "(swirl.measurements() lists them) or have a method sample(snapshot) or "
                            "block(frames).")
        own.append(each)
    return names, own


def call_text(function: str, arguments: Mapping[str, object]) -> str:
    """As one would type it."""
    given = ", ".join(f"{name}={value!r}" for name, value in arguments.items() if value is not None)
    return f"swirl.{function}({given})"


class Progress:
    """A bar by tqdm where it is installed, or whatever the caller has."""

    def __init__(self, progress: Union[bool, Told, None], what: str) -> None:
        self._bar: Any = None
        self.told: Optional[Told] = None
        if callable(progress):
            self.told = progress
        elif progress:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                return
            self._bar = tqdm(total=1.0, desc=what, bar_format="{l_bar}{bar}| {elapsed}<{remaining}")
            self.told = self._show

    def _show(self, fraction: float, events: int, periods: float) -> None:
        self._bar.update(fraction - self._bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()


def run(*, measure: Optional[Measure] = None, progress: Union[bool, Told, None] = None,
        trajectory: Optional[PathName] = None, frames: Optional[int] = None,
        event_log: Optional[PathName] = None, checkpoint: Optional[PathName] = None,
        resume: bool = False, overwrite: bool = False, **parameters: Value) -> Result:
    names, own = split_measure(measure)
    blocks = OwnBlocks(own)
    files = _files(trajectory, frames, event_log, checkpoint, resume, overwrite)
    said = {**parameters, **({"measure": ",".join(names)} if names else {}), **files}
    bar = Progress(progress, "run")
    try:
        text, reports, raised, headline, report = _engine.run(
            parameters, names, call_text("run", said), bar.told, blocks.samples_per_period,
            blocks.period_ended if own else None, files)
    finally:
        bar.close()
    result = Result(text, {**measured_of(reports), **blocks.found()}, headline, report)
    if isinstance(raised, KeyboardInterrupt):
        raise Interrupted(result) from None
    if raised is not None:
        raise raised
    return result


def _files(trajectory: Optional[PathName], frames: Optional[int], event_log: Optional[PathName],
           checkpoint: Optional[PathName], resume: bool, overwrite: bool) -> dict[str, Any]:
    files: dict[str, Any] = {name: os.fspath(path) for name, path in
                             (("trajectory", trajectory), ("event_log", event_log),
                              ("checkpoint", checkpoint)) if path is not None}
    if frames is not None:
        if trajectory is None:
            raise ValueError("frames is given, but there is no trajectory to put them into.")
        if not isinstance(frames, int) or not 1 <= frames <= 1_000_000:
            raise ValueError(f"frames is {frames!r}, but it must be a whole number per swirl from 1 "
                             "to 1000000.")
        files["frames"] = frames
    if resume and checkpoint is None:
        raise ValueError("resume needs the checkpoint to go on from.")
    if resume:
        files["resume"] = True
    if overwrite:
        files["overwrite"] = True
    goes_on = resume and checkpoint is not None and os.path.exists(checkpoint)
    if not overwrite and not goes_on:
        for path in (checkpoint, trajectory, event_log):
            if path is not None and os.path.exists(path) and os.path.getsize(path) > 0:
                raise FileExistsError(f"'{os.fspath(path)}' is there already; choose another name, or "
                                      "give overwrite=True to lose it.")
    return files


def parameter_lines() -> str:
    """A line or two for each, for the documentation of functions that take them."""
    lines = []
    for p in parameters():
        default = f" [{p.default}]" if p.default else ""
        unit = f", in units of {p.unit}" if p.unit else ""
        lines += textwrap.wrap(f"{p.name}: {p.description}{unit}{default}", 96,
                               initial_indent="    ", subsequent_indent="        ")
    return "\n".join(lines)


def with_parameters(function: Callable[..., Any], text: str) -> None:
    """Gives a function that takes **parameters its documentation, and the names to whoever completes
    them."""
    function.__doc__ = f"{text}\nParameters (docs/parameters.md), the paper's values by default:\n\n" \
                       f"{parameter_lines()}\n"
    signature = inspect.signature(function)
    kept = [p for p in signature.parameters.values() if p.kind != p.VAR_KEYWORD]
    taken = {p.name for p in kept}
    first = [inspect.Parameter(p.name, inspect.Parameter.KEYWORD_ONLY, default=None)
             for p in parameters() if p.name not in taken]
    before = [p for p in kept if p.kind != p.KEYWORD_ONLY]
    after = [p for p in kept if p.kind == p.KEYWORD_ONLY]
    function.__signature__ = signature.replace(  # type: ignore[attr-defined]
        parameters=before + first + after)


with_parameters(run, """One simulation, from its seed to its averages: `swirl run`, in this process.

    r = swirl.run(discs=48, mu=1, events=1e6, measure=["density", "pinned"])
    r.rotation.by_time.mean, r.rotation.by_time.error
    r.measured["density"]["by_time"]            # numpy, [y, x]
    r.state_hash

measure: names (swirl.measurements()), "all", and measurements of your own: objects with a method
    sample(snapshot), called 511 times in every swirl after the warm-up, or block(frames), called once
    with all of them.
progress: True for a bar (with tqdm), or a function of (fraction, events, swirls).
trajectory, frames, event_log, checkpoint, resume, overwrite: files, as for `swirl run`; frames are
    per swirl [30].

The bits are those of the command line. Other threads of Python go on meanwhile. Ctrl-C raises
swirl.Interrupted, a KeyboardInterrupt whose `result` is what was found by then. A wrong value raises
ValueError, a wrong name or type TypeError, a run that cannot be done swirl.Failure.
""")
