"""Atomic writes, as those of the program (src/swirl/io/atomic_file.hpp). Content goes to a locked
temporary file next to the target, is synchronised to the disk, and is then renamed. A killed
process leaves a temporary file without a lock; the next process that writes the target removes
it."""

import fcntl
import hashlib
import json
import os
import re
import secrets
import sys

from paper import optional_file

_left = (
    {}
)  # by folder: the temporary files that were there when this process first wrote a file into it


def write(path, content):
    """Writes text or bytes. Raises OSError; the target then keeps its old content."""
    if isinstance(content, str):
        content = content.encode("utf-8")
    remove_leftovers_of(path)
    temporary = f"{path}.{secrets.token_hex(8)}.partial"
    with open(temporary, "xb") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
            os.replace(temporary, path)
        except BaseException:
            os.remove(temporary)
            raise


def store(path, content):
    """Stores what a later call reuses, as JSON."""
    write(path, json.dumps({"checksum": checksum_of(content), "content": content}) + "\n")


def stored(path):
    """What an earlier call has stored; None if there is nothing, or if it was changed. Raises
    OSError."""
    try:
        found = json.loads(optional_file.read(path) or "")
        return found["content"] if found["checksum"] == checksum_of(found["content"]) else None
    except (ValueError, KeyError, TypeError):
        return None


def checksum_of(content):
    return hashlib.sha256(json.dumps(content).encode()).hexdigest()


def remove_leftovers_of(path):
    """Removes the temporary files of this target that killed processes left. Lists each folder
    once."""
    folder, name = os.path.split(os.path.abspath(path))
    if folder not in _left:
        _left[folder] = [
            found
            for found in optional_file.names_in(folder)
            if re.search(r"\.[0-9a-f]{16}\.partial$", found)
        ]
    for found in [
        found for found in _left[folder] if found[: -len(".0123456789abcdef.partial")] == name
    ]:
        _left[folder].remove(found)
        try:
            with open(os.path.join(folder, found), "rb") as file:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                os.remove(file.name)
        except OSError:  # another process writes it, or has removed it
            pass


def write_or_exit(path, content):
    """Ends the script with a message if the file cannot be written."""
    try:
        write(path, content)
    except OSError as error:
        sys.exit(f"error: '{path}' cannot be written: {error.strerror}.")
