"""Writes the claims from the tables of a full study: the counts of verdicts in
docs/results/paper.md, the page docs/results/claims.md, and docs/data/claims.csv with every number
that was found.

    /usr/bin/python3 paper claims_page out docs/results/paper.md
    /usr/bin/python3 paper claims_page out docs/results/paper.md 13 16
    /usr/bin/python3 paper claims_page - docs/results/paper.md

The second call writes these claims only, if out has no other tables. The third one writes both
pages again, from claims.csv alone.
"""

import csv
import io
import os
import re
import sys

from paper import atomic_file
from paper.claims import CLAIMS, QUOTES
from paper.claims.wording import headline
from paper.report import ORDER, judge

COLUMNS = (
    "claim",
    "statement",
    "judged_on",
    "figure",
    "verdict",
    "at_half_the_sizes",
    "at_twice_the_sizes",
    "result",
)
PAGE = """# The paper's claims

For physicists who know the paper: its 60 statements with our verdict, the number behind it, and the figure whose runs decide.
[How a verdict is made](paper.md#how-a-verdict-is-made). `swirl paper --figure NAME` makes a figure. [claims.csv](../data/claims.csv) has
all numbers, and the verdicts for half and twice the required sizes.

![Rotation and slip of spheres against their number; stars are the numbers that the paper states](../images/figure_1b.png)

*Stars are numbers that the paper states, curves are runs. Claims on the experiment are judged on rolling spheres, here blue and red.*
(`swirl paper --figure 1b`)

| | the paper's sentence, and the claim | verdict | number | figure |
|---|---|---|---|---|
"""


def row_of(number, judged):
    return dict(
        zip(
            COLUMNS,
            (
                str(number),
                judged.claim.statement,
                judged.claim.on,
                judged.claim.figure or "",
                judged.verdict,
                *(judged.scaled.get(factor, judged.verdict) for factor in (0.5, 2)),
                judged.found,
            ),
        )
    )


def table_of(rows):
    """How many claims have each verdict, and which; the numbers are those of claims.csv."""
    numbers = {
        verdict: [row["claim"] for row in rows if row["verdict"] == verdict] for verdict in ORDER
    }
    return [
        "| verdict | claims | their numbers |",
        "|---|---|---|",
        *(
            f"| {verdict} | {len(found)} | {', '.join(found)} |"
            for verdict, found in numbers.items()
            if found
        ),
    ]


def csv_of(rows):
    """Every claim with its verdicts and what was found, also for comparison."""
    made = io.StringIO()
    out = csv.DictWriter(made, COLUMNS, lineterminator="\n")
    out.writeheader()
    out.writerows(rows)
    return made.getvalue()


def page_of(rows):
    """docs/results/claims.md."""

    def cell(text):
        return text.replace("|", "\\|")

    lines = [
        f"| {row['claim']} | “{cell(quote)}”<br>{cell(row['statement'])} | {row['verdict']} | "
        f"{cell(headline(row['result']))} | " + (f"`{row['figure']}` |" if row["figure"] else "|")
        for row, quote in zip(rows, QUOTES)
    ]
    return PAGE + "\n".join(lines) + "\n"


def written(page, rows):
    """The page with a new table."""
    return re.sub(
        r"^\| verdict \| claims .*\n(?:\|.*\n)+",
        lambda _: "\n".join(table_of(rows)) + "\n",
        page,
        count=1,
        flags=re.M,
    )


def stored_rows(file):
    with open(file, encoding="utf-8", newline="") as opened:
        return {row["statement"]: row for row in csv.DictReader(opened)}


def rows_from(folder, file, numbers):
    """The rows of all claims: those with these numbers, or all, from the tables in the folder;
    others as they are stored."""
    if folder != "-" and not numbers:
        return [row_of(k, judged) for k, judged in enumerate(judge(folder), 1)]
    stored = stored_rows(file)
    judged = judge(folder) if numbers else [None] * len(CLAIMS)
    return [
        row_of(k, judged[k - 1])
        if k in numbers
        else {**stored[claim.statement], "figure": claim.figure}
        for k, claim in enumerate(CLAIMS, 1)
    ]


def main():
    if len(sys.argv) < 3:
        print(
            f"usage: /usr/bin/python3 {sys.argv[0]} FOLDER PAGE [CLAIM...]\n"
            "Writes the table of verdicts in PAGE, claims.md next to it and ../data/claims.csv, "
            "from the tables in FOLDER. With "
            "numbers of claims, only these are judged again. FOLDER - uses what claims.csv has",
            file=sys.stderr,
        )
        sys.exit(0 if sys.argv[1:] in (["-h"], ["--help"]) else 2)
    folder, page, numbers = sys.argv[1], sys.argv[2], set(map(int, sys.argv[3:]))
    file = os.path.join(os.path.dirname(page), "..", "data", "claims.csv")
    with open(page, encoding="utf-8") as opened:
        text = opened.read()
    rows = rows_from(folder, file, numbers)
    atomic_file.write_or_exit(page, written(text, rows))
    atomic_file.write_or_exit(os.path.join(os.path.dirname(page), "claims.md"), page_of(rows))
    atomic_file.write_or_exit(file, csv_of(rows))
