"""Atomic writes, as those of the program (src/swirl/io/atomic_file.hpp). Content goes to a locked temporary
file next to the target, is synchronised to the disk, and is then renamed. A killed process leaves a temporary
file without a lock; the next `swirl paper` or `swirl experiment` on that folder removes it."""

import fcntl
import hashlib
import json
import os
import secrets
import sys


def write(path, content):
    """Writes text or bytes. Raises OSError; the target then keeps its old content."""
    if isinstance(content, str):
        content = content.encode("utf-8")
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
    """What an earlier call has stored; None if there is nothing, or if it was changed."""
    try:
        with open(path, encoding="utf-8") as file:
            found = json.load(file)
        return found["content"] if found["checksum"] == checksum_of(found["content"]) else None
    except (OSError, ValueError, KeyError, TypeError):
        return None


def checksum_of(content):
    return hashlib.sha256(json.dumps(content).encode()).hexdigest()


def remove_if_unlocked(temporary):
    """Removes the temporary file of a process that was killed."""
    try:
        with open(temporary, "rb") as file:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            os.remove(temporary)
    except OSError:  # another process writes it, or has removed it
        pass


def write_or_exit(path, content):
    """Ends the script with a message if the file cannot be written."""
    try:
        write(path, content)
    except OSError as error:
        sys.exit(f"error: '{path}' cannot be written: {error.strerror}.")
