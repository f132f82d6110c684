"""Judges the paper's claims (claims/__init__.py says how) by the tables of `swirl paper`, and writes
verdicts.json: every verdict, and the points that need more seeds.

    /usr/bin/python3 paper/judge_claims.py out
"""

import json
import os
import sys

import atomic_file
import claims


def main():
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print(f"usage: /usr/bin/python3 {sys.argv[0]} FOLDER\n"
              "Judges the tables that `swirl paper --out FOLDER` wrote, and writes verdicts.json", file=sys.stderr)
        sys.exit(0 if sys.argv[1:] in (["-h"], ["--help"]) else 2)
    file = os.path.join(sys.argv[1], "verdicts.json")
    atomic_file.write_or_exit(
        file, json.dumps(claims.all_verdicts(sys.argv[1]), indent=1, ensure_ascii=False) + "\n")


if __name__ == "__main__":
    main()
