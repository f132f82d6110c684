"""Writes the table of verdicts in docs/results/paper.md, and docs/data/claims.csv with every number that was found,
from the tables of a full study.

    /usr/bin/python3 paper/claims_page.py out docs/results/paper.md
"""

import csv
import io
import os
import re
import sys

import atomic_file
from report import ORDER, judge


def table_of(judged):
    """How many claims have each verdict, and which; the numbers are those of claims.csv."""
    numbers = {verdict: [str(k) for k, j in enumerate(judged, 1) if j.verdict == verdict] for verdict in ORDER}
    return ["| verdict | claims | their numbers |", "|---|---|---|",
            *(f"| {verdict} | {len(found)} | {', '.join(found)} |" for verdict, found in numbers.items() if found)]


def csv_of(judged):
    """Every claim with its verdicts and what was found, also for comparison."""
    made = io.StringIO()
    rows = csv.writer(made, lineterminator="\n")
    rows.writerow(["claim", "statement", "judged_on", "figure", "verdict", "at_half_the_sizes", "at_twice_the_sizes",
                   "result"])
    for k, j in enumerate(judged, 1):
        rows.writerow([k, j.claim.statement, j.claim.on, j.claim.figure or "", j.verdict,
                       *(j.scaled.get(factor, j.verdict) for factor in (0.5, 2)), j.found])
    return made.getvalue()


def written(page, judged):
    """The page with a new table."""
    return re.sub(r"^\| verdict \| claims .*\n(?:\|.*\n)+", lambda _: "\n".join(table_of(judged)) + "\n", page,
                  count=1, flags=re.M)


def main():
    if len(sys.argv) != 3:
        print(f"usage: /usr/bin/python3 {sys.argv[0]} FOLDER PAGE\n"
              "Writes the table of verdicts in PAGE, and ../data/claims.csv next to it, from the tables in FOLDER",
              file=sys.stderr)
        sys.exit(0 if sys.argv[1:] in (["-h"], ["--help"]) else 2)
    folder, page = sys.argv[1:]
    with open(page, encoding="utf-8") as file:
        text = file.read()
    judged = judge(folder)
    atomic_file.write_or_exit(page, written(text, judged))
    atomic_file.write_or_exit(os.path.join(os.path.dirname(page), "..", "data", "claims.csv"), csv_of(judged))


if __name__ == "__main__":
    main()
