"""The compiled module (bindings/python/*.cpp). tests/python/stubs_test.py makes this file of its
docstrings."""

from collections.abc import Callable, Sequence
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from ._results import Report

_Floats = npt.NDArray[np.float64]
_Estimate = tuple[float, float, float, int]  # mean, error, effective samples, blocks
_Curve = list[tuple[float, float, float]]  # N, mean, error
_SeriesColumns = tuple[list[str], list[str], list[str], _Floats]

class Failure(RuntimeError):
    """The call was valid, but the run failed."""

class FileError(OSError):
    """A file is missing, damaged or of another kind."""

class Snapshot:
    """All discs and the container at one instant in the lab frame. The swirl centre is the
    origin.

    Lengths are in disc radii, and the container's speed is 1. A value that is not available is NaN,
    such as the spin of a disc in a camera's tracks. Arrays are read-only views that keep their data
    alive and never change."""

    @property
    def position(self) -> _Floats:
        """[disc, xy]"""
    @property
    def velocity(self) -> _Floats:
        """[disc, xy]"""
    @property
    def angle(self) -> _Floats:
        """[disc], in radians, not reduced to one turn"""
    @property
    def spin(self) -> _Floats:
        """[disc], counter-clockwise, in radians per unit of time"""
    @property
    def radius(self) -> _Floats:
        """[disc]"""
    @property
    def mass(self) -> _Floats:
        """[disc]"""
    @property
    def inertia(self) -> _Floats:
        """[disc]"""
    @property
    def can_spin(self) -> _Floats:
        """[disc], 1, or 0 for a particle that cannot spin"""
    @property
    def container_centre(self) -> _Floats:
        """[xy]"""
    @property
    def container_velocity(self) -> _Floats:
        """[xy]"""
    @property
    def container_radius(self) -> float: ...
    @property
    def period(self) -> float: ...
    @property
    def pinned(self) -> _Floats:
        """[disc], 1 if the disc is pinned, 0 if not

        NaN if that is unknown: it takes the frames before and after, at least 400 per period."""
    @property
    def resident(self) -> _Floats:
        """[disc], 1 if the disc is resident at the wall, 0 if not

        NaN if that is unknown: it takes the frames before and after, at least 120 per period."""
    @property
    def rolling_spin(self) -> Optional[_Floats]:
        """[disc, xy], horizontal angular velocity of spheres; None for discs"""
    @property
    def whole_periods(self) -> int:
        """Whole periods since the start."""
    @property
    def clock(self) -> float:
        """The time since the last whole period."""
    @property
    def time(self) -> float:
        """The time since the start: whole_periods * period + clock."""
    def m_frame(self) -> Snapshot:
        """The snapshot in the M-frame, which rotates with the swirl (src/swirl/measure/m_frame.hpp): the
        container rests at the origin, and the wall's point farthest from the swirl centre is at the
        bottom."""
    def rotation(self) -> tuple[float, float]:
        """The cluster's rotation rate in units of Ω: the paper's mean over discs, and that of the
        best-fitting rigid body (src/swirl/measure/cluster_rotation.hpp)."""
    def to_bytes(self) -> bytes: ...
    def __len__(self) -> int: ...
    def to_pandas(self) -> Any:
        """A pandas DataFrame, one row per disc."""
    def to_xarray(self) -> Any:
        """An xarray Dataset with the dimensions disc and xy."""
    def plot(self, *, ax: Any = None, **style: Any) -> Any:
        """Draws the discs; returns the axes. `style` is that of swirl.plot.snapshot()."""
    def _repr_svg_(self, width: int = 320) -> str:
        """The container in the frame of the snapshot, y upwards. A line in each disc shows its
        angle."""

class Frames:
    """Snapshots of the same discs in order of time, as columns: frames.position[frame, disc].

    frames[k] is a Snapshot. Arrays are read-only views that keep their data alive and never change.
    """

    @property
    def position(self) -> _Floats:
        """[frame, disc, xy]"""
    @property
    def velocity(self) -> _Floats:
        """[frame, disc, xy]"""
    @property
    def angle(self) -> _Floats:
        """[frame, disc], in radians, not reduced to one turn"""
    @property
    def spin(self) -> _Floats:
        """[frame, disc], counter-clockwise, in radians per unit of time"""
    @property
    def radius(self) -> _Floats:
        """[disc]"""
    @property
    def mass(self) -> _Floats:
        """[disc]"""
    @property
    def inertia(self) -> _Floats:
        """[disc]"""
    @property
    def can_spin(self) -> _Floats:
        """[disc], 1, or 0 for a particle that cannot spin"""
    @property
    def container_centre(self) -> _Floats:
        """[frame, xy]"""
    @property
    def container_velocity(self) -> _Floats:
        """[frame, xy]"""
    @property
    def container_radius(self) -> float: ...
    @property
    def period(self) -> float: ...
    @property
    def pinned(self) -> _Floats:
        """[frame, disc], 1 if the disc is pinned, 0 if not

        NaN if that is unknown: it takes the frames before and after, at least 400 per period."""
    @property
    def resident(self) -> _Floats:
        """[frame, disc], 1 if the disc is resident at the wall, 0 if not

        NaN if that is unknown: it takes the frames before and after, at least 120 per period."""
    @property
    def whole_periods(self) -> npt.NDArray[np.int64]:
        """[frame]"""
    @property
    def clock(self) -> _Floats:
        """[frame]"""
    @property
    def time(self) -> _Floats:
        """[frame]"""
    @property
    def discs(self) -> int: ...
    def m_frame(self) -> Frames:
        """All frames in the M-frame, as Snapshot.m_frame()."""
    def to_bytes(self) -> bytes: ...
    def __len__(self) -> int: ...
    def __getitem__(self, k: int) -> Snapshot: ...
    def to_pandas(self) -> Any:
        """A pandas DataFrame, one row per disc of each frame."""
    def to_xarray(self) -> Any:
        """An xarray Dataset with the dimensions frame, disc and xy."""
    def _repr_html_(self) -> str: ...

class Event:
    """An event: its kind (EventKind), its time, and the discs i and j (j = i at the wall)."""

    @property
    def whole_periods(self) -> int: ...
    @property
    def clock(self) -> float: ...
    @property
    def kind(self) -> int: ...
    @property
    def i(self) -> int: ...
    @property
    def j(self) -> int: ...
    @property
    def normal(self) -> tuple[float, float]:
        """Unit vector from i to j, or from i to the wall."""
    @property
    def normal_impulse(self) -> float:
        """Impulse on j or on the wall, along the normal."""
    @property
    def tangential_impulse(self) -> float:
        """Impulse on j or on the wall, along (n_y, −n_x)."""
    @property
    def overlap(self) -> float:
        """Depth of the contact: a rounding error."""
    def _repr_html_(self) -> str: ...

class Simulation:
    def __init__(
        self,
        parameters: dict[str, Any],
        discs: dict[str, _Floats],
        path: Optional[_Floats],
        path_times: Optional[_Floats],
    ) -> None: ...
    def step(self, count: int) -> npt.NDArray[np.void]: ...
    def next(self) -> Event: ...
    def run(self, count: int) -> None: ...
    def advance(self, time: float) -> None: ...
    def advance_periods(self, number: float) -> None: ...
    def advance_to(self, whole_periods: int, clock: float) -> None: ...
    def sample(self, count: int, per_period: int) -> Frames: ...
    def snapshot(self) -> Snapshot: ...
    def to_bytes(self) -> bytes: ...
    @staticmethod
    def from_bytes(data: bytes) -> Simulation: ...
    def config(self) -> str: ...
    @property
    def is_custom(self) -> bool: ...
    @property
    def period(self) -> float: ...
    @property
    def time(self) -> float: ...
    @property
    def container_radius(self) -> float: ...
    def path(self) -> list[float]: ...
    def __len__(self) -> int: ...
    def counts(self) -> tuple[int, int, int, int, int]: ...
    def now(self) -> tuple[int, float]: ...
    def state_hash(self) -> str: ...

class Plan:
    def __init__(
        self,
        parameters: dict[str, Any],
        replicates: int,
        measured: list[str],
        frames: int,
        chain: str = "",
        series: bool = False,
        rows: Optional[list[dict[str, Any]]] = None,
    ) -> None: ...
    def __len__(self) -> int: ...
    @property
    def axes(self) -> dict[str, list[str]]: ...
    def points(self) -> list[dict[str, str]]: ...
    def write(self, folder: str) -> None: ...

class Recording:
    @staticmethod
    def open(file: str) -> Recording: ...
    @staticmethod
    def tracks(
        frame: npt.NDArray[Any],
        particle: npt.NDArray[Any],
        x: npt.NDArray[Any],
        y: npt.NDArray[Any],
        radius: npt.NDArray[Any],
        time: npt.NDArray[Any],
        scale: dict[str, Any],
        max_invalid: float,
    ) -> Recording: ...
    @staticmethod
    def read_tracks(file: str) -> dict[str, npt.NDArray[Any]]: ...
    @staticmethod
    def of_frames(frames: Frames) -> Recording: ...
    def __len__(self) -> int: ...
    def frames(self, begin: int, end: int, step: int) -> Frames: ...
    @property
    def same_discs(self) -> bool: ...
    @property
    def complete(self) -> bool: ...
    @property
    def remarks(self) -> str: ...
    def about(self) -> dict[str, str]: ...
    def analyse(
        self, measured: list[str], all: bool, warmup: float
    ) -> tuple[list[Report], _Estimate, _Estimate, int, str]: ...

event_dtype: np.dtype[np.void]
samples_per_period: int
min_averaged_periods: float

def write_file(path: str, content: bytes) -> None: ...
def snapshot_from_bytes(data: bytes) -> Snapshot: ...
def frames_from_bytes(data: bytes) -> Frames: ...
def run(
    parameters: dict[str, Any],
    measured: list[str],
    command: str,
    progress: Optional[Callable[[float, int, float], object]],
    frames_per_period: int,
    period_ended: Optional[Callable[[Frames], None]],
    files: dict[str, Any],
    series: bool,
) -> tuple[str, list[Report], Optional[BaseException], str, str, Optional[_SeriesColumns]]: ...
def resolve(parameters: dict[str, Any]) -> str: ...
def measurement_list(names: str) -> list[str]: ...
def measurement_kinds() -> list[tuple[str, str, str]]: ...
def estimates(sums: _Floats, weights: _Floats) -> tuple[_Floats, _Floats, _Floats]: ...
def with_error(mean: float, error: float) -> str: ...
def shortened(text: str) -> str: ...
def parameters() -> list[tuple[str, str, str, str, str, float, float, str]]: ...
def version() -> str: ...
def build_description() -> str: ...
def over_replicates(
    means: npt.ArrayLike,
    errors: npt.ArrayLike,
    effective: npt.ArrayLike,
    weights: Sequence[float],
    directions: bool,
) -> tuple[_Floats, _Floats, _Floats, _Floats, _Floats]: ...
def is_direction(name: str) -> bool: ...
def replicate_weights(periods: Sequence[float], by_time: bool) -> list[float]: ...
def zero_crossing(
    discs: Sequence[float], means: Sequence[float], errors: Sequence[float]
) -> dict[str, Any]: ...
def read_own_points(file: str, period: Optional[float]) -> _Curve: ...
def compare_curves(
    parameters: list[float], curves: list[_Curve], measured: _Curve
) -> tuple[_Curve, list[float], Optional[tuple[float, float, float, float, int, bool]]]: ...
def estimate_of_series(values: Sequence[float]) -> tuple[float, float, float, float]: ...
def checksum(text: str) -> str: ...
def grow(
    folder: str,
    more: dict[str, Any],
    replicates: int,
    measured: Sequence[str],
    rows: Optional[list[dict[str, Any]]],
) -> None: ...
def run_identity(parameters: dict[str, Any]) -> str: ...
def result_files(
    folder: str, rows: list[dict[str, Any]], replicates: int
) -> list[list[tuple[str, str]]]: ...
def sweep(
    folder: str,
    threads: int,
    progress: Optional[Callable[[float, float, int], object]],
    rows: Optional[list[dict[str, Any]]] = None,
) -> tuple[int, int, int, str]: ...
def collect(folder: str) -> tuple[str, int, int, int, int, int, int, int, str]: ...
def crossing(
    folder: Optional[str],
    parameters: dict[str, Any],
    min_discs: int,
    max_discs: int,
    tolerance: float,
    rate: str,
    threads: int,
    command: str,
    progress: Optional[Callable[[str, float], object]],
    min_periods: int = 50,
) -> tuple[str, str]: ...
def write_map_plan(
    folder: str,
    x: dict[str, Any],
    y: dict[str, Any],
    quantity: str,
    rate: str,
    level: float,
    change: Optional[float],
    tolerance: float,
    steps: int,
    replicates: int,
    min_discs: int,
    max_discs: int,
    parameters: dict[str, Any],
) -> None: ...
def grow_map(
    folder: str,
    x: dict[str, Any],
    y: dict[str, Any],
    steps: int,
    replicates: Optional[int],
    min_discs: Optional[int],
    max_discs: Optional[int],
) -> None: ...
def make_map(
    folder: str, threads: int, progress: Optional[Callable[[int, int, int], object]]
) -> tuple[str, str, str]: ...
