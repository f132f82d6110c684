"""The report: report.md, and report.html (one self-contained file, with a layout for A4 when it is
printed), from the files that `swirl paper` wrote to a folder.

    /usr/bin/python3 paper report out
"""

import json
import os
import sys

from paper import atomic_file, verdicts
from paper.captions import CONTRADICTIONS, by_section, figure_texts, image_of, question_of, title_of
from paper.claims import all_judged
from paper.claims.claim import UNTESTED
from paper.claims.wording import headline
from paper.console import duration
from paper.summary import main_results
from paper.html_page import described_folder, rendered, size_of
from paper.point_names import in_words
from paper.verdicts import FAILS, HOLDS, IN_PART, MISSING, UNDECIDED, UNTESTABLE

ORDER = [HOLDS, IN_PART, FAILS, UNDECIDED, UNTESTABLE, UNTESTED, MISSING]
MARK = {
    HOLDS: "✓",
    IN_PART: "◐",
    FAILS: "✗",
    UNDECIDED: "±",
    UNTESTABLE: "–",
    UNTESTED: "–",
    MISSING: "?",
}
CLASS = {HOLDS: "holds", IN_PART: "part", FAILS: "fails"}
# For counts: (one claim, several claims).
WORDS = {
    HOLDS: ("holds", "hold"),
    IN_PART: ("holds in part", "hold in part"),
    FAILS: ("does not hold", "do not hold"),
    UNDECIDED: ("is undecided", "are undecided"),
    UNTESTABLE: ("is not testable by simulation", "are not testable by simulation"),
    UNTESTED: ("is not tested", "are not tested"),
    MISSING: ("was not made", "were not made"),
}

TITLE = "Rotation and counterrotation of particles in a swirled container"
INTRODUCTION = (
    "Few particles in a swirled container rotate with the swirl, many against it. Lee, Ryan, "
    "Lahini, Holmes-Cerfon and "
    "Rubinstein (Phys. Rev. E 100, 012903, 2019) explain this by friction and geometric "
    "frustration. Their statements are "
    "tested by exact event-driven simulations: those about the experiment on spheres that roll on "
    "a floor, those about the simulation on discs."
)
ABSTRACT_WORDS = 120


def judge(folder):
    """[claims.claim.Judged], with the names of points in words."""
    judged = all_judged(folder)
    for j in judged:
        j.found = in_words(j.found)
    return judged


def with_sizes(j):
    """How the verdict depends on the sizes that our reading of the paper's words requires."""
    if not j.depends_on_size or j.verdict in (MISSING, UNTESTED, UNTESTABLE):
        return ""
    return "depends on the size: " + ", ".join(
        f"{j.scaled[factor]} at {words}" for factor, words in ((0.5, "half"), (2, "twice"))
    )


def counts(judged):
    """ "Of 26 claims 19 hold, 6 hold in part, 1 does not hold." """
    found = [j.verdict for j in judged]
    numbers = [(found.count(verdict), WORDS[verdict]) for verdict in ORDER if verdict in found]
    changing = sum(j.depends_on_size for j in judged)
    return (
        f"Of {len(found)} claims "
        + ", ".join(f"{n} {one if n == 1 else several}" for n, (one, several) in numbers)
        + "."
        + (
            f" The verdicts on {changing} depend on the required sizes: they change at half or "
            "twice of them."
            if changing
            else ""
        )
    )


def abstract(judged, results):
    """What was asked, the first results that fit, and the counts of the verdicts, within
    ABSTRACT_WORDS."""
    counted, said = counts(judged), []
    for sentence in results:
        if len(" ".join([INTRODUCTION, *said, sentence, counted]).split()) <= ABSTRACT_WORDS:
            said.append(sentence)
    return " ".join([INTRODUCTION, *said, counted])


def parameter_rows(about):
    c = about["defaults"]
    return [
        ("moment of inertia", c["inertia"]),
        ("container radius", c["container_radius"]),
        ("amplitude", c["amplitude"]),
        ("sides of the path", c["sides"]),
        ("period", c["period"]),
        ("restitution", c["restitution"]),
        ("events of a run", f"{about['events_of_a_run']:,}"),
        ("first seed", about["seed"]),
        ("version", about["version"]),
        ("built with", about["build"]),
        ("command", about["command"]),
        ("runs", f"{about['runs']}, {about['runs_of_earlier_calls']} of them from an earlier call"),
        (
            "time",
            f"{duration(about['seconds'])} for this call; all runs together "
            f"{duration(about['seconds_on_one_core'])} on one core",
        ),
    ]


def how_to_read(about):
    seeds = about.get("seeds_of_a_point", 8)
    quick = (
        " This is the quick version, with fewer points and seeds than the full study. So errors "
        "are larger. A claim whose points are missing is undecided."
        if about["quick"]
        else ""
    )
    return (
        "ϖ is the rotation rate of the cluster, Ω that of the swirl, N the number of discs, and μ "
        "the friction "
        "coefficient (μ_d between discs, μ_w at the wall). ± is one standard error: the larger of "
        "the errors from "
        "within the runs and from between the seeds. A claim is decided with a probability of "
        f"99.73 %, that of three standard deviations. With {seeds} seeds this needs "
        f"{verdicts.threshold(seeds - 1):.1f} standard "
        "errors. The sign of an effect alone does not decide a claim; the text of each claim gives "
        "the required size. An undecided claim gets up to "
        f"{about.get('max_seeds_of_a_point', 32)} seeds at the points that could decide it. "
        "Verdicts are computed "
        "from the tables by the rules in paper/verdicts.py. Every other number on which a verdict "
        "depends is a "
        "named constant in paper/claims/thresholds.py or paper/paper_parameters.py. The sizes that "
        "our reading "
        "of the paper's words requires are also halved and doubled; verdicts that change are "
        "marked. verdicts.json has all numbers "
        "behind each verdict." + quick
    )


# --- Contents -----------------------------------------------------------------------------------

# The figure that stands for its group: the first that was made.
LEADING = ("5b", "1b", "friction", "spheres_ingredients", "size")
MOST_FINDINGS = 4  # below a figure; the tables have the others
CLAIMS = "The claims"
# An image wider than this, in pixels, is made for the width of the page; figures for one column
# have 1012 (style.COLUMN). So is an image that is wider than FLAT times its height.
ONE_COLUMN = 1200
FLAT = 2.0


def contents(folder, about, judged):
    """The blocks of the report (html_page.py), as in a paper: abstract, results, a figure of each
    group with the list of the others, the claims in one table, methods, contradictions."""
    results, texts = main_results(folder), figure_texts(about)
    blocks = [
        ("section", "Abstract"),
        ("text", abstract(judged, results)),
        ("section", "Results"),
        ("bullets", results),
    ]
    for heading, figures in by_section(about["figures"]):
        leading = leading_figure(figures)
        blocks += [("section", heading), ("figures", [figure_row(folder, leading, texts)])]
        if others := [
            (name_of(figure), title_of(figure)) for figure in figures if figure is not leading
        ]:
            blocks.append(("table", (["further figures", "what they show"], others)))
    return [
        *blocks,
        ("section", CLAIMS),
        ("text", counts(judged)),
        ("claims", [claim_row(k, j) for k, j in enumerate(judged, 1)]),
        ("section", "Methods"),
        ("text", how_to_read(about)),
        ("table", (["", ""], parameter_rows(about))),
        ("section", "Contradictions in the paper, and the choices of this program"),
        ("table", (["topic", "the paper", "this program"], CONTRADICTIONS)),
    ]


def name_of(figure):
    """The name for --figure; its image and its table are figure_NAME.png and .csv."""
    return figure["name"]


def leading_figure(figures):
    with_image = [figure for figure in figures if image_of(figure)] or figures
    return next(
        (figure for name in LEADING for figure in with_image if figure["name"] == name),
        with_image[0],
    )


def figure_row(folder, figure, texts):
    image, (caption, findings, remarks) = image_of(figure), texts[figure["name"]]
    width, height = size_of(os.path.join(folder, image)) if image else (0, 0)
    return {
        "title": title_of(figure),
        "images": [image] if image else [],
        "question": question_of(figure),
        "wide": width > ONE_COLUMN or width > FLAT * height,
        "caption": caption,
        "findings": findings[:MOST_FINDINGS],
        "remarks": remarks,
        "command": f"swirl paper --figure {figure['name']}",
    }


def claim_row(k, j):
    return {
        "number": k,
        "statement": j.claim.statement,
        "source": j.claim.source,
        "on": j.claim.on,
        "found": headline(j.found),
        "verdict": j.verdict,
        "mark": MARK[j.verdict],
        "look": CLASS.get(j.verdict, "other"),
        "sizes": with_sizes(j),
        "command": j.claim.figure and f"--figure {j.claim.figure}",
    }


def write_all(folder):
    """Writes the report from paper.json and the tables."""
    with open(os.path.join(folder, "paper.json"), encoding="utf-8") as file:
        about = json.load(file)
    blocks = contents(folder, about, judge(folder))
    for kind in ("md", "html"):
        atomic_file.write(
            os.path.join(folder, f"report.{kind}"),
            rendered(f"page.{kind}.j2", folder, title=TITLE, blocks=blocks),
        )


def main():
    folder, _ = described_folder(
        "paper.json", "swirl paper --out", "Writes report.md and report.html"
    )
    try:
        write_all(folder)
    except OSError as error:
        sys.exit(f"'{error.filename}' cannot be written: {error.strerror}.")
