"""The folder of a sweep: its plan, its runs and their files."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any, NamedTuple, Optional

from . import _engine
from ._arguments import file_name
from ._files import exists
from ._points_table import count, given_values, names_of, rows_of
from ._runs import Measure, PathName

Values = Any  # one value of a parameter, a list or array of them, or a text: "5:48", "0:0.25:1"


class RunFiles(NamedTuple):
    """The files of one run of a sweep. `result` exists if it is done, `failure` if it failed."""

    result: str
    failure: str


class SweepCounts(NamedTuple):
    """The numbers of runs after a call of SweepFolder.run().

    `elsewhere` are those that another process makes. `first_failure` is the reason of the first
    failed run, or empty.
    """

    done: int
    failed: int
    elsewhere: int
    first_failure: str


class SweepFolder:
    """The folder of a sweep, in the format of the command line: swirl.sweep() in steps.

        folder = swirl.SweepFolder("study")
        folder.plan(points=[{"discs": 28}, {"discs": 30, "mu": 0.5, "replicates": 8}], measure="slip")
        folder.run(threads=2)
        table = swirl.collect("study")

    A folder that does not exist is made by plan(). Several processes may run one folder at once:
    each run is made once.
    """

    __slots__ = ("_path",)

    def __init__(self, path: PathName) -> None:
        self._path = file_name("path", path)

    @property
    def path(self) -> str:
        """The name of the folder."""
        return self._path

    @property
    def is_planned(self) -> bool:
        """True if the folder has a plan."""
        return exists(os.path.join(self._path, "plan.json"))

    def __repr__(self) -> str:
        return f"<swirl.SweepFolder {self._path!r}{'' if self.is_planned else ', without a plan'}>"

    def plan(
        self,
        *,
        points: Any = None,
        replicates: int = 1,
        measure: Optional[Measure] = None,
        frames_per_period: int = 0,
        chain: Optional[str] = None,
        series: bool = False,
        **parameters: Values,
    ) -> None:
        """Writes the plan. The arguments are those of swirl.sweep().

        Raises swirl.Failure if the folder has another plan."""
        rows, names = rows_of(points), names_of(measure, "A sweep")
        given = given_values(parameters)
        _engine.Plan(
            given,
            count("replicates", replicates, 1),
            names,
            count("frames_per_period", frames_per_period, 0),
            chain or "",
            bool(series),
            rows,
        ).write(self._path)

    def grow(
        self,
        *,
        points: Any = None,
        replicates: int = 1,
        measure: Optional[Measure] = None,
        **parameters: Values,
    ) -> None:
        """Adds points, values, replicates or measurements to the plan; finished runs are kept.

        `replicates` is their new number for all points, or for the new `points`."""
        rows, names = rows_of(points), names_of(measure, "A sweep")
        given = given_values(parameters)
        total = 0 if replicates == 1 else count("replicates", replicates, 1)
        _engine.grow(self._path, given, total, names, rows)

    def run(
        self,
        *,
        points: Any = None,
        threads: int = 0,
        progress: Optional[Callable[[float, float, int], object]] = None,
    ) -> SweepCounts:
        """Makes the missing runs: all, or those of some points in this order.

        threads: simultaneous runs [one per core]. progress: a function of (finished runs, all runs,
        events). A failed run raises no exception. Ctrl-C raises KeyboardInterrupt, and finished
        runs stay."""
        rows = rows_of(points)
        return SweepCounts(*_engine.sweep(self._path, count("threads", threads, 0), progress, rows))

    def files(self, points: Any, *, replicates: int = 1) -> list[list[RunFiles]]:
        """The files of the runs of each point, one for each seed; none if the plan lacks them."""
        rows = rows_of(points) or []
        found = _engine.result_files(self._path, rows, count("replicates", replicates, 1))
        return [[RunFiles(*files) for files in runs] for runs in found]
