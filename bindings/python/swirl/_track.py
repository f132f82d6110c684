"""Tracking of discs in a video, by the program `swirl track`."""

from __future__ import annotations

import json
import os
import pathlib
import subprocess
import tempfile
from typing import Any, Optional

from . import _engine
from ._arguments import file_name
from ._optional import optional
from ._program import program
from ._recordings import Tracks, _ReadTracks, _camera
from ._runs import PathName

_UNITS = {
    "frame": "1",
    "particle": "1",
    "x": "pixels",
    "y": "pixels",
    "x_seen": "pixels",
    "y_seen": "pixels",
    "radius": "pixels",
    "error": "pixels",
    "seen": "1",
    "texture_match": "1",
}
_NO_CAMERA = (
    "the program of this installation cannot read videos: it was built without OpenCV.\n"
    "hint: install OpenCV, and the package with pip install . -C "
    "cmake.define.SWIRL_CAMERA=ON (docs/tutorials/python.md)."
)


class VideoTracks(Tracks):
    """The discs of a video: a recording, which swirl.analyse() takes, and its tables.

    `table` is a pandas DataFrame with a row for each disc of each frame, and `units` has the unit
    of each column. `quality` is the calibration with its errors, as in NAME.camera.json; `warnings`
    lists what looks wrong."""

    __slots__ = ("table", "quality", "units", "warnings")

    def __init__(self, file: pathlib.Path, warnings: list[str]) -> None:
        pandas = optional("pandas", "swirl.track()")
        camera = file.with_suffix(".camera.json")
        self.table = pandas.read_csv(file)
        self.quality: dict[str, Any] = json.loads(camera.read_text(encoding="utf-8"))
        time, rate = ("s", "rad/s") if self.quality["fps"] else ("frame", "rad/frame")
        self.units = {
            name: _UNITS.get(name, time if name == "time" else rate) for name in self.table.columns
        }
        self.table.attrs["units"] = self.units
        self.warnings = warnings
        super().__init__(
            _ReadTracks(_engine.Recording.read_tracks(os.fspath(file))), **_camera(camera)
        )

    def __repr__(self) -> str:
        return f"<swirl.VideoTracks: {self.quality['discs']} discs, {len(self)} frames>"


def track(
    video: PathName,
    *,
    discs: Optional[int] = None,
    fps: Optional[float] = None,
    spin: bool = False,
    max_frames: Optional[int] = None,
) -> VideoTracks:
    """Tracks the discs in a video of a swirled container, like `swirl track`.

        tracks = swirl.track("video.mp4")
        tracks.table                          # a DataFrame; tracks.units has the units
        swirl.analyse(tracks).rotation.mean_by_time

    discs: their number, if it is known. fps: frames per second, if the file is wrong. spin: also
    measures the spins of discs with a texture. max_frames: only so many frames.

    Needs ffmpeg, pandas, and a program that was built with OpenCV; wheels have none. Raises
    ValueError for a wrong argument, and swirl.Failure with the likely cause if the discs cannot be
    tracked.
    """
    optional("pandas", "swirl.track()")
    path = program()
    if path is None:
        raise _engine.Failure(
            "this installation of the Python package has no program.\n"
            "hint: install the program, or reinstall the package with pip."
        )
    with tempfile.TemporaryDirectory(prefix="swirl-track-") as folder:
        out = pathlib.Path(folder) / "tracks.csv"
        call = [path, "track", file_name("video", video), "--out", str(out), "--quiet"]
        for name, value in (("--discs", discs), ("--fps", fps), ("--max-frames", max_frames)):
            if value is not None:
                call += [name, str(value)]
        done = subprocess.run(
            call + (["--spin"] if spin else []), capture_output=True, encoding="utf-8"
        )
        if done.returncode == 0:
            return VideoTracks(
                out, [line.removeprefix("warning: ") for line in done.stderr.splitlines()]
            )
    message = done.stderr.partition("error: ")[2].strip() or done.stderr.strip()
    if "no camera support" in message:
        message = _NO_CAMERA
    raise ValueError(message) if done.returncode == 2 else _engine.Failure(message)
