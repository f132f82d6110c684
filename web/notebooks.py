"""Runs each notebook in a fresh kernel and writes it with its output.

    notebooks.py FOLDER FILE…

Exits with an error if a cell raises an exception or a file cannot be written.
"""

import os
import sys
import tempfile

import nbformat
from nbclient import NotebookClient

HANG = 3000  # seconds that no cell takes, on a busy machine either


def run(file, folder):
    book = nbformat.read(file, as_version=4)
    with tempfile.TemporaryDirectory() as work:  # for the files that it writes
        NotebookClient(
            book,
            kernel_name="python3",
            timeout=HANG,
            startup_timeout=HANG,
            resources={"metadata": {"path": work}},
        ).execute()
    nbformat.write(book, os.path.join(folder, os.path.basename(file)))


if __name__ == "__main__":
    for name in sys.argv[2:]:
        run(name, sys.argv[1])
