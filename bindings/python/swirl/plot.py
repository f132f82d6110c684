"""Plots with matplotlib. Every function draws into the given axes, or into new ones, and returns them.
Nothing is shown or saved.

    import swirl, swirl.plot
    swirl.plot.snapshot(sim.snapshot(), color="spin")
    swirl.plot.density(result)
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, Optional, Union

import numpy as np

from . import _engine
from ._arguments import shown
from ._optional import optional
from ._estimates import Estimate
from ._results import Measured, Result, Table
from ._simulation import Simulation

Axes = Any  # matplotlib has no types in Debian 12


def _axes(axes: Optional[Axes]) -> Axes:
    if axes is not None:
        return axes
    return optional("matplotlib.pyplot", "swirl.plot").subplots(constrained_layout=True)[1]


def snapshot(source: Union[_engine.Snapshot, Simulation], *, axes: Optional[Axes] = None,
             m_frame: bool = False, color: Any = "tab:blue", velocities: bool = False) -> Axes:
    """The discs in their container, in the lab frame or the M-frame.

    color: one colour for all discs, "spin" (in units of Ω) or "speed" (in units of the container's
    speed) with a colour bar, or one number per disc. velocities: draw arrows of the distance that a
    disc moves in a tenth of the period.
    """
    EllipseCollection = optional("matplotlib.collections", "swirl.plot").EllipseCollection
    Circle = optional("matplotlib.patches", "swirl.plot").Circle
    s = source.snapshot() if isinstance(source, Simulation) else source
    if not isinstance(s, _engine.Snapshot):
        raise TypeError(f"source is {shown(source)}, but it must be a swirl.Snapshot or a swirl.Simulation.\n"
                        "hint: sim.snapshot() and recording[k] are snapshots; a result has averages only.")
    if m_frame:
        s = s.m_frame()
    axes = _axes(axes)
    x, y = s.container_centre
    axes.add_patch(Circle((x, y), s.container_radius, facecolor="none", edgecolor="0.2", lw=1.5))
    widths = 2.0 * s.radius
    # matplotlib stores and modifies its argument, but views of a snapshot are read-only.
    discs = EllipseCollection(widths, widths, np.zeros(len(s)), units="x", offsets=s.position.copy(),
                              offset_transform=axes.transData, edgecolor="0.2", lw=0.6)
    label = None
    if isinstance(color, str) and color == "spin":
        color, label = s.spin * s.period / (2.0 * math.pi), "spin / Ω"
    elif isinstance(color, str) and color == "speed":
        color, label = np.hypot(*s.velocity.T), "speed"
    if isinstance(color, str):
        discs.set_facecolor(color)
    else:
        values = np.asarray(color, dtype=float)
        if values.shape != (len(s),):
            raise ValueError(f"color has {values.size} values, but there are {len(s)} discs.")
        discs.set_array(values)
        if label == "spin / Ω":
            limit = float(np.nanmax(np.abs(values), initial=1e-12))
            discs.set_cmap("RdBu_r")
            discs.set_clim(-limit, limit)
    axes.add_collection(discs)
    if label:
        axes.figure.colorbar(discs, ax=axes, label=label)
    if velocities:
        axes.quiver(*s.position.T, *(0.1 * s.period * s.velocity.T), angles="xy", scale_units="xy",
                    scale=1, width=0.003)
    reach = 1.04 * s.container_radius
    axes.set(xlim=(x - reach, x + reach), ylim=(y - reach, y + reach),
             aspect="equal", xlabel="x / r", ylabel="y / r")
    return axes


def _table(found: Any, name: str) -> Table:
    """The table in a result or in one of its measurements, or the table itself."""
    if isinstance(found, Table):
        return found
    if not isinstance(found, Measured):
        measured = getattr(found, "measured", None)
        if measured is None:
            raise TypeError(f"found is {shown(found)}, but it must be a result, a measurement or a table.")
        if name not in measured:
            raise ValueError(f"the result has no '{name}'.\nhint: use swirl.run(measure=[\"{name}\"]).")
        found = measured[name]
    table: Table = found.table
    return table


def density(found: Any, *, by: str = "time", axes: Optional[Axes] = None) -> Axes:
    """The density map in the M-frame, averaged by "time" or "event". `found` is a result with the
    measurement "density"."""
    table = _table(found, "density")
    if by not in ("time", "event"):
        raise ValueError(f"by is {shown(by)}, but it must be 'time' or 'event'.")
    axes = _axes(axes)
    x, y = table.axes["x"], table.axes["y"]
    drawn = axes.pcolormesh(x, y, table[f"by_{by}"], cmap="magma", shading="nearest")
    axes.figure.colorbar(drawn, ax=axes, label="density · r²")
    _round(axes, x, y)
    return axes


def flow(found: Any, *, axes: Optional[Axes] = None) -> Axes:
    """Velocities relative to the container in the M-frame. `found` is a result with the measurement
    "flow"."""
    table = _table(found, "flow")
    axes = _axes(axes)
    x, y = table.axes["x"], table.axes["y"]
    u, v = table["u_x"], table["u_y"]
    drawn = axes.quiver(x, y, u, v, np.hypot(u, v), cmap="viridis")
    axes.figure.colorbar(drawn, ax=axes, label="speed relative to the container")
    _round(axes, x, y)
    return axes


def _round(axes: Axes, x: Any, y: Any) -> None:
    Circle = optional("matplotlib.patches", "swirl.plot").Circle
    # The cells cover the container's bounding square.
    radius = x[-1] + 0.5 * (x[1] - x[0])
    axes.add_patch(Circle((0, 0), radius, facecolor="none", edgecolor="0.5"))
    axes.set(aspect="equal", xlabel="$x_M$ / r", ylabel="$y_M$ / r", xlim=(-radius, radius),
             ylim=(-radius, radius))


def profile(found: Any, column: str = "varpi_m", *, axes: Optional[Axes] = None) -> Axes:
    """A column of "profile" or of another table against its axis, with its error as a band."""
    table = _table(found, "profile")
    axes = _axes(axes)
    ((name, at),) = table.axes.items()
    values = table[column]
    axes.plot(at, values, label=column)
    if f"{column}_error" in table:
        error = table[f"{column}_error"]
        axes.fill_between(at, values - error, values + error, alpha=0.3)
    axes.set(xlabel=f"{name} ({table.units[name]})", ylabel=f"{column} ({table.units[column]})")
    return axes


def rotation(runs: Any, *, against: str = "discs", by: Optional[str] = None,
             axes: Optional[Axes] = None, label: Optional[str] = None) -> Axes:
    """The rotation rate ϖ/Ω, averaged by time, against a parameter.

    runs: the table of swirl.sweep(), with a line for each value of the column `by`; or results, such as
    those of swirl.map().
    """
    axes = _axes(axes)
    if hasattr(runs, "groupby"):
        groups = [(None, runs)] if by is None else list(runs.groupby(by))
        for value, rows in groups:
            rows = rows.sort_values(against)
            axes.errorbar(rows[against], rows["mean_by_time"], rows["mean_by_time_error"], marker="o", ms=3,
                          lw=1, capsize=2, label=label if value is None else f"{by} = {value}")
    else:
        points = sorted((_parameter(r, against), r.rotation.mean_by_time) for r in _results(runs))
        at = [point[0] for point in points]
        found: list[Estimate] = [point[1] for point in points]
        axes.errorbar(at, [e.mean for e in found], [e.error for e in found], marker="o", ms=3, lw=1,
                      capsize=2, label=label)
    axes.axhline(0, color="0.6", lw=0.8)
    axes.set(xlabel=against, ylabel="ϖ / Ω")
    if axes.get_legend_handles_labels()[0]:
        axes.legend()
    return axes


def _results(runs: Any) -> list[Result]:
    results = list(runs) if isinstance(runs, Iterable) else [runs]
    if not all(isinstance(r, Result) for r in results):
        raise TypeError("runs must be the table of swirl.sweep() or results of runs.")
    return results


def _parameter(result: Result, name: str) -> float:
    if name not in result.config:
        raise ValueError(f"the results have no parameter '{name}'.")
    return float(result.config[name])
