"""The command `swirl` of the Python package: runs the program that the package contains."""

from __future__ import annotations

import os
import sys

from swirl._program import program


def main() -> None:
    path = program()
    if path is None:
        sys.exit(
            "error: this installation of the Python package has no program.\n"
            "hint: install the program, or reinstall the package with pip."
        )
    os.environ.setdefault("SWIRL_PYTHON", sys.executable)  # draws the figures
    os.execv(path, ["swirl", *sys.argv[1:]])


if __name__ == "__main__":
    main()
