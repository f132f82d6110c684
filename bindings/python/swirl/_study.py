"""Many runs: sweeps, crossings, and a map over them."""

from __future__ import annotations

import concurrent.futures
import dataclasses
import io
import json
import math
import os
import tempfile
import threading
import warnings
from collections.abc import Callable, Sequence
from typing import Any, Optional, Union

from . import _engine
from ._results import Result
from ._runs import (Measure, PathName, Progress, call_text, run, split_measure, with_parameters)

Values = Any  # one value of a parameter, a list or array of them, or a text: "5:48", "0:0.25:1"


class SweepWarning(UserWarning):
    """What a reader of a sweep's table must know of its rows."""


def _names(measure: Optional[Measure], where: str) -> list[str]:
    names, own = split_measure(measure)
    if own:
        raise TypeError(f"{where} takes names of measurements alone; swirl.map() takes your own too.")
    return names


def _count(name: str, value: object, lowest: int) -> int:
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        raise TypeError(f"{name} is {value!r}, but it must be a whole number.")
    number = int(value.__index__())
    if not lowest <= number <= 1_000_000:
        raise ValueError(f"{name} is {number}, but it must be a whole number from {lowest} to "
                         "1000000.")
    return number


def sweep(out: Optional[PathName] = None, *, seeds: int = 1, measure: Optional[Measure] = None,
          frames: int = 0, threads: int = 0, grow: bool = False,
          progress: Union[bool, Callable[[float, float, int], object], None] = None,
          **parameters: Values) -> Any:
    _count("threads", threads, 0)
    if out is None:
        if grow or frames:
            raise ValueError(f"{'grow' if grow else 'frames'} needs a folder, out, which keeps what "
                             "is done.")
        with tempfile.TemporaryDirectory(prefix="swirl-sweep-") as folder:
            return sweep(folder, seeds=seeds, measure=measure, threads=threads, progress=progress,
                         **parameters)
    folder = os.fspath(out)
    names = _names(measure, "A sweep")
    given = {name: value for name, value in parameters.items() if value is not None}
    if grow:
        _engine.grow(folder, given, 0 if seeds == 1 else _count("seeds", seeds, 1), names)
    elif given or names:
        _engine.Plan(given, _count("seeds", seeds, 1), names, _count("frames", frames, 0)).write(folder)
    elif not os.path.exists(os.path.join(folder, "plan.json")):
        raise ValueError("There is nothing to sweep over: give lists, as in discs=range(5, 49), "
                         "mu=[0.1, 0.5, 1].")
    bar = Progress(progress if not callable(progress) else None, "sweep")
    told: Any = progress if callable(progress) else None
    if told is None and bar.told is not None:
        shown = bar.told

        def told(done: float, runs: float, events: int) -> None:
            shown(done / runs if runs else 1.0, events, 0.0)
    try:
        _, failed, _, first_failure = _engine.sweep(folder, threads, told)
    finally:
        bar.close()
    if failed:
        warnings.warn(f"{failed} of the runs could not be done, the first is {first_failure}",
                      SweepWarning, stacklevel=2)
    return collect(folder)


def collect(out: PathName) -> Any:
    """The table of what a sweep has found so far: a pandas DataFrame, as `swirl collect` writes it.

    A row for each combination of parameters: mean and standard error, within and between the
    replicas, of the rotation and of every number that was measured. `table.attrs["runs"]` counts
    those that are planned, done, running and failed.
    """
    import pandas
    csv, points, done, running, failed, disagreeing, not_steady, without = _engine.collect(
        os.fspath(out))
    # A hash may look like a number, 12345678e9012345 for one.
    table = pandas.read_csv(io.StringIO(csv), float_precision="round_trip",
                            dtype={"state_hash": str, "steady_state": str})
    table.attrs["runs"] = {"planned": points, "done": done, "running": running, "failed": failed}
    table.attrs["disagreeing"] = disagreeing
    table.attrs["not_steady"] = not_steady
    if without:
        warnings.warn(f"{without} of the runs made no whole swirl after the warm-up; there is nothing "
                      "to average of them. More events would be right.", SweepWarning, stacklevel=2)
    return table


@dataclasses.dataclass(frozen=True)
class Crossing:
    """Where rotation turns into counterrotation: N_c ± error, 95 % between lower and upper.

    `verdict` says whether it does at all; `sentence` reports it with the evidence. `discs` and `error` are
    NaN if only the bracket from lower to upper is known. All these are by the rotation rate `rate`.
    `by_rate` has the same for each of the four rates: N_c, N_c_error, N_c_lower, N_c_upper, every change
    of sign, and the numbers whose sign is undetermined. `points` are rows of discs, the rotation by `rate`
    (mean, error), that by each of the four, and how many runs it rests on.
    """

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

    def __str__(self) -> str:
        return self.sentence


def crossing(*, fewest: int = 5, most: int = 48, tolerance: float = 0.3,
             rate: str = "by_time", threads: int = 0,
             progress: Union[bool, Callable[[str, float], object], None] = None,
             **parameters: Any) -> Crossing:
    for name in ("discs", "periods"):
        if parameters.get(name) is not None:
            raise TypeError(f"{name} is given, but a crossing is looked for from `fewest` to `most` "
                            "discs, with runs of so many events.")
    told = progress if callable(progress) else (lambda stage, rate: print(stage)) if progress else None
    said: dict[str, Any] = {"fewest": fewest, "most": most, "tolerance": tolerance, **parameters}
    if rate != "by_time":
        said["rate"] = rate
    text, sentence = _engine.crossing(parameters, _count("fewest", fewest, 1), _count("most", most, 1),
                                      float(tolerance), rate, _count("threads", threads, 0),
                                      call_text("crossing", said), told)
    found = json.loads(text)

    def number(name: str) -> float:
        return math.nan if found[name] is None else float(found[name])

    return Crossing(found["verdict"], number("N_c"), number("N_c_error"), number("N_c_lower"),
                    number("N_c_upper"), bool(found["within_tolerance"]), found["rate"],
                    found["by_rate"], found["points"], sentence, found)


def map_runs(*, seeds: int = 1, measure: Optional[Measure] = None, threads: int = 0,
             progress: Union[bool, Callable[[int, int], object], None] = None,
             **parameters: Values) -> list[Result]:
    plan = _engine.Plan({name: value for name, value in parameters.items() if value is not None},
                        _count("seeds", seeds, 1), [], 0)
    _count("threads", threads, 0)
    split_measure(measure)  # what is wrong is said before anything is run
    points = plan.points()
    bar = Progress(progress if not callable(progress) else None, "runs")
    workers = threads or len(os.sched_getaffinity(0))
    pool = concurrent.futures.ThreadPoolExecutor(workers)
    left = threading.Event()

    def go_on(fraction: float, events: int, periods: float) -> None:
        # Signals go to the thread that waits below; the others hear of it here.
        if left.is_set():
            raise concurrent.futures.CancelledError

    def once(point: dict[str, Any]) -> Result:
        return run(measure=measure, progress=go_on, **point)

    try:
        futures = [pool.submit(once, point) for point in points]
        for done, _ in enumerate(concurrent.futures.as_completed(futures), 1):
            if callable(progress):
                progress(done, len(points))
            elif bar.told is not None:
                bar.told(done / len(points), 0, 0.0)
        return [future.result() for future in futures]
    finally:
        left.set()
        pool.shutdown(wait=True, cancel_futures=True)
        bar.close()


_LISTS = """    Every parameter may be a list (discs=range(5, 49), mu=[0.1, 0.5, 1]) or a text as on the
    command line ("5:48", "0:0.25:1"); a tuple is one value (mixture=(12, 1.3)).
"""

with_parameters(sweep, f"""Many runs, the product of lists, on all cores: `swirl sweep` and `collect`.

    table = swirl.sweep("study", discs=range(5, 49), mu=[0.1, 0.5, 1], seeds=8)

Returns a pandas DataFrame (swirl.collect()).

out: the folder of the sweep, the same as the command line's: called again, it does what is missing,
    and either goes on with what the other has begun. Without it nothing is kept but the table.
seeds: replicas of each point. measure: names. frames: record every run, so many frames per swirl.
threads: runs at the same time [one for each core]. grow: add these values, replicas and measurements.
progress: True for a bar (with tqdm), or a function of (runs done, runs in all, events).

{_LISTS}
Ctrl-C raises KeyboardInterrupt; what is done stays in the folder. A run that could not be done leaves
its place empty, and a swirl.SweepWarning says so.
""")
with_parameters(crossing, """The number of discs at which rotation turns into counterrotation: `swirl crossing`.

    c = swirl.crossing(mu=0.5)
    c.discs, c.error, c.sentence

    c.by_rate["rigid_by_time"]["N_c"]

fewest, most: the range of discs. tolerance: wanted standard error of N_c. rate: the rotation rate whose
sign and tolerance decide, by_event, by_time, rigid_by_event or rigid_by_time. threads: [all cores].
progress: True to print, or a function of (what is done now, events per second). events [2e5] is the
length of the first runs.
""")
with_parameters(map_runs, f"""Runs for the product of lists, on all cores, each with its whole result.

    results = swirl.map(discs=range(5, 49), measure=[MyMeasurement])

A list of swirl.Result, in the order of a sweep's points (the last list running fastest, then the
replica); the seeds are those of a sweep. A measurement of your own that is a class gets an instance
for each run; one that is an object is shared by threads.

{_LISTS}""")
