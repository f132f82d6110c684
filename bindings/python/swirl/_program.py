"""The program `swirl` of the Python package."""

from __future__ import annotations

import os
import shutil
import sys
from typing import Optional

from ._files import exists


def program() -> Optional[str]:
    """The program in this package, or the first on the PATH that is not this command."""
    import swirl

    for folder in swirl.__path__:
        bundled = os.path.join(folder, "_program", "bin", "swirl")
        if exists(bundled):
            return bundled
    found = shutil.which("swirl")
    is_this_command = found is not None and os.path.realpath(found) == os.path.realpath(sys.argv[0])
    return None if is_this_command else found
