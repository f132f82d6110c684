"""Files that are there whole or not at all, as the program writes its own (src/swirl/io/atomic_file.hpp):
beside the target under a name that nobody else has, locked, onto the disk, then renamed. What a kill
leaves has no lock, and the next `swirl paper` or `experiment` on that folder removes it."""

import fcntl
import os
import secrets


def write(path, content):
    """Text or bytes; raises OSError, leaving what was there."""
    if isinstance(content, str):
        content = content.encode("utf-8")
    aside = f"{path}.{secrets.token_hex(8)}.partial"
    with open(aside, "xb") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
            os.replace(aside, path)
        except BaseException:
            os.remove(aside)
            raise
