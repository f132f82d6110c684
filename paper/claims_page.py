"""Writes the tables of claims in docs/results/paper.md, and docs/data/claims.csv with every number that was found,
from the tables of a full study.

    /usr/bin/python3 paper/claims_page.py out docs/results/paper.md
"""

import csv
import io
import os
import re
import sys

import atomic_file
from claims.settings import ALSO
from html_page import cell
from report import ORDER, judge
from verdicts import FAILS, HOLDS


def figure_of(j):
    return f"`{j.claim.figure}`" if j.claim.figure else "–"


def verdict_of(j):
    return (j.verdict if j.verdict == HOLDS else f"**{j.verdict}**") + (" (size)" if j.depends_on_size else "")


def list_of(judged, *verdicts):
    """A row for each claim with one of these verdicts."""
    return ["| claim | found | figure |", "|---|---|---|",
            *(f"| {k}: {cell(j.claim.statement)} | {cell(j.found.split(ALSO)[0])} | {figure_of(j)} |"
              for k, j in judged if j.verdict in verdicts)]


def tables_of(judged):
    """{heading of the page: lines of the table below it}; `judged` are (number, Judged)."""
    found = [j.verdict for _, j in judged]
    return {
        "# Comparison with the paper": ["| verdict | claims |", "|---|---|", *(
            f"| {verdict} | {found.count(verdict)} |" for verdict in ORDER if verdict in found)],
        "## The claims": [
            "| no. | claim | judged on | figure | verdict |", "|---|---|---|---|---|",
            *(f"| {k} | {cell(j.claim.statement)} | {j.claim.on} | {figure_of(j)} | {verdict_of(j)} |"
              for k, j in judged)],
        "### Claims that do not hold": list_of(judged, FAILS)}


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
    """The page with new tables."""
    for heading, lines in tables_of(list(enumerate(judged, 1))).items():
        start, rest = page.split(f"{heading}\n", 1)
        rest = re.sub(r"^(?:\|.*\n)+", lambda _: "\n".join(lines) + "\n", rest, count=1, flags=re.M)
        page = f"{start}{heading}\n{rest}"
    return page


def main():
    if len(sys.argv) != 3:
        print(f"usage: /usr/bin/python3 {sys.argv[0]} FOLDER PAGE\n"
              "Writes the tables of claims in PAGE, and ../data/claims.csv next to it, from the tables in FOLDER",
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
