"""Results of another version are not mixed with those of this one. They may have taken days, so
they are kept."""

import os
import re
import sys

from paper import optional_file


def keep(file, version):
    """Moves a result to a folder next to its own, such as results_of_0.1.0. Says so once for each
    folder."""
    folder = f"{os.path.dirname(file)}_of_{re.sub(r'[^A-Za-z0-9.+-]+', '_', version).strip('_')}"
    if not optional_file.exists(folder):
        print(
            f"note: the results of swirl {version} are moved to '{folder}', and this version makes "
            "them again.\n"
            "hint: to continue with the results of that version, use it and another folder.",
            file=sys.stderr,
        )
        os.makedirs(folder, exist_ok=True)
    try:
        os.replace(file, os.path.join(folder, os.path.basename(file)))
    except FileNotFoundError:  # another part of this call has moved it
        pass
