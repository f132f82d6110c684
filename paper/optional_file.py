"""Files that may be absent, as in the program (src/swirl/io/optional_file.hpp): any error other
than absence raises OSError. os.path.exists() and glob.glob() take a disk that does not answer for
absence."""

import os


def exists(path):
    try:
        os.stat(path)
    except (FileNotFoundError, NotADirectoryError):
        return False
    return True


def read(path):
    """The text of a file; None if there is none."""
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            return file.read()
    except (FileNotFoundError, NotADirectoryError):
        return None


def names_in(folder):
    """The sorted names in a folder; none if there is no such folder."""
    return sorted(os.listdir(folder)) if exists(folder) else []
