"""String and SVG representations of snapshots, frames and events, and their pickling."""

from __future__ import annotations

import html
import math
from typing import Any

from . import _engine
from ._tables import frames_to_pandas, frames_to_xarray, snapshot_to_pandas, snapshot_to_xarray


def snapshot_svg(snapshot: _engine.Snapshot, width: int = 320) -> str:
    """The container in the frame of the snapshot, y upwards. A line in each disc shows its
    angle."""
    R = snapshot.container_radius
    cx, cy = snapshot.container_centre
    reach = 1.03 * R
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{width}" '
        f'viewBox="{cx - reach:.6g} {-cy - reach:.6g} {2 * reach:.6g} {2 * reach:.6g}">',
        f'<circle cx="{cx:.6g}" cy="{-cy:.6g}" r="{R:.6g}" fill="#f7f7f5" stroke="#333" '
        f'stroke-width="{0.01 * R:.4g}"/>',
    ]
    for x, y, r, angle in zip(*snapshot.position.T, snapshot.radius, snapshot.angle):
        parts.append(
            f'<circle cx="{x:.6g}" cy="{-y:.6g}" r="{r:.6g}" fill="#9db9d4" '
            f'stroke="#2c4a66" stroke-width="{0.006 * R:.4g}"/>'
        )
        if math.isfinite(angle):
            parts.append(
                f'<line x1="{x:.6g}" y1="{-y:.6g}" x2="{x + r * math.cos(angle):.6g}" '
                f'y2="{-y - r * math.sin(angle):.6g}" stroke="#2c4a66" '
                f'stroke-width="{0.006 * R:.4g}"/>'
            )
    return "".join(parts) + "</svg>"


def _snapshot_repr(self: _engine.Snapshot) -> str:
    return f"<swirl.Snapshot of {len(self)} discs at time {self.time:.6g}>"


def _frames_repr(self: _engine.Frames) -> str:
    return f"<swirl.Frames: {len(self)} of {self.discs} discs>"


def _event_repr(self: _engine.Event) -> str:
    what = (
        f"discs {self.i} and {self.j} collide",
        f"disc {self.i} hits the wall",
        "the container passes a vertex",
        f"sphere {self.i} begins to roll",
    )[self.kind]
    return f"<swirl.Event: {what} at {self.whole_periods} periods and {self.clock:.6g}>"


# Pickle needs functions of an importable module.
def _snapshot_of(data: bytes) -> _engine.Snapshot:
    return _engine.snapshot_from_bytes(data)


def _frames_of(data: bytes) -> _engine.Frames:
    return _engine.frames_from_bytes(data)


def _snapshot_reduced(self: _engine.Snapshot) -> Any:
    return _snapshot_of, (self.to_bytes(),)


def _frames_reduced(self: _engine.Frames) -> Any:
    return _frames_of, (self.to_bytes(),)


def _snapshot_plot(self: _engine.Snapshot, *, ax: Any = None, **style: Any) -> Any:
    """Draws the discs; returns the axes. `style` is that of swirl.plot.snapshot()."""
    from . import plot

    return plot.snapshot(self, ax=ax, **style)


def _text_as_html(self: object) -> str:
    return f"<p>{html.escape(str(self)).replace(chr(10), '<br>')}</p>"


def shown_in_notebooks(kind: type) -> None:
    """Notebooks show the text of an object instead of its repr, unless its class has HTML or a
    picture."""
    if not hasattr(kind, "_repr_html_") and not hasattr(kind, "_repr_svg_"):
        setattr(kind, "_repr_html_", _text_as_html)


for kind, to_pandas, to_xarray in (
    (_engine.Snapshot, snapshot_to_pandas, snapshot_to_xarray),
    (_engine.Frames, frames_to_pandas, frames_to_xarray),
):
    setattr(kind, "to_pandas", to_pandas)
    setattr(kind, "to_xarray", to_xarray)
setattr(_engine.Snapshot, "plot", _snapshot_plot)
setattr(_engine.Snapshot, "_repr_svg_", snapshot_svg)
setattr(_engine.Snapshot, "__repr__", _snapshot_repr)
setattr(_engine.Frames, "__repr__", _frames_repr)
setattr(_engine.Event, "__repr__", _event_repr)
setattr(_engine.Snapshot, "__reduce__", _snapshot_reduced)
setattr(_engine.Frames, "__reduce__", _frames_reduced)
