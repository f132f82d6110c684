"""Runs notebooks from the top, in a fresh kernel each, and writes them with what they print.

    notebooks.py FOLDER FILE…

A name by which a folder cannot be written, or a cell that raises, ends it with that.
"""

import os
import sys
import tempfile

import nbformat
from nbclient import NotebookClient


def run(file, folder):
    book = nbformat.read(file, as_version=4)
    with tempfile.TemporaryDirectory() as place:  # where what it writes is left
        NotebookClient(book, timeout=600, kernel_name="python3",
                       resources={"metadata": {"path": place}}).execute()
    nbformat.write(book, os.path.join(folder, os.path.basename(file)))


if __name__ == "__main__":
    for name in sys.argv[2:]:
        run(name, sys.argv[1])
