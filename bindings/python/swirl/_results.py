"""Results of a run: numbers with their errors, and tables."""

from __future__ import annotations

import dataclasses
import html
import json
import math
import os
from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _engine
from ._arguments import file_name
from ._estimates import ArrayEstimate, Estimate, FloatArray, with_error
from ._optional import optional
from ._tables import Rows, numbers_to_pandas, numbers_to_xarray, rows_of

ReportRow = tuple[str, str, str, float, float, float, int, dict[str, float], bool]
ReportTable = tuple[str, str, list[tuple[str, str]], FloatArray]
Report = tuple[str, list[ReportRow], list[ReportTable]]


class Table:
    """The table of a measurement.

    `table["x"]` is a column as a read-only numpy array. If the rows are the cells of a map
    (columns x and y), it has two dimensions, [y, x], as for matplotlib's `pcolormesh(x, y, …)`.
    Otherwise it has one value per row. `axes` holds the coordinates along the axes, in their order.
    `units` maps columns to units of docs/explanation/physics.md.
    """

    __slots__ = ("name", "description", "units", "_values", "_columns", "__weakref__")

    def __init__(
        self, name: str, description: str, columns: list[tuple[str, str]], values: FloatArray
    ) -> None:
        self.name = name
        self.description = description
        self.units: Mapping[str, str] = MappingProxyType(dict(columns))
        # An unpickled array is writable.
        values.setflags(write=False)
        self._values = values
        self._columns = [column for column, _ in columns]

    def __reduce__(self) -> tuple[Any, ...]:
        # pickle and copy cannot handle a view of a dictionary.
        return Table, (self.name, self.description, list(self.units.items()), self._values)

    @property
    def columns(self) -> list[str]:
        return list(self._columns)

    @property
    def axes(self) -> dict[str, FloatArray]:
        """The coordinates along each axis of the columns: {"y": …, "x": …}, or {"theta": …}."""
        if self._is_map():
            return {name: np.unique(self._column(name)) for name in ("y", "x")}
        return {self._columns[0]: self._column(self._columns[0])}

    def __getitem__(self, column: str) -> FloatArray:
        if column not in self._columns:
            raise KeyError(
                f"the table of {self.name} has no column '{column}'; "
                f"it has {', '.join(self._columns)}."
            )
        values = self._column(column)
        if not self._is_map():
            return values
        y, x = self.axes.values()
        return values.reshape(len(y), len(x))

    def __len__(self) -> int:
        return len(self._values)

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __contains__(self, column: object) -> bool:
        return column in self._columns

    def __array__(self, dtype: Any = None) -> npt.NDArray[Any]:
        return np.asarray(self._values, dtype=dtype)

    def __repr__(self) -> str:
        return f"<table of {self.name}: {len(self)} rows of {', '.join(self._columns)}>"

    def to_pandas(self) -> Any:
        """The table as a pandas DataFrame; `frame.attrs["units"]` has the units."""
        pandas = optional("pandas", "to_pandas()")
        frame = pandas.DataFrame(np.array(self._values), columns=self._columns)
        frame.attrs["units"] = dict(self.units)
        return frame

    def to_xarray(self) -> Any:
        """The table as an xarray Dataset: each column that is not an axis is a variable with its
        unit."""
        xarray = optional("xarray", "to_xarray()")
        axes = self.axes
        variables = {
            name: (list(axes), np.array(self[name]), {"units": self.units[name]})
            for name in self._columns
            if name not in axes
        }
        coordinates = {
            name: (name, values, {"units": self.units[name]}) for name, values in axes.items()
        }
        return xarray.Dataset(
            variables, coords=coordinates, attrs={"description": self.description}
        )

    def plot(self, column: Optional[str] = None, *, ax: Any = None) -> Any:
        """Draws a column, a map in colours or a line with its error; returns the axes. See
        swirl.plot.table()."""
        from . import plot

        return plot.table(self, column, ax=ax)

    def _repr_html_(self) -> str:
        return _html_table(repr(self), self._columns, self._values)

    def _column(self, name: str) -> FloatArray:
        return self._values[:, self._columns.index(name)]

    def _is_map(self) -> bool:
        # Rows of a map run along x first; their number is that of the cells.
        if self._columns[:2] != ["x", "y"] or len(self) == 0:
            return False
        x, y = np.unique(self._column("x")), np.unique(self._column("y"))
        return len(x) * len(y) == len(self) and bool(
            np.all(self._column("x").reshape(len(y), len(x)) == x)
            and np.all(self._column("y").reshape(len(y), len(x)) == y[:, None])
        )


class Measured(Mapping[str, Union[Estimate, ArrayEstimate, Table]]):
    """The results of one measurement: its numbers and tables by name.

    If its only table has no name, indexing gives the table's columns:
    measured["density"]["by_time"]."""

    __slots__ = ("name", "rows", "tables", "__weakref__")

    def __init__(
        self,
        name: str,
        rows: Mapping[str, Union[Estimate, ArrayEstimate]],
        tables: Mapping[str, Table],
    ) -> None:
        self.name = name
        self.rows: Mapping[str, Union[Estimate, ArrayEstimate]] = MappingProxyType(dict(rows))
        self.tables: Mapping[str, Table] = MappingProxyType(dict(tables))

    def __reduce__(self) -> tuple[Any, ...]:
        return Measured, (self.name, dict(self.rows), dict(self.tables))

    @property
    def table(self) -> Table:
        """The only table."""
        if len(self.tables) != 1:
            raise KeyError(f"'{self.name}' has {len(self.tables)} tables.")
        return next(iter(self.tables.values()))

    @property
    def estimate(self) -> Union[Estimate, ArrayEstimate]:
        """The only number."""
        if len(self.rows) != 1:
            raise KeyError(f"'{self.name}' has {len(self.rows)} numbers.")
        return next(iter(self.rows.values()))

    def __getitem__(self, name: str) -> Any:
        if name in self.rows:
            return self.rows[name]
        if name in self.tables:
            return self.tables[name]
        if "" in self.tables and name in self.tables[""]:
            return self.tables[""][name]
        raise KeyError(f"'{self.name}' has no '{name}'; it has {', '.join(self)}.")

    def __iter__(self) -> Iterator[str]:
        yield from self.rows
        yield from (name for name in self.tables if name)
        yield from self.tables.get("", ())

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def to_pandas(self) -> Any:
        """The numbers as a pandas DataFrame, one row per number. The tables have a to_pandas() of
        their own."""
        return numbers_to_pandas(rows_of({self.name: self}))

    def to_xarray(self) -> Any:
        """The numbers as an xarray Dataset along the dimension quantity."""
        return numbers_to_xarray(rows_of({self.name: self}))

    def plot(self, column: Optional[str] = None, *, ax: Any = None) -> Any:
        """Draws the first table; returns the axes. See swirl.plot.measured()."""
        from . import plot

        return plot.measured(self, column, ax=ax)

    def __repr__(self) -> str:
        return f"<{self.name}: {', '.join(self)}>"

    def __str__(self) -> str:
        return "\n".join(
            [f"{self.name}.{name}  {value}" for name, value in self.rows.items()]
            + [repr(table) for table in self.tables.values()]
        )


class Series(Mapping[str, FloatArray]):
    """The averages of every period of a run: `series["mean_by_time"]` is a column, with one value
    per period.

    Columns: period, counted (1 after the warm-up), the rotation rates mean_by_event, mean_by_time,
    rigid_by_event and rigid_by_time, spin, energy, centre_x, centre_y, events; "ramp.mu" and so on
    for ramps; "slip.cluster" and so on for the rows of `measure`. A missing value is NaN."""

    __slots__ = ("units", "descriptions", "_values", "_names", "__weakref__")

    def __init__(
        self, names: list[str], units: list[str], descriptions: list[str], values: FloatArray
    ) -> None:
        values.setflags(write=False)
        self._values = values
        self._names = names
        self.units: Mapping[str, str] = MappingProxyType(dict(zip(names, units)))
        self.descriptions: Mapping[str, str] = MappingProxyType(dict(zip(names, descriptions)))

    def __reduce__(self) -> tuple[Any, ...]:
        return Series, (
            self._names,
            list(self.units.values()),
            list(self.descriptions.values()),
            self._values,
        )

    def __getitem__(self, name: str) -> FloatArray:
        if name not in self._names:
            raise KeyError(f"the series has no column '{name}'; it has {', '.join(self._names)}.")
        return self._values[:, self._names.index(name)]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    @property
    def periods(self) -> int:
        """The number of rows."""
        return int(self._values.shape[0])

    def to_pandas(self) -> Any:
        """The series as a pandas DataFrame, one row per period."""
        pandas = optional("pandas", "to_pandas()")
        frame = pandas.DataFrame(np.array(self._values), columns=self._names)
        frame.attrs["units"] = dict(self.units)
        return frame

    def to_xarray(self) -> Any:
        """The series as an xarray Dataset along the dimension period; each column is a variable
        with its unit."""
        xarray = optional("xarray", "to_xarray()")
        variables = {
            name: (
                "period",
                np.array(self[name]),
                {"units": self.units[name], "description": self.descriptions[name]},
            )
            for name in self._names
            if name != "period"
        }
        return xarray.Dataset(variables, {"period": np.array(self["period"])})

    def plot(self, column: str = "mean_by_time", *, ax: Any = None) -> Any:
        """Draws a column against the period; returns the axes. See swirl.plot.series()."""
        from . import plot

        return plot.series(self, column, ax=ax)

    def _repr_html_(self) -> str:
        return _html_table(repr(self), self._names, self._values)

    def __repr__(self) -> str:
        return f"<series of {self.periods} periods: {', '.join(self._names)}>"


def measured_of(reports: list[Report], source: str) -> dict[str, Measured]:
    """Converts the reports of the engine on the run or recording `source`."""
    all_found = {}
    for measurement, rows, tables in reports:
        estimates = {
            name: Estimate(
                mean, error, effective, blocks, unit, description, details, frozenset((source,))
            )
            for name, unit, description, mean, error, effective, blocks, details, _ in rows
        }
        made = {
            name: Table(
                f"{measurement}.{name}" if name else measurement, description, columns, values
            )
            for name, description, columns, values in tables
        }
        all_found[measurement] = Measured(measurement, estimates, made)
    return all_found


@dataclasses.dataclass(frozen=True)
class Rotation:
    """The cluster's rotation rate ϖ in units of Ω in the lab frame, over whole periods after the
    warm-up.

    `mean_by_event` is the paper's average over events. `rigid_…` are rates of the best-fitting
    rigid body (src/swirl/measure/cluster_rotation.hpp). Negative values mean counterrotation."""

    mean_by_event: Estimate
    mean_by_time: Estimate
    rigid_by_event: Estimate
    rigid_by_time: Estimate

    def __str__(self) -> str:
        return f"ϖ/Ω = {with_error(*self.mean_by_time)}"

    def rows(self) -> Rows:
        """The four rates with their complete names."""
        return [(f"rotation.{name}", rate) for name, rate in vars(self).items()]

    def to_pandas(self) -> Any:
        """The four rates as a pandas DataFrame, one row per rate."""
        return numbers_to_pandas(self.rows())

    def to_xarray(self) -> Any:
        """The four rates as an xarray Dataset along the dimension quantity."""
        return numbers_to_xarray(self.rows())


@dataclasses.dataclass(frozen=True)
class EventCounts:
    """Number of events of each kind. `elastic_by_tc_model` counts collisions that are also in
    disc_disc or disc_wall."""

    total: int = 0
    disc_disc: int = 0
    disc_wall: int = 0
    path_vertex: int = 0
    elastic_by_tc_model: int = 0
    begins_to_roll: int = 0

    def __str__(self) -> str:
        kinds = ", ".join(
            f"{number:,} {name}" for name, number in list(vars(self).items())[1:] if number
        )
        return f"{self.total:,} events{': ' if kinds else ''}{kinds}"


def _html_table(caption: str, columns: list[str], values: FloatArray, shown: int = 6) -> str:
    """The first rows and columns of a table, for notebooks."""
    names = columns[:shown] + ["…"] * (len(columns) > shown)
    rows = [
        [f"{value:.4g}" for value in row[:shown]] + ["…"] * (len(columns) > shown)
        for row in values[:shown]
    ]
    if len(values) > shown:
        rows.append(["…"] * len(names))
    head = "".join(f"<th>{html.escape(name)}</th>" for name in names)
    body = "".join(f"<tr>{''.join(f'<td>{value}</td>' for value in row)}</tr>" for row in rows)
    return f"<p>{html.escape(caption)}</p><table><tr>{head}</tr>{body}</table>"


def _number(value: Optional[float]) -> float:
    return math.nan if value is None else float(value)


def _estimate(value: Mapping[str, Any], unit: str, source: str) -> Estimate:
    return Estimate(
        _number(value["mean"]),
        _number(value["error"]),
        _number(value["effective_samples"]),
        int(value["blocks"]),
        unit,
        _sources=frozenset((source,)),
    )


def source_of_run(config: Mapping[str, Any]) -> str:
    """Runs that differ only in their length have the same events, as far as the shorter one
    goes."""
    same = {
        name: value for name, value in config.items() if name not in ("events", "periods", "warmup")
    }
    return _engine.checksum(json.dumps(same, sort_keys=True))


class Result:
    """The result of one run.

    config                  all resolved parameters
    units                   r, v and m, the units of all numbers, in the units of the config
    complete                False if it was stopped before its end
    rotation                Rotation: .mean_by_time.mean, .mean_by_time.error, .mean_by_event, …
    measured                {"density": …}: results of the argument `measure`
    events, periods         EventCounts and simulated periods, warm-up included
    warmup                  whole periods omitted from the averages
    series                  Series with the argument `series`, otherwise None
    autocorrelation_times   of its columns, in periods: {"mean_by_time": …}; empty without a series
    fluctuations            of its columns, without a ramp:
                            r.fluctuations["mean_by_time"]["binder"].mean, and "n_variance",
                            "skewness", "excess_kurtosis", "correlation_time", "low", "high",
                            "low_lifetime", "high_lifetime"
    steady_state            "steady", "drifting", "jumping", "switching" or "too short to tell"
    steady_state_found      findings of the steady-state tests; "" if there are none
    change, spin_change
                            most likely change of the rotation and of the spins, in standard errors
    state_hash              64-bit hash of the final state, 16 hexadecimal digits: equal runs have
                            equal hashes on every machine
    warnings                limits of the results, as sentences
    max_overlap, energy, energy_at_start, invariant, invariant_at_start, seconds,
    events_per_second, simd, version, build
    """

    __slots__ = (
        "config",
        "units",
        "complete",
        "rotation",
        "measured",
        "series",
        "autocorrelation_times",
        "fluctuations",
        "events",
        "periods",
        "warmup",
        "warmup_events",
        "steady_state",
        "steady_state_found",
        "change",
        "spin_change",
        "max_overlap",
        "energy",
        "energy_at_start",
        "invariant",
        "invariant_at_start",
        "state_hash",
        "seconds",
        "events_per_second",
        "simd",
        "warnings",
        "version",
        "build",
        "_text",
        "_headline",
        "_report",
        "__weakref__",
    )

    def __init__(
        self,
        text: str,
        measured: Mapping[str, Measured],
        headline: str,
        report: str,
        series: Optional[Series] = None,
    ) -> None:
        found = json.loads(text)
        self._text = text
        self._headline = headline
        self._report = report
        self.config: dict[str, Any] = found["config"]
        source = source_of_run(self.config)
        self.units: dict[str, float] = found["units"]
        self.complete: bool = found["complete"]
        self.rotation = Rotation(
            **{name: _estimate(value, "Ω", source) for name, value in found["rotation"].items()}
        )
        self.measured: Mapping[str, Measured] = dict(measured)
        self.series = series
        self.autocorrelation_times: dict[str, float] = {
            name: _number(average["autocorrelation_time"])
            for name, average in found.get("series", {}).get("averages", {}).items()
        }
        self.fluctuations: dict[str, dict[str, Estimate]] = {
            name: {
                row: _estimate({**average, **value}, "1", source)
                for row, value in average["fluctuations"].items()
            }
            for name, average in found.get("series", {}).get("averages", {}).items()
            if "fluctuations" in average
        }
        self.events = EventCounts(**found["events"])
        self.periods = float(found["periods"])
        self.warmup = int(found["warmup"]["periods"])
        self.warmup_events = int(found["warmup"]["events"])
        self.steady_state: str = found["steady_state"]["verdict"]
        self.steady_state_found: str = found["steady_state"]["found"]
        self.change = _number(found["steady_state"]["change"])
        self.spin_change = _number(found["steady_state"]["spin_change"])
        self.max_overlap = _number(found["max_overlap"])
        self.energy = _number(found["energy"])
        self.energy_at_start = _number(found["energy_at_start"])
        self.invariant = _number(found["invariant"])
        self.invariant_at_start = _number(found["invariant_at_start"])
        self.state_hash: str = found["state_hash"]
        self.seconds = float(found["seconds"])
        self.events_per_second = float(found["events_per_second"])
        self.simd: str = found["simd"]  # the vector instructions of the event loop
        self.warnings: list[str] = found["warnings"]
        self.version: str = found["version"]
        self.build: str = found["build"]

    def to_json(self) -> str:
        """The text that `swirl run --json` writes; only `command` is the Python call.

        Custom measurements are not included.
        """
        return self._text

    def save(self, file: Union[str, os.PathLike[str]]) -> None:
        """Writes to_json() to a file. `swirl verify FILE` repeats the run and compares."""
        write_atomically(file, (self._text + "\n").encode())

    def to_pandas(self) -> Any:
        """The rotation and all measured numbers as a pandas DataFrame, one row per number:
        quantity, unit, mean, error, effective_samples, blocks."""
        return numbers_to_pandas(self._numbers())

    def to_xarray(self) -> Any:
        """The same as an xarray Dataset along the dimension quantity."""
        return numbers_to_xarray(self._numbers())

    def _numbers(self) -> Rows:
        return [*self.rotation.rows(), *rows_of(self.measured)]

    def plot(self, what: Optional[str] = None, *, ax: Any = None) -> Any:
        """Draws "series", a measurement or one of its tables; returns the axes. The default is the
        first of these that the result has, and otherwise the rotation. See swirl.plot.result()."""
        from . import plot

        return plot.result(self, what, ax=ax)

    def show(
        self,
        *,
        page: Union[str, "os.PathLike[str]", None] = None,
        height: int = 640,
        lang: Optional[str] = None,
    ) -> Any:
        """Shows the browser page with the parameters of this run in a notebook: a swirl.Lab. page,
        height, lang: as for swirl.lab()."""
        from ._lab import lab, parameters_of

        return lab(page=page, height=height, lang=lang, dish=False, **parameters_of(self.config))

    def __repr__(self) -> str:
        return self._headline

    def __str__(self) -> str:
        return self._report + "".join(f"{found}\n" for found in self.measured.values())

    def _repr_html_(self) -> str:
        # The headline has the rotation.
        rows = [
            ("events", f"{self.events.total:,}"),
            ("periods", f"{self.periods:.1f}"),
            ("steady state", self.steady_state),
            ("state", self.state_hash),
        ]
        rows += [
            (f"{name}.{row}", str(value))
            for name, found in self.measured.items()
            for row, value in found.rows.items()
        ]
        body = "".join(
            f"<tr><th style='text-align:left'>{html.escape(name)}</th>"
            f"<td style='text-align:left'>{html.escape(value)}</td></tr>"
            for name, value in rows
        )
        notes = "".join(f"<p>{html.escape(sentence)}</p>" for sentence in self.warnings)
        return f"<p>{html.escape(self._headline)}</p><table>{body}</table>{notes}"


def write_atomically(file: Union[str, os.PathLike[str]], content: bytes) -> None:
    """The file is never incomplete: the content goes to a temporary file first. Raises OSError."""
    _engine.write_file(file_name("file", file), content)
