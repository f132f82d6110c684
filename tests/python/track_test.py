"""swirl.track(): a video's discs as a table and as a recording, by the program."""

import json
import os
import subprocess

import pytest

import swirl

SWIRL = os.environ.get("SWIRL", "build/tests/swirl")
VIDEO = [
    "--discs",
    "20",
    "--container-radius",
    "6.5",
    "--scale",
    "12",
    "--width",
    "240",
    "--height",
    "240",
    "--frames-per-period",
    "64",
    "--noise",
    "2",
    "--quality",
    "14",
    "--seed",
    "3",
    "--periods",
    "1.1",
]


def on_path(folder, monkeypatch):
    monkeypatch.setenv("PATH", str(folder) + os.pathsep + os.environ["PATH"])


def test_a_video_becomes_a_table_and_a_recording(tmp_path, monkeypatch):
    pytest.importorskip("pandas")
    video, csv = tmp_path / "video.mp4", tmp_path / "tracks.csv"
    subprocess.run([SWIRL, "synthetic-video", *VIDEO, "--out", video, "--quiet"], check=True)
    done = subprocess.run(
        [SWIRL, "track", video, "--out", csv, "--quiet"], capture_output=True, text=True
    )
    if "no camera support" in done.stderr:
        pytest.skip("this build has no camera support")
    on_path(os.path.dirname(os.path.abspath(SWIRL)), monkeypatch)
    tracks = swirl.track(video)
    assert tracks.quality["discs"] == 20
    assert tracks.table["particle"].nunique() == 20
    assert tracks.units["x"] == tracks.table.attrs["units"]["x"] == "pixels"
    assert set(tracks.units) == set(tracks.table.columns)
    assert len(tracks) == tracks.table["frame"].nunique()
    # The measurement is that of the command line on the same tracks.
    measured = subprocess.run(
        [SWIRL, "measure", csv, "--json", "-"], capture_output=True, check=True, text=True
    )
    by_time = json.loads(measured.stdout)["rotation"]["mean_by_time"]["mean"]
    assert swirl.analyse(tracks).rotation.mean_by_time.mean == by_time


def test_errors_name_the_cause(tmp_path, monkeypatch):
    pytest.importorskip("pandas")
    program = tmp_path / "swirl"
    on_path(tmp_path, monkeypatch)
    for text, code, kind, words in (
        (
            "this build has no camera support (OpenCV was not found).",
            1,
            swirl.Failure,
            "SWIRL_CAMERA=ON",
        ),
        ("there is no video 'none.mp4'.", 1, swirl.Failure, "none.mp4"),
        ("--discs is 0, but it must be at least 1.", 2, ValueError, "--discs is 0"),
    ):
        program.write_text(f'#!/bin/sh\necho "error: {text}" >&2\nexit {code}\n')
        program.chmod(0o755)
        with pytest.raises(kind, match=words):
            swirl.track("none.mp4", discs=0)
