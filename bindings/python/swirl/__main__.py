"""The command `swirl` of the Python package: runs the program that the package contains."""

from __future__ import annotations

import os
import shutil
import sys
from typing import Optional

import swirl


def program() -> Optional[str]:
    """The program in this package, or the first on the PATH that is not this command."""
    for folder in swirl.__path__:
        bundled = os.path.join(folder, "_program", "bin", "swirl")
        if os.path.exists(bundled):
            return bundled
    found = shutil.which("swirl")
    is_this_command = found is not None and os.path.realpath(found) == os.path.realpath(sys.argv[0])
    return None if is_this_command else found


def main() -> None:
    path = program()
    if path is None:
        sys.exit("error: this installation of the Python package has no program.\n"
                 "hint: install the program, or reinstall the package with pip.")
    os.environ.setdefault("SWIRL_PYTHON", sys.executable)  # draws the figures
    os.execv(path, ["swirl", *sys.argv[1:]])


if __name__ == "__main__":
    main()
