"""Plots with matplotlib. Every function draws into the axes `ax`, or into new ones, and returns
them. Nothing is shown or saved. Results, tables, series, crossings and snapshots have a method
plot(), which calls these.

    import swirl, swirl.plot
    swirl.plot.snapshot(sim.snapshot(), color="spin")
    swirl.plot.density(result)
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, Optional, Union

import numpy as np

from . import _engine, _look
from ._arguments import shown
from ._optional import optional
from ._estimates import Estimate, with_error
from ._results import Measured, Result, Series, Table
from ._recordings import Analysis
from ._simulation import Simulation
from ._study import Crossing

Axes = Any  # matplotlib has no types in Debian 12


def _axes(axes: Optional[Axes]) -> Axes:
    if axes is not None:
        return axes
    return optional("matplotlib.pyplot", "swirl.plot").subplots(constrained_layout=True)[1]


def _directions() -> Any:
    """The colours of signed rates: clockwise, none, counter-clockwise."""
    ends = [_look.AGAINST, _look.NEUTRAL, _look.WITH]
    colors = optional("matplotlib.colors", "swirl.plot")
    return colors.LinearSegmentedColormap.from_list("directions", ends)


def snapshot(
    source: Union[_engine.Snapshot, Simulation],
    *,
    ax: Optional[Axes] = None,
    m_frame: bool = False,
    color: Any = "tab:blue",
    velocities: bool = False,
) -> Axes:
    """The discs in their container, in the lab frame or the M-frame.

    color: one colour for all discs, "spin" (in units of Ω) or "speed" (in units of the container's
    speed) with a colour bar, or one number per disc. velocities: draw arrows of the distance that a
    disc moves in a tenth of the period.
    """
    EllipseCollection = optional("matplotlib.collections", "swirl.plot").EllipseCollection
    Circle = optional("matplotlib.patches", "swirl.plot").Circle
    s = source.snapshot() if isinstance(source, Simulation) else source
    if not isinstance(s, _engine.Snapshot):
        raise TypeError(
            f"source is {shown(source)}, but it must be a swirl.Snapshot or a swirl.Simulation.\n"
            "hint: sim.snapshot() and recording[k] are snapshots; a result has averages only."
        )
    if m_frame:
        s = s.m_frame()
    axes = _axes(ax)
    x, y = s.container_centre
    axes.add_patch(Circle((x, y), s.container_radius, facecolor="none", edgecolor="0.2", lw=1.5))
    widths = 2.0 * s.radius
    # matplotlib stores and modifies its argument, but views of a snapshot are read-only.
    discs = EllipseCollection(
        widths,
        widths,
        np.zeros(len(s)),
        units="x",
        offsets=s.position.copy(),
        offset_transform=axes.transData,
        edgecolor="0.2",
        lw=0.6,
    )
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
            discs.set_cmap(_directions())
            discs.set_clim(-limit, limit)
    axes.add_collection(discs)
    if label:
        axes.figure.colorbar(discs, ax=axes, label=label)
    if velocities:
        axes.quiver(
            *s.position.T,
            *(0.1 * s.period * s.velocity.T),
            angles="xy",
            scale_units="xy",
            scale=1,
            width=0.003,
        )
    reach = 1.04 * s.container_radius
    axes.set(
        xlim=(x - reach, x + reach),
        ylim=(y - reach, y + reach),
        aspect="equal",
        xlabel="x / r",
        ylabel="y / r",
    )
    return axes


def _require(found: object, kinds: tuple[type, ...], words: str) -> None:
    if not isinstance(found, kinds):
        raise TypeError(f"found is {shown(found)}, but it must be {words}.")


def _table(found: Any, name: str) -> Table:
    """The table in a result or in one of its measurements, or the table itself."""
    if isinstance(found, Table):
        return found
    if not isinstance(found, Measured):
        measured = getattr(found, "measured", None)
        if measured is None:
            raise TypeError(
                f"found is {shown(found)}, but it must be a result, a measurement or a table."
            )
        if name not in measured:
            raise ValueError(
                f"the result has no '{name}'.\nhint: use swirl.run(measure=[\"{name}\"])."
            )
        found = measured[name]
    table: Table = found.table
    return table


def density(found: Any, *, by: str = "time", ax: Optional[Axes] = None) -> Axes:
    """The density map in the M-frame, averaged by "time" or "event". `found` is a result with the
    measurement "density"."""
    table = _table(found, "density")
    if by not in ("time", "event"):
        raise ValueError(f"by is {shown(by)}, but it must be 'time' or 'event'.")
    axes = _axes(ax)
    x, y = table.axes["x"], table.axes["y"]
    drawn = axes.pcolormesh(x, y, table[f"by_{by}"], cmap="magma", shading="nearest")
    axes.figure.colorbar(drawn, ax=axes, label="density · r²")
    _round(axes, x, y)
    return axes


def flow(found: Any, *, ax: Optional[Axes] = None) -> Axes:
    """Velocities relative to the container in the M-frame. `found` is a result with the measurement
    "flow"."""
    table = _table(found, "flow")
    axes = _axes(ax)
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
    axes.set(
        aspect="equal",
        xlabel="$x_M$ / r",
        ylabel="$y_M$ / r",
        xlim=(-radius, radius),
        ylim=(-radius, radius),
    )


def profile(found: Any, column: str = "varpi_m", *, ax: Optional[Axes] = None) -> Axes:
    """A column of "profile" or of another table against its axis, with its error as a band."""
    table = _table(found, "profile")
    axes = _axes(ax)
    ((name, at),) = table.axes.items()
    values = table[column]
    axes.plot(at, values, label=column)
    if f"{column}_error" in table:
        error = table[f"{column}_error"]
        axes.fill_between(at, values - error, values + error, alpha=0.3)
    axes.set(xlabel=f"{name} ({table.units[name]})", ylabel=f"{column} ({table.units[column]})")
    return axes


def rotation(
    runs: Any,
    *,
    against: str = "discs",
    by: Optional[str] = None,
    ax: Optional[Axes] = None,
    label: Optional[str] = None,
) -> Axes:
    """The rotation rate ϖ/Ω, averaged by time, against a parameter.

    runs: the table of swirl.sweep(), with a line for each value of the column `by`; or results,
    such as those of swirl.map()."""
    axes = _axes(ax)
    if hasattr(runs, "groupby"):
        groups = [(None, runs)] if by is None else list(runs.groupby(by))
        for value, rows in groups:
            rows = rows.sort_values(against)
            axes.errorbar(
                rows[against],
                rows["mean_by_time"],
                rows["mean_by_time_error"],
                marker="o",
                ms=3,
                lw=1,
                capsize=2,
                label=label if value is None else f"{by} = {value}",
            )
    else:
        points = sorted((_parameter(r, against), r.rotation.mean_by_time) for r in _results(runs))
        at = [point[0] for point in points]
        found: list[Estimate] = [point[1] for point in points]
        axes.errorbar(
            at,
            [e.mean for e in found],
            [e.error for e in found],
            marker="o",
            ms=3,
            lw=1,
            capsize=2,
            label=label,
        )
    axes.axhline(0, color="0.6", lw=0.8)
    axes.set(xlabel=against, ylabel="ϖ / Ω")
    if axes.get_legend_handles_labels()[0]:
        axes.legend()
    return axes


def table(found: Table, column: Optional[str] = None, *, ax: Optional[Axes] = None) -> Axes:
    """A column of a table: a map in colours, or a line with its error as a band. The default is the
    first column with an error."""
    _require(found, (Table,), 'a swirl.Table, such as result.measured["wall"].table')
    values = [name for name in found.columns if name not in found.axes]
    if column is None:
        column = next((name for name in values if f"{name}_error" in found), values[0])
    if len(found.axes) == 1:
        return profile(found, column, ax=ax)
    axes = _axes(ax)
    x, y = found.axes["x"], found.axes["y"]
    drawn = axes.pcolormesh(x, y, found[column], cmap="viridis", shading="nearest")
    axes.figure.colorbar(drawn, ax=axes, label=f"{column} ({found.units[column]})")
    axes.set(aspect="equal", xlabel=f"x ({found.units['x']})", ylabel=f"y ({found.units['y']})")
    return axes


def measured(found: Measured, column: Optional[str] = None, *, ax: Optional[Axes] = None) -> Axes:
    """The first table of a measurement: density and flow as these functions draw them, others as
    table() does."""
    _require(found, (Measured,), 'a measurement, such as result.measured["density"]')
    if not found.tables:
        raise ValueError(
            f"'{found.name}' has no table to plot, only numbers.\nhint: use to_pandas()."
        )
    if column is None and found.name == "density":
        return density(found, ax=ax)
    if column is None and found.name == "flow":
        return flow(found, ax=ax)
    return table(next(iter(found.tables.values())), column, ax=ax)


def series(found: Any, column: str = "mean_by_time", *, ax: Optional[Axes] = None) -> Axes:
    """A column of a series against the period, with the warm-up in grey. `found` is a series or a
    result that has one."""
    _require(found, (Series, Result), "a swirl.Series or a result")
    of_periods = found if isinstance(found, Series) else found.series
    if of_periods is None:
        raise ValueError("the result has no series.\nhint: use swirl.run(series=True).")
    axes = _axes(ax)
    period, values, is_counted = (
        of_periods["period"],
        of_periods[column],
        of_periods["counted"] == 1,
    )
    axes.plot(period, values, color="0.7", lw=0.8)
    axes.plot(period[is_counted], values[is_counted], lw=1)
    axes.axhline(0, color="0.6", lw=0.8)
    axes.set(xlabel="period", ylabel=f"{column} ({of_periods.units[column]})")
    return axes


def crossing(found: Any, *, ax: Optional[Axes] = None) -> Axes:
    """The points of a swirl.Crossing with their errors, and N_c with its error as a band."""
    _require(found, (Crossing,), "a swirl.Crossing")
    axes = _axes(ax)
    discs, rates, errors = (
        [point[name] for point in found.points]
        for name in ("discs", found.rate, f"{found.rate}_error")
    )
    axes.errorbar(discs, rates, errors, marker="o", ms=3, lw=1, capsize=2)
    axes.axhline(0, color="0.6", lw=0.8)
    if math.isfinite(found.discs):
        axes.axvspan(found.discs - found.error, found.discs + found.error, alpha=0.3)
        axes.axvline(found.discs, lw=1, label=f"N_c = {with_error(found.discs, found.error)}")
        axes.legend()
    axes.set(xlabel="discs", ylabel="ϖ / Ω")
    return axes


def result(found: Any, what: Optional[str] = None, *, ax: Optional[Axes] = None) -> Axes:
    """A result of a run or of a recording: "series", a measurement such as "density", or a table
    such as "wall.profile". The default is the first of these that the result has, and otherwise the
    rotation against the number of discs."""
    _require(found, (Result, Analysis), "a result of swirl.run() or swirl.analyse()")
    tables = {each.name: each for of in found.measured.values() for each in of.tables.values()}
    drawable = [name for name, of in found.measured.items() if of.tables]
    if getattr(found, "series", None) is not None:
        drawable.insert(0, "series")
    if what is None and not drawable and isinstance(found, Result):
        return rotation([found], ax=ax)
    names = list(dict.fromkeys([*drawable, *tables]))
    if not names:
        raise ValueError('there is no table to plot.\nhint: use measure=["density"].')
    name = names[0] if what is None else what
    if name not in names:
        raise ValueError(
            f"the result has no '{_engine.shortened(str(name))}' to plot; it has "
            f"{', '.join(names)}."
        )
    if name == "series":
        return series(found, ax=ax)
    return (
        measured(found.measured[name], ax=ax)
        if name in found.measured
        else table(tables[name], ax=ax)
    )


def _results(runs: Any) -> list[Result]:
    results = list(runs) if isinstance(runs, Iterable) else [runs]
    if not all(isinstance(r, Result) for r in results):
        raise TypeError("runs must be the table of swirl.sweep() or results of runs.")
    return results


def _parameter(result: Result, name: str) -> float:
    if name not in result.config:
        raise ValueError(f"the results have no parameter '{name}'.")
    return float(result.config[name])
