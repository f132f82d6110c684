"""Runs each notebook in a fresh kernel and writes it with its output.

    notebooks.py FOLDER FILE…

Exits with an error if a cell raises an exception or a file cannot be written.
"""

import os
import sys
import tempfile

import nbformat
from nbclient import NotebookClient


def run(file, folder):
    book = nbformat.read(file, as_version=4)
    with tempfile.TemporaryDirectory() as work:  # for the files that it writes
        NotebookClient(book, timeout=600, kernel_name="python3",
                       resources={"metadata": {"path": work}}).execute()
    nbformat.write(book, os.path.join(folder, os.path.basename(file)))


if __name__ == "__main__":
    for name in sys.argv[2:]:
        run(name, sys.argv[1])
