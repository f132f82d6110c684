"""The notebooks of examples/ run from the start in a new kernel, and their assertions hold."""

import glob
import os

import nbformat
import pytest
from nbclient import NotebookClient

from scenes import SOURCE

NOTEBOOKS = sorted(glob.glob(os.path.join(SOURCE, "examples", "*.ipynb")))


@pytest.mark.parametrize("file", NOTEBOOKS, ids=os.path.basename)
def test_notebook_runs(file, tmp_path, monkeypatch):
    # Without it Matplotlib warns where the home folder cannot be written.
    monkeypatch.setenv("MPLCONFIGDIR", str(tmp_path / "matplotlib"))
    book = nbformat.read(file, as_version=4)
    nbformat.validate(book)
    NotebookClient(
        book, kernel_name="python3", resources={"metadata": {"path": str(tmp_path)}}
    ).execute()
    for cell in book.cells:
        for output in cell.get("outputs", []):
            assert output.get("name") != "stderr", output.get("text")


@pytest.mark.parametrize("file", NOTEBOOKS, ids=os.path.basename)
def test_notebook_is_stored_without_output(file):
    for cell in nbformat.read(file, as_version=4).cells:
        assert cell.cell_type != "code" or (cell.outputs == [] and cell.execution_count is None)


def test_number_of_notebooks():
    assert len(NOTEBOOKS) == 4
