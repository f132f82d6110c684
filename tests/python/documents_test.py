"""The Python code of the documentation runs, and its `>>>` examples print what is shown."""

import doctest
import os
import re
import subprocess
import sys

import pytest

import swirl

from scenes import SOURCE

# Shorter calls, as in tests/cli/pages_test.py.
SHORTENED = (
    ("replicates=3, periods=150", "replicates=3, periods=5"),
    ("crossing(mu=1)", "crossing(mu=1, min_discs=34, max_discs=42, tolerance=5)"),
)
PAGES = ("docs/tutorials/python.md", "docs/how-to/own_measurement.md")


def text_of(page):
    with open(os.path.join(SOURCE, page), encoding="utf-8") as file:
        return file.read()


@pytest.mark.parametrize("page", PAGES)
def test_code_runs(page, tmp_path):
    code = "\n".join(re.findall(r"^```python\n(.*?)^```$", text_of(page), re.M | re.S))
    for shown, shorter in SHORTENED:
        code = code.replace(shown, shorter)
    assert code.count("swirl.") > 0
    done = subprocess.run(
        [sys.executable, "-B", "-c", code],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env={**os.environ, "MPLBACKEND": "Agg"},
    )
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("page", ["docs/how-to/paths.md", "docs/how-to/series_and_ramps.md"])
def test_complete_examples_run(page, tmp_path):
    """Blocks that import what they use; the others continue a call of the reader."""
    blocks = [
        block
        for block in re.findall(r"^```python\n(.*?)^```$", text_of(page), re.M | re.S)
        if "import swirl" in block
    ]
    assert len(blocks) == 1 and "assert" in blocks[0]
    done = subprocess.run(
        [sys.executable, "-B", "-c", blocks[0]], capture_output=True, text=True, cwd=tmp_path
    )
    assert done.returncode == 0, done.stderr


def test_recordings_are_read_as_shown(tmp_path):
    (shown,) = re.findall(
        r"^```python\n(.*?)^```$", text_of("docs/reference/files.md"), re.M | re.S
    )
    for module in ("h5py", "MDAnalysis", "xarray"):
        pytest.importorskip(module)
    swirl.run(discs=48, periods=2, trajectory=str(tmp_path / "frames.h5"))
    done = subprocess.run(
        [sys.executable, "-B", "-W", "ignore", "-c", shown],
        capture_output=True,
        text=True,
        cwd=tmp_path,
    )
    assert done.returncode == 0, done.stderr


def test_shown_session_is_printed():
    (session,) = re.findall(r"^\$ \./swirl python\n(.*?)^```$", text_of(PAGES[0]), re.M | re.S)
    examples = doctest.DocTestParser().get_doctest(session, {}, "session", None, None)
    assert len(examples.examples) == 4
    runner = doctest.DocTestRunner(verbose=False)
    assert runner.run(examples).failed == 0
