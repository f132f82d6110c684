"""Many runs: sweeps, crossings and maps."""

from __future__ import annotations

import concurrent.futures
import dataclasses
import io
import itertools
import json
import math
import os
import tempfile
import threading
import warnings
from collections.abc import Callable, Sequence
from typing import Any, Optional, Union

from . import _engine
from ._arguments import file_name, shown, text as checked_text
from ._files import exists
from ._optional import optional
from ._points_table import count, given_values, names_of
from ._results import Result
from ._runs import Measure, PathName, Progress, call_text, run, split_measure, with_parameters
from ._sweep_folder import SweepFolder, Values


class SweepWarning(UserWarning):
    """Some rows of a sweep's table are incomplete."""


def sweep(
    out: Optional[PathName] = None,
    *,
    points: Any = None,
    replicates: int = 1,
    measure: Optional[Measure] = None,
    frames_per_period: int = 0,
    threads: int = 0,
    grow: bool = False,
    progress: Union[bool, Callable[[float, float, int], object], None] = None,
    chain: Optional[str] = None,
    series: bool = False,
    **parameters: Values,
) -> Any:
    optional("pandas", "swirl.sweep()")
    count("threads", threads, 0)
    if out is None:
        if grow or frames_per_period or series:
            extra = "grow" if grow else "frames_per_period" if frames_per_period else "series"
            raise ValueError(f"{extra} is given, but out, the folder of the sweep, is not.")
        with tempfile.TemporaryDirectory(prefix="swirl-sweep-") as temporary:
            return sweep(
                temporary,
                points=points,
                replicates=replicates,
                measure=measure,
                threads=threads,
                progress=progress,
                chain=chain,
                **parameters,
            )
    folder, names = SweepFolder(file_name("out", out)), names_of(measure, "A sweep")
    if grow and (chain or series):
        raise ValueError(
            "chain and series cannot be used with grow: they apply to all runs of a sweep or to "
            "none."
        )
    given = any(value is not None for value in (points, *parameters.values()))
    if grow:
        folder.grow(points=points, replicates=replicates, measure=names, **parameters)
    elif given or names or chain or series:
        folder.plan(
            points=points,
            replicates=replicates,
            measure=names,
            frames_per_period=frames_per_period,
            chain=chain,
            series=series,
            **parameters,
        )
    elif not folder.is_planned:
        raise ValueError(
            "there is no parameter to sweep over.\n"
            "hint: give lists, such as discs=range(5, 49), mu=[0.1, 0.5, 1]."
        )
    bar = Progress(progress if not callable(progress) else None, "sweep")
    callback: Any = progress if callable(progress) else None
    if callback is None and bar.callback is not None:
        show = bar.callback

        def callback(done: float, runs: float, events: int) -> None:
            show(done / runs if runs else 1.0, events, 0.0)

    try:
        counts = folder.run(threads=threads, progress=callback)
    finally:
        bar.close()
    if counts.failed:
        warnings.warn(
            f"{counts.failed} runs failed; the first is {counts.first_failure}",
            SweepWarning,
            stacklevel=2,
        )
    return collect(folder.path)


def collect(out: PathName) -> Any:
    """The results of a sweep so far as a pandas DataFrame, like the table of `swirl collect`.

    Each combination of parameters is one row. It has the mean and the standard error, within and
    between replicates, of the rotation and of every measured number. `table.attrs["runs"]` counts
    planned, done, running and failed runs. For a chain, `table.attrs["loops"]` has the areas of the
    hysteresis loops and their errors.
    """
    pandas = optional("pandas", "swirl.collect()")
    csv, points, done, running, failed, disagreeing, not_steady, without, loops = _engine.collect(
        file_name("out", out)
    )
    # As text: a hash such as 12345678e9012345 looks like a number.
    table = pandas.read_csv(
        io.StringIO(csv),
        float_precision="round_trip",
        dtype={"state_hash": str, "steady_state": str},
    )
    table.attrs["runs"] = {"planned": points, "done": done, "running": running, "failed": failed}
    table.attrs["disagreeing"] = disagreeing
    table.attrs["not_steady"] = not_steady
    if loops:
        table.attrs["loops"] = pandas.read_csv(
            io.StringIO(loops), float_precision="round_trip"
        ).to_dict("records")
    if without:
        warnings.warn(
            f"{without} runs have no whole period after the warm-up, so they have no "
            "averages.\nhint: increase events.",
            SweepWarning,
            stacklevel=2,
        )
    return table


@dataclasses.dataclass(frozen=True)
class Crossing:
    """The number of discs N_c at which rotation changes to counterrotation.

    `discs` is N_c, `error` its standard error, and `lower` to `upper` its 95 % interval. `discs`
    and `error` are NaN if only the interval is known. All of these refer to the rotation rate
    `rate`. `verdict` is "crosses", "always rotates", "always counterrotates" or "undecided";
    `sentence` reports it with the evidence. `by_rate` has the results for each of the four rates:
    N_c, N_c_error, N_c_lower, N_c_upper, every change of sign, and the numbers whose sign is
    undetermined. Each of `points` has the number of discs, the rotation (mean, error) by `rate` and
    by each of the four rates, and the number of runs."""

    verdict: str
    discs: float
    error: float
    lower: float
    upper: float
    within_tolerance: bool
    rate: str
    by_rate: dict[str, dict[str, Any]]
    points: Sequence[dict[str, Any]]
    sentence: str
    found: dict[str, Any] = dataclasses.field(repr=False)

    def __float__(self) -> float:
        return self.discs

    def to_pandas(self) -> Any:
        """The points as a pandas DataFrame, one row for each number of discs."""
        pandas = optional("pandas", "to_pandas()")
        return pandas.DataFrame(list(self.points))

    def to_xarray(self) -> Any:
        """The points as an xarray Dataset along the dimension discs."""
        xarray = optional("xarray", "to_xarray()")
        names = [name for name in (self.points[0] if self.points else ()) if name != "discs"]
        return xarray.Dataset(
            {name: ("discs", [point[name] for point in self.points]) for name in names},
            {"discs": [point["discs"] for point in self.points]},
        )

    def plot(self, *, ax: Any = None) -> Any:
        """Draws the points with N_c; returns the axes. See swirl.plot.crossing()."""
        from . import plot

        return plot.crossing(self, ax=ax)

    def __str__(self) -> str:
        return self.sentence


_ARRAYS = ("motion", "path", "sizes", "initial")  # parameters of which an array is one value


def _lists(parameters: dict[str, Any]) -> dict[str, list[Any]]:
    """The parameters with several values."""
    return {
        name: list(value)
        for name, value in parameters.items()
        if name not in _ARRAYS
        and hasattr(value, "__iter__")
        and not isinstance(value, (str, tuple, bytes))
    }


def _crossings(
    out: Optional[PathName], lists: dict[str, list[Any]], options: dict[str, Any]
) -> Any:
    """A search for each combination of the lists; with a folder, each has its own folder in it."""
    pandas = optional("pandas", "swirl.crossing() of lists")
    rows, searches = [], []
    for values in itertools.product(*lists.values()):
        here = dict(zip(lists, values))
        name = ", ".join(f"{each} {value}" for each, value in here.items()).replace("/", "-")
        folder = None if out is None else os.path.join(os.fspath(out), name)
        found = crossing(folder, **{**options, **here})
        searches.append(found)
        rows.append(
            {
                **here,
                "verdict": found.verdict,
                "N_c": found.discs,
                "N_c_error": found.error,
                "N_c_lower": found.lower,
                "N_c_upper": found.upper,
                "from": found.found["from"],
                "to": found.found["to"],
                "within_tolerance": found.within_tolerance,
                "runs": found.found["runs"],
            }
        )
    table = pandas.DataFrame(rows)
    table.attrs["searches"] = searches
    return table


def crossing(
    out: Optional[PathName] = None,
    *,
    min_discs: int = 5,
    max_discs: int = 48,
    tolerance: float = 0.1,
    min_periods: int = 50,
    rate: str = "mean_by_time",
    threads: int = 0,
    progress: Union[bool, Callable[[str, float], object], None] = None,
    **parameters: Any,
) -> Any:
    lists = _lists(parameters)
    if lists:
        single = {name: value for name, value in parameters.items() if name not in lists}
        return _crossings(
            out,
            lists,
            {
                "min_discs": min_discs,
                "max_discs": max_discs,
                "tolerance": tolerance,
                "min_periods": min_periods,
                "rate": rate,
                "threads": threads,
                "progress": progress,
                **single,
            },
        )
    for name in ("discs", "periods"):
        if parameters.get(name) is not None:
            raise TypeError(
                f"{name} is given, but the search varies it.\n"
                "hint: use min_discs, max_discs and events."
            )
    callback = (
        progress if callable(progress) else (lambda stage, rate: print(stage)) if progress else None
    )
    given: dict[str, Any] = {
        "min_discs": min_discs,
        "max_discs": max_discs,
        "tolerance": tolerance,
        **parameters,
    }
    if rate != "mean_by_time":
        given["rate"] = rate
    if min_periods != 50:
        given["min_periods"] = min_periods
    if out is not None:
        given["out"] = file_name("out", out)
    text, sentence = _engine.crossing(
        given.get("out"),
        parameters,
        count("min_discs", min_discs, 1),
        count("max_discs", max_discs, 1),
        float(tolerance),
        checked_text("rate", rate),
        count("threads", threads, 0),
        call_text("crossing", given),
        callback,
        count("min_periods", min_periods, 1),
    )
    found = json.loads(text)

    def number(name: str) -> float:
        return math.nan if found[name] is None else float(found[name])

    return Crossing(
        found["verdict"],
        number("N_c"),
        number("N_c_error"),
        number("N_c_lower"),
        number("N_c_upper"),
        bool(found["within_tolerance"]),
        found["rate"],
        found["by_rate"],
        found["points"],
        sentence,
        found,
    )


Axis = Union[str, tuple[str, Values]]  # "mu=0:1", ("mu", "0:1") or ("mu", [0, 0.5, 1])


def _axis(name: str, axis: Optional[Axis]) -> dict[str, Values]:
    if axis is None:
        return {}
    if isinstance(axis, str):
        parameter, equals, values = axis.partition("=")
        if parameter and equals and values:
            return {parameter: values}
    elif isinstance(axis, tuple) and len(axis) == 2 and isinstance(axis[0], str):
        return {axis[0]: axis[1]}
    raise TypeError(
        f"{name} is {shown(axis)}, but it must be a text such as 'mu=0:1' or a pair such as "
        "('mu', [0, 0.5, 1])."
    )


def parameter_map(
    out: Optional[PathName] = None,
    *,
    x: Optional[Axis] = None,
    y: Optional[Axis] = None,
    quantity: str = "mean_by_time",
    steps: int = 16,
    level: float = 0.0,
    change: Optional[float] = None,
    replicates: Optional[int] = None,
    grow: bool = False,
    tolerance: float = 0.5,
    rate: str = "mean_by_time",
    min_discs: Optional[int] = None,
    max_discs: Optional[int] = None,
    threads: int = 0,
    progress: Optional[Callable[[int, int, int], object]] = None,
    **parameters: Any,
) -> Any:
    pandas = optional("pandas", "swirl.parameter_map()")
    if out is None:
        if grow:
            raise ValueError("grow is given, but out, the folder of the map, is not.")
        with tempfile.TemporaryDirectory(prefix="swirl-map-") as folder:
            return parameter_map(
                folder,
                x=x,
                y=y,
                quantity=quantity,
                steps=steps,
                level=level,
                change=change,
                replicates=replicates,
                tolerance=tolerance,
                rate=rate,
                min_discs=min_discs,
                max_discs=max_discs,
                threads=threads,
                progress=progress,
                **parameters,
            )

    def counted(name: str, value: Optional[int]) -> Optional[int]:
        return None if value is None else count(name, value, 1)

    folder = file_name("out", out)
    count("threads", threads, 0)
    given = given_values(parameters)
    if grow:
        if given or (quantity, level, change, tolerance, rate) != (
            "mean_by_time",
            0.0,
            None,
            0.5,
            "mean_by_time",
        ):
            raise ValueError(
                "grow adds values of x and y, replicates and numbers of discs; all else stays as it "
                "is.\nhint: use another folder for another map."
            )
        _engine.grow_map(
            folder,
            _axis("x", x),
            _axis("y", y),
            count("steps", steps, 2),
            counted("replicates", replicates),
            counted("min_discs", min_discs),
            counted("max_discs", max_discs),
        )
    elif x is not None or y is not None or given:
        _engine.write_map_plan(
            folder,
            _axis("x", x),
            _axis("y", y),
            quantity,
            rate,
            float(level),
            change,
            float(tolerance),
            count("steps", steps, 2),
            counted("replicates", replicates) or 16,
            counted("min_discs", min_discs) or 5,
            counted("max_discs", max_discs) or 48,
            given,
        )
    elif (quantity, steps, level, change, replicates, tolerance, rate, min_discs, max_discs) != (
        "mean_by_time",
        16,
        0.0,
        None,
        None,
        0.5,
        "mean_by_time",
        None,
        None,
    ):
        raise ValueError(
            "options of the map are given, but x is not.\nhint: give all options of the map, "
            "or only out to continue it."
        )
    elif not exists(os.path.join(folder, "plan.json")):
        raise ValueError("x is missing.\nhint: give an axis, such as x='mu=0:1'.")
    csv, summary, failure = _engine.make_map(folder, threads, progress)
    if failure:
        warnings.warn(
            f"some runs of the map failed; the first is {failure}", SweepWarning, stacklevel=2
        )
    table = pandas.read_csv(io.StringIO(csv), float_precision="round_trip", dtype={"verdict": str})
    table.attrs["summary"] = summary
    return table


def map_runs(
    *,
    replicates: int = 1,
    measure: Optional[Measure] = None,
    threads: int = 0,
    progress: Union[bool, Callable[[int, int], object], None] = None,
    **parameters: Values,
) -> list[Result]:
    plan = _engine.Plan(given_values(parameters), count("replicates", replicates, 1), [], 0)
    count("threads", threads, 0)
    split_measure(measure)  # raises errors before the first run
    points = plan.points()
    bar = Progress(progress if not callable(progress) else None, "runs")
    workers = threads or len(os.sched_getaffinity(0))
    pool = concurrent.futures.ThreadPoolExecutor(workers)
    stopped = threading.Event()

    def stop_if_asked(fraction: float, events: int, periods: float) -> None:
        # Python delivers signals to the waiting thread below; this stops the runs.
        if stopped.is_set():
            raise concurrent.futures.CancelledError

    def run_point(point: dict[str, Any]) -> Result:
        return run(measure=measure, progress=stop_if_asked, **point)

    try:
        futures = [pool.submit(run_point, point) for point in points]
        for done, _ in enumerate(concurrent.futures.as_completed(futures), 1):
            if callable(progress):
                progress(done, len(points))
            elif bar.callback is not None:
                bar.callback(done / len(points), 0, 0.0)
        return [future.result() for future in futures]
    finally:
        stopped.set()
        pool.shutdown(wait=True, cancel_futures=True)
        bar.close()


_LISTS = """    Every parameter may be a list (discs=range(5, 49), mu=[0.1, 0.5, 1]) or a text as on the
    command line ("5:48", "0:0.25:1"); a tuple is one value (mixture=(12, 1.3)).
"""

with_parameters(
    sweep,
    f"""Runs all combinations of parameter lists, or a table of points: `swirl sweep` and `swirl collect`.

    table = swirl.sweep("study", discs=range(5, 49), mu=[0.1, 0.5, 1], replicates=8)
    table = swirl.sweep("pairs", points=[{{"discs": 30, "mu": 0.1}}, {{"discs": 40, "mu": 1, "replicates": 16}}], replicates=8)

Returns a pandas DataFrame (swirl.collect()).

out: folder of the sweep, in the format of the command line. Another call with the same folder makes
    the missing runs; Python and the command line can continue each other's sweeps. Without `out` only
    the table is returned.
points: a table instead of lists: a DataFrame, a list of dictionaries or a dictionary of columns. A column is a
    parameter, or `replicates`, their number in each row. A row with the parameter `seed` has that seed and the next
    ones. Other parameters then have one value for all rows. With grow, rows and replicates are added.
replicates: number of runs of each point. measure: names of measurements. frames_per_period: record every
    run with so many frames. threads: simultaneous runs [one per core]. grow: add these values, replicates
    and measurements to an existing sweep. progress: True for a bar (needs tqdm), or a function of
    (finished runs, all runs, events). chain: a parameter with several values; each run starts from the
    final state of its neighbour, with rising and then with falling values, so that hysteresis shows.
    series: write the averages of every period of each run to the folder `series` in `out`.

{_LISTS}
Ctrl-C raises KeyboardInterrupt; finished runs stay in the folder. A failed run leaves its row empty and
issues a swirl.SweepWarning.
""",
)
with_parameters(
    crossing,
    """Searches the number of discs at which rotation changes to counterrotation: `swirl crossing`.

    c = swirl.crossing(mu=0.5)
    c.discs, c.error, c.sentence

    c.by_rate["rigid_by_time"]["N_c"]
    table = swirl.crossing(mu=[0.3, 0.5, 1], container_radius=[7.5, 8.6])

Returns a swirl.Crossing. If parameters are lists or arrays, each combination is a search, and the result is a pandas
DataFrame with the parameters, N_c and its error; `table.attrs["searches"]` has the complete results.

out: folder for the runs, in the format of the command line; a repeated call continues.
min_discs, max_discs: range of the search. tolerance: target standard error of N_c. min_periods: length of
    the first runs after their warm-up, at least [50]. rate: the rotation rate that decides: mean_by_event, mean_by_time, rigid_by_event or rigid_by_time. threads: simultaneous runs
    [one per core]. progress: True to print, or a function of (current stage, events per second).
    events [2e4]: length of the first runs.
""",
)
with_parameters(
    parameter_map,
    """Maps a quantity over one or two parameters, with runs where it changes its sign: `swirl map`.

    table = swirl.parameter_map("map", x="mu=0:1", y=("amplitude", "0.5:4"))
    curve = swirl.parameter_map(x=("mu", [0.2, 0.5, 1]), quantity="N_c")

Returns a pandas DataFrame with a row for each computed point: the axes, the quantity and its standard error,
the verdict, the periods and the numbers of runs. `table.attrs["summary"]` is the report.

out: folder of the map, in the format of the command line. A repeated call completes it, and without
    further arguments continues it. x, y: axes; a range "0:1" has `steps` values. quantity: N_c, a rotation rate,
    or a number of a measurement, such as "slip.cluster". level: the map is fine where the quantity crosses
    it. change: and where neighbours differ by more [never; N_c 2]. replicates: maximum number of runs at a point [16].
grow: add the values of x and y to an existing map, raise the maximum of runs to replicates, and enlarge the range
    of numbers of discs to min_discs and max_discs.
tolerance, rate, min_discs, max_discs: for N_c, as in swirl.crossing(). threads: simultaneous runs [one per
    core]. progress: a function of (decided points, known points, events). periods [120]: length of each run.
""",
)
with_parameters(
    map_runs,
    f"""Runs all combinations of parameter lists on all cores and returns the complete results.

    results = swirl.map(discs=range(5, 49), measure=[MyMeasurement])

Returns a list of swirl.Result in the order of a sweep's points: replicates vary fastest, then the last
list. Seeds are those of a sweep. If a custom measurement is a class, each run has its own instance;
if it is an object, all threads share it.

{_LISTS}""",
)
