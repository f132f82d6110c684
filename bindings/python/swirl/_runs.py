"""One run, from its seed to its averages, and custom measurements."""

from __future__ import annotations

import inspect
import json
import os
import textwrap
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple, Optional, Protocol, Union

import numpy as np

from . import _engine
from ._arguments import file_name, shown, text
from ._files import exists
from ._estimates import ArrayEstimate, Estimate
from ._results import Measured, Result, Series, measured_of, source_of_run

PathName = Union[str, "os.PathLike[str]"]
# The value of a parameter, as on the command line. A tuple is one value with several parts, and an
# array is a path (columns t, x, y) or sizes (radius, or columns radius and mass).
Value = Union[float, int, str, tuple[Union[float, int, str], ...], "np.ndarray[Any, Any]", None]
ProgressCallback = Callable[[float, int, float], object]  # (fraction, events, periods)


class Parameter(NamedTuple):
    """One parameter of a run (docs/reference/parameters.md). `lowest` and `highest` limit its
    value."""

    name: str
    symbol: str
    unit: str
    description: str
    default: str
    lowest: float
    highest: float
    group: str

    def __str__(self) -> str:
        unit = f", in units of {self.unit}" if self.unit else ""
        return (
            f"{self.name}: {self.description}{unit}{f' [{self.default}]' if self.default else ''}"
        )


class SamplesSnapshots(Protocol):
    """A custom measurement of single snapshots.

    sample() returns a number, an array, a dict of these, or None to skip the snapshot. The values
    are averaged over each period; mean and error come from these blocks."""

    def sample(self, snapshot: _engine.Snapshot) -> Any:
        ...


class TakesFrames(Protocol):
    """A custom measurement of all frames of a period.

    frames.position is [frame, disc, xy]. block() returns the value of this period: a number, an
    array, or a dict of these. Mean and error come from these blocks."""

    def block(self, frames: _engine.Frames) -> Any:
        ...


CustomMeasurement = Union[SamplesSnapshots, TakesFrames, Callable[[_engine.Snapshot], Any]]
Measure = Union[str, Iterable[Union[str, CustomMeasurement]]]


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during a run; `result` holds the averages up to then."""

    def __init__(self, result: Result) -> None:
        super().__init__("stopped before the end of the run; `result` holds the averages so far.")
        self.result = result


def parameters() -> list[Parameter]:
    """All parameters of a run with defaults, ranges and units. Defaults are the paper's values."""
    return [Parameter(*row) for row in _engine.parameters()]


def measurements() -> dict[str, str]:
    """Names and descriptions of all measurements; the rotation is always measured."""
    return {name: description for name, _, description in _engine.measurement_kinds()}


def version() -> str:
    """The version with the commit, as results store it. swirl.__version__ is the number alone."""
    return _engine.version()


def checksum(content: str) -> str:
    """The CRC-64 of a text in UTF-8, as 16 hexadecimal digits (src/swirl/io/checksum.hpp).

    It detects damaged files. It does not protect against deliberate changes."""
    return _engine.checksum(text("content", content))


class CustomBlocks:
    """The values of custom measurements, period by period."""

    def __init__(self, measurements: list[CustomMeasurement]) -> None:
        self._measurements = measurements
        self._names = [custom_name(measurement) for measurement in measurements]
        self._blocks: dict[str, dict[str, list[tuple[Any, Any]]]] = {n: {} for n in self._names}
        for name in self._names:
            if self._names.count(name) > 1 or name in measurements_known():
                raise ValueError(
                    f"measure has two measurements named '{name}'.\n"
                    "hint: give one of them another attribute `name`."
                )
        rates = {
            int(getattr(m, "samples_per_period", _engine.samples_per_period)) for m in measurements
        }
        if len(rates) > 1:
            raise ValueError(
                "all measurements of a run must have the same samples_per_period, but "
                f"these have {', '.join(map(str, sorted(rates)))}."
            )
        self.samples_per_period = rates.pop() if rates else _engine.samples_per_period
        if not 1 <= self.samples_per_period <= 1_000_000:
            raise ValueError(
                f"samples_per_period is {self.samples_per_period}, but it must be from "
                "1 to 1000000."
            )

    def period_ended(self, frames: _engine.Frames) -> None:
        for name, measurement in zip(self._names, self._measurements):
            if hasattr(measurement, "block"):
                values = [measurement.block(frames)]
            else:
                sample: Any = getattr(measurement, "sample", measurement)
                values = [sample(frames[k]) for k in range(len(frames))]
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
                raise ValueError(f"'{name}' returned arrays of different shapes.")
            stacked = np.stack(numbers)
            is_valid = ~np.isnan(stacked)
            sums = np.where(is_valid, stacked, 0.0).sum(axis=0)
            weights = is_valid.sum(axis=0).astype(np.float64)
            self._blocks[name].setdefault(row, []).append((sums, weights))

    def results(self, source: str) -> dict[str, Measured]:
        """The estimates of the run or recording `source`."""
        return {
            name: Measured(
                name, {row: _estimate_of(blocks, source) for row, blocks in rows.items()}, {}
            )
            for name, rows in self._blocks.items()
        }


def _estimate_of(blocks: list[tuple[Any, Any]], source: str) -> Union[Estimate, ArrayEstimate]:
    sums, weights = (np.stack(column) for column in zip(*blocks))
    shape, n = sums.shape[1:], len(blocks)
    mean, error, effective = _engine.estimates(sums.reshape(n, -1), weights.reshape(n, -1))
    if shape == ():
        return Estimate(
            float(mean[0]), float(error[0]), float(effective[0]), n, _sources=frozenset((source,))
        )
    return ArrayEstimate(mean.reshape(shape), error.reshape(shape), effective.reshape(shape), n)


def custom_name(measurement: CustomMeasurement) -> str:
    for attribute in ("name", "__name__"):
        if isinstance(getattr(measurement, attribute, None), str):
            return str(getattr(measurement, attribute))
    return type(measurement).__name__


def measurements_known() -> set[str]:
    return {kind[0] for kind in _engine.measurement_kinds()}


def split_measure(measure: Optional[Measure]) -> tuple[list[str], list[CustomMeasurement]]:
    """Separates names of measurements from custom ones."""
    if measure is None:
        return [], []
    if isinstance(measure, str):
        return (list(_engine.measurement_list(text("measure", measure))) if measure else []), []
    if not isinstance(measure, Iterable):
        measure = [measure]
    names: list[str] = []
    custom: list[CustomMeasurement] = []
    for each in measure:
        if isinstance(each, str):
            names += [
                name
                for name in _engine.measurement_list(text("measure", each))
                if name not in names
            ]
            continue
        kind: Any = each  # a class or an object
        one = kind() if isinstance(each, type) else kind
        if not (hasattr(one, "block") or hasattr(one, "sample") or callable(one)):
            raise TypeError(
                f"measure contains {shown(one)}, but each element must be a name or have a "
                "method sample(snapshot) or block(frames).\n"
                "hint: swirl.measurements() lists the names."
            )
        custom.append(one)
    return names, custom


def call_text(function: str, arguments: Mapping[str, object]) -> str:
    """The call as Python code."""
    given = ", ".join(f"{name}={value!r}" for name, value in arguments.items() if value is not None)
    return f"swirl.{function}({given})".encode("utf-8", "backslashreplace").decode()


class Progress:
    """A tqdm bar if tqdm is installed, or the caller's callback."""

    def __init__(self, progress: Union[bool, ProgressCallback, None], what: str) -> None:
        self._bar: Any = None
        self.callback: Optional[ProgressCallback] = None
        if callable(progress):
            self.callback = progress
        elif progress:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                return
            self._bar = tqdm(total=1.0, desc=what, bar_format="{l_bar}{bar}| {elapsed}<{remaining}")
            self.callback = self._show

    def _show(self, fraction: float, events: int, periods: float) -> None:
        self._bar.update(fraction - self._bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()


def run(
    *,
    measure: Optional[Measure] = None,
    progress: Union[bool, ProgressCallback, None] = None,
    trajectory: Optional[PathName] = None,
    frames_per_period: Optional[int] = None,
    event_log: Optional[PathName] = None,
    checkpoint: Optional[PathName] = None,
    series: Union[bool, PathName] = False,
    resume: bool = False,
    overwrite: bool = False,
    **parameters: Value,
) -> Result:
    names, custom = split_measure(measure)
    blocks = CustomBlocks(custom)
    table = None if isinstance(series, bool) else series
    files = _files(trajectory, frames_per_period, event_log, checkpoint, table, resume, overwrite)
    given = {**parameters, **({"measure": ",".join(names)} if names else {}), **files}
    bar = Progress(progress, "run")
    try:
        text, reports, raised, headline, report, found = _engine.run(
            parameters,
            names,
            call_text("run", given),
            bar.callback,
            blocks.samples_per_period,
            blocks.period_ended if custom else None,
            files,
            bool(series),
        )
    finally:
        bar.close()
    source = source_of_run(json.loads(text)["config"])
    result = Result(
        text,
        {**measured_of(reports, source), **blocks.results(source)},
        headline,
        report,
        Series(*found) if found is not None else None,
    )
    if isinstance(raised, KeyboardInterrupt):
        raise Interrupted(result) from None
    if raised is not None:
        raise raised
    return result


def _files(
    trajectory: Optional[PathName],
    frames_per_period: Optional[int],
    event_log: Optional[PathName],
    checkpoint: Optional[PathName],
    series: Optional[PathName],
    resume: bool,
    overwrite: bool,
) -> dict[str, Any]:
    files: dict[str, Any] = {
        name: file_name(name, path)
        for name, path in (
            ("trajectory", trajectory),
            ("event_log", event_log),
            ("checkpoint", checkpoint),
            ("series", series),
        )
        if path is not None
    }
    if series is not None and not os.fspath(series).endswith(".csv"):
        raise ValueError(
            f"series is '{os.fspath(series)}', but its name must end in .csv.\n"
            "hint: the table is written as CSV; series=True only returns it."
        )
    if frames_per_period is not None:
        if trajectory is None:
            raise ValueError("frames_per_period is given, but trajectory is not.")
        if not isinstance(frames_per_period, int) or not 1 <= frames_per_period <= 1_000_000:
            raise ValueError(
                f"frames_per_period is {shown(frames_per_period)}, but it must be a whole number "
                "from 1 to 1000000."
            )
        files["frames_per_period"] = frames_per_period
    if resume and checkpoint is None:
        raise ValueError("resume is given, but checkpoint is not.")
    if resume:
        files["resume"] = True
    if overwrite:
        files["overwrite"] = True
    continues = resume and checkpoint is not None and exists(checkpoint)
    if not overwrite and not continues:
        for path in (checkpoint, trajectory, event_log, series):
            if path is not None and exists(path) and os.path.getsize(path) > 0:
                raise FileExistsError(
                    f"'{os.fspath(path)}' already exists.\nhint: choose another name, "
                    "or use overwrite=True to replace it."
                )
    return files


def parameter_lines() -> str:
    """All parameters with descriptions, units and defaults, for docstrings."""
    lines = []
    for p in parameters():
        lines += textwrap.wrap(str(p), 96, initial_indent="    ", subsequent_indent="        ")
    return "\n".join(lines)


def with_parameters(function: Callable[..., Any], text: str) -> None:
    """Sets docstring and signature of a function with **parameters, so that editors complete their
    names."""
    function.__doc__ = (
        f"{text}\nParameters (docs/reference/parameters.md), the paper's values by default:\n\n"
        f"{parameter_lines()}\n"
    )
    signature = inspect.signature(function)
    named = [p for p in signature.parameters.values() if p.kind != p.VAR_KEYWORD]
    taken = {p.name for p in named}
    first = [
        inspect.Parameter(p.name, inspect.Parameter.KEYWORD_ONLY, default=None)
        for p in parameters()
        if p.name not in taken
    ]
    before = [p for p in named if p.kind != p.KEYWORD_ONLY]
    after = [p for p in named if p.kind == p.KEYWORD_ONLY]
    function.__signature__ = signature.replace(  # type: ignore[attr-defined]
        parameters=before + first + after
    )


def resolve(**parameters: Value) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(_engine.resolve(parameters))
    return found


def run_identity(**parameters: Value) -> str:
    return _engine.run_identity(parameters)


with_parameters(
    run,
    """One simulation, from its seed to its averages, like `swirl run`.

    r = swirl.run(discs=48, mu=1, events=1e6, measure=["density", "pinned"])
    r.rotation.mean_by_time.mean, r.rotation.mean_by_time.error
    r.measured["density"]["by_time"]            # numpy, [y, x]
    r.state_hash

measure: names (swirl.measurements()), "all", and custom measurements: objects with a method
    sample(snapshot), called 511 times in each period after the warm-up, or block(frames), called once
    per period with all its samples.
progress: True for a bar (needs tqdm), or a function of (fraction, events, periods).
series: True for the averages of every period, result.series; or also the name of a CSV file to write.
trajectory, frames_per_period [30], event_log, checkpoint, resume, overwrite: files, as for `swirl run`.

Returns a swirl.Result; its values are bitwise identical to those of the command line. Other Python
threads run meanwhile. Ctrl-C raises swirl.Interrupted, a KeyboardInterrupt whose `result` holds the
averages so far. A wrong value raises ValueError, a wrong name or type TypeError, and a run that cannot
be done swirl.Failure.
""",
)
with_parameters(
    resolve,
    """All parameters of a run with their values, those that are derived from others included.

    swirl.resolve(preset="experiment", discs=40)["period"]

Returns a dictionary of plain values, equal to `config` of the result. Units are those of
swirl.parameters(). A wrong value raises ValueError, a wrong name or type TypeError.
""",
)
with_parameters(
    run_identity,
    """A key of 16 hexadecimal digits that two runs share if they are bitwise the same run.

    swirl.run_identity(discs=48) == swirl.run_identity(mu=1, discs=48)

It depends on the resolved parameters, not on how they are given. A wrong value raises ValueError, a
wrong name or type TypeError.
""",
)
