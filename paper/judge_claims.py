"""Judges the paper's claims (claims/__init__.py says how) by the tables of `swirl paper`, and writes
verdicts.json: every verdict, and the points that need more seeds.

    /usr/bin/python3 paper/judge_claims.py out
"""

import json
import os
import sys

import atomic_file
import claims


def write_verdicts(folder):
    """Writes and returns claims.all_verdicts()."""
    verdicts = claims.all_verdicts(folder)
    atomic_file.write(os.path.join(folder, "verdicts.json"), json.dumps(verdicts, indent=1, ensure_ascii=False) + "\n")
    return verdicts


def main():
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print(f"usage: /usr/bin/python3 {sys.argv[0]} FOLDER\n"
              "Judges the tables that `swirl paper --out FOLDER` wrote, and writes verdicts.json", file=sys.stderr)
        sys.exit(0 if sys.argv[1:] in (["-h"], ["--help"]) else 2)
    try:
        write_verdicts(sys.argv[1])
    except OSError as error:
        sys.exit(f"error: '{os.path.join(sys.argv[1], 'verdicts.json')}' cannot be written: {error.strerror}.")


if __name__ == "__main__":
    main()
