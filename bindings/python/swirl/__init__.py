"""swirl: exact event-driven simulation of swirled granular matter.

    import swirl
    r = swirl.run(discs=48, measure=["density"])        # one run to its averages
    sim = swirl.Simulation(discs=48)                    # a simulation, event by event

Engine and parameters are those of the command line, and results are bitwise identical. Units:
radius of a disc = 1, mass of a disc = 1, speed of the container = 1 (docs/explanation/physics.md).
docs/tutorials/python.md is the guide.
"""

from . import plot as plot
from ._arguments import closed as _closed
from ._display import shown_in_notebooks as _shown_in_notebooks
from ._engine import Event, Failure, FileError, Frames, Snapshot
from ._engine import min_averaged_periods as min_averaged_periods
from ._engine import samples_per_period as samples_per_period
from ._estimates import ArrayEstimate, Estimate, with_error
from ._lab import Lab, lab
from ._points import PointComparison, compare_points
from ._recordings import Analysis, Recording, Tracks, Trajectory, analyse
from ._results import EventCounts, Measured, Result, Rotation, Series, Table
from ._means import SeedMean, is_direction, mean, series_mean
from ._runs import (
    Interrupted,
    Parameter,
    checksum,
    measurements,
    parameters,
    resolve,
    run,
    run_identity,
    version,
)
from ._simulation import EventKind, Simulation, load
from ._study import Crossing, SweepWarning, collect, crossing, parameter_map, sweep
from ._study import map_runs as map
from ._sweep_folder import RunFiles, SweepCounts, SweepFolder
from ._track import VideoTracks, track
from ._zero_crossing import zero_crossing

__version__ = version().split()[0]

__all__ = [
    "Analysis",
    "ArrayEstimate",
    "Crossing",
    "Estimate",
    "Event",
    "EventCounts",
    "EventKind",
    "Failure",
    "FileError",
    "Frames",
    "Interrupted",
    "Lab",
    "Measured",
    "Parameter",
    "PointComparison",
    "Recording",
    "Result",
    "Rotation",
    "RunFiles",
    "SeedMean",
    "Series",
    "Simulation",
    "Snapshot",
    "SweepCounts",
    "SweepFolder",
    "SweepWarning",
    "Table",
    "Tracks",
    "Trajectory",
    "VideoTracks",
    "analyse",
    "checksum",
    "collect",
    "compare_points",
    "crossing",
    "is_direction",
    "lab",
    "load",
    "map",
    "mean",
    "measurements",
    "min_averaged_periods",
    "parameter_map",
    "parameters",
    "plot",
    "resolve",
    "run",
    "run_identity",
    "samples_per_period",
    "series_mean",
    "sweep",
    "track",
    "version",
    "with_error",
    "zero_crossing",
]

for _name in __all__:
    _public = globals()[_name]
    if isinstance(_public, type) and not issubclass(_public, BaseException):
        _shown_in_notebooks(_public)
        # sim.mu = 0 would have no effect. Exceptions are like those of Python, which take any
        # attribute.
        _closed(_public)
