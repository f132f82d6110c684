"""Files that may be absent."""

from __future__ import annotations

import os
from typing import Union


def exists(path: Union[str, "os.PathLike[str]"]) -> bool:
    """True if a file has this name. Raises OSError if the system cannot tell: os.path.exists()
    takes a disk that does not answer for absence."""
    try:
        os.stat(path)
    except (FileNotFoundError, NotADirectoryError):
        return False
    return True
