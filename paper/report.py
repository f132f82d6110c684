"""The report: report.md, report.html (one self-contained file) and report.pdf, from the files that `swirl paper` wrote to a
folder.

    /usr/bin/python3 paper/report.py out
"""

import html
import json
import os
import struct
import sys

import atomic_file
import verdicts
from captions import CONTRADICTIONS, by_section, figure_texts, image_of, question_of, title_of
from claims import all_judged
from claims.claim import UNTESTED
from first_page import crossings_of_one_setting, main_results
from html_page import bullets, described_folder, grid, inline, opening, rich, table, td
from point_names import in_words
from verdicts import FAILS, HOLDS, IN_PART, MISSING, UNDECIDED, UNTESTABLE

ORDER = [HOLDS, IN_PART, FAILS, UNDECIDED, UNTESTABLE, UNTESTED, MISSING]
MARK = {HOLDS: "✓", IN_PART: "◐", FAILS: "✗", UNDECIDED: "±", UNTESTABLE: "–", UNTESTED: "–", MISSING: "?"}
CLASS = {HOLDS: "holds", IN_PART: "part", FAILS: "fails"}
# For counts: (one claim, several claims).
WORDS = {HOLDS: ("holds", "hold"), IN_PART: ("holds in part", "hold in part"),
         FAILS: ("does not hold", "do not hold"), UNDECIDED: ("is undecided", "are undecided"),
         UNTESTABLE: ("is not testable by simulation", "are not testable by simulation"),
         UNTESTED: ("is not tested", "are not tested"), MISSING: ("was not made", "were not made")}

TITLE = "Rotation and counterrotation of swirled discs"
INTRODUCTION = (
    "Discs lie in a container that is swirled. With few discs the cluster rotates in the direction of the swirl, with "
    "many against it. L. Lee, J. P. Ryan, Y. Lahini, M. Holmes-Cerfon and S. M. Rubinstein, “Geometric frustration "
    "induces the transition between rotation and counterrotation in swirled granular media” (Phys. Rev. E 100, "
    "012903, 2019), explain it by friction at the wall and between the discs. This report answers which of their "
    "claims are confirmed by exact event-driven simulations: claims about their experiment by spheres that roll on a "
    "floor, claims about their simulation by their discs.")


def duration(seconds):
    seconds = round(seconds)
    if seconds < 100:
        return f"{seconds} s"
    return f"{seconds // 60} min {seconds % 60} s"


def judge(folder):
    """[claims.claim.Judged], with the names of points in words."""
    judged = all_judged(folder)
    for j in judged:
        j.found = in_words(j.found)
    return judged


def with_sizes(j):
    """How the verdict depends on the sizes that our reading of the paper's words requires."""
    if not j.scaled or j.verdict in (MISSING, UNTESTED, UNTESTABLE):
        return ""
    if not j.depends_on_size:
        return "the same at half and twice the size"
    return "depends on the size: " + ", ".join(
        f"{j.scaled[factor]} at {words}" for factor, words in ((0.5, "half"), (2, "twice")))


def counts(judged):
    """"Of 26 claims 19 hold, 6 hold in part, 1 does not hold." """
    found = [j.verdict for j in judged]
    numbers = [(found.count(verdict), WORDS[verdict]) for verdict in ORDER if verdict in found]
    changing = sum(j.depends_on_size for j in judged)
    return (f"Of {len(found)} claims " +
            ", ".join(f"{n} {one if n == 1 else several}" for n, (one, several) in numbers) + "." +
            (f" The verdicts on {changing} depend on the required sizes: they change at half or twice of them."
             if changing else ""))


def disagreements(judged):
    """[(heading, [(statement, found)])] of the claims that do not hold. For undecided claims the table has more."""
    groups = ((FAILS, "Does not hold"), (IN_PART, "Holds in part"), (UNDECIDED, "Undecided"))
    result = [(heading, [(f"{j.claim.statement} (judged on {j.claim.on})", "" if kind == UNDECIDED else j.found)
                         for j in judged if j.verdict == kind]) for kind, heading in groups]
    return [(heading, claims) for heading, claims in result if claims]


def parameter_rows(about):
    c = about["defaults"]
    return [("moment of inertia", c["inertia"]), ("container radius", c["container_radius"]),
            ("amplitude", c["amplitude"]), ("sides of the path", c["sides"]),
            ("period", c["period"]), ("restitution", c["restitution"]),
            ("events of a run", f"{about['events_of_a_run']:,}"), ("first seed", about["seed"]),
            ("version", about["version"]), ("built with", about["build"]),
            ("command", about["command"]),
            ("runs", f"{about['runs']}, {about['runs_of_earlier_calls']} of them from an earlier call"),
            ("time", f"{duration(about['seconds'])} for this call; all runs together "
                     f"{duration(about['seconds_on_one_core'])} on one core")]


def how_to_read(about):
    seeds = about.get("seeds_of_a_point", 8)
    quick = (" This is the quick version, with fewer points and seeds than the full study. So errors are larger. A claim "
             "whose points are missing is undecided." if about["quick"] else "")
    return ("ϖ is the rotation rate of the cluster, Ω that of the swirl, N the number of discs, and μ the friction "
            "coefficient (μ_d between discs, μ_w at the wall). ± is one standard error: the larger of the errors from "
            "within the runs and from between the seeds. A claim is decided with a probability of 99.73 %, that of "
            f"three standard deviations. With {seeds} seeds this needs {verdicts.threshold(seeds - 1):.1f} standard "
            "errors. The sign of an effect alone does not decide a claim; the text of each claim gives the required "
            "size. An undecided claim gets up to "
            f"{about.get('max_seeds_of_a_point', 32)} seeds at the points that could decide it. Verdicts are computed "
            "from the tables by the rules in paper/verdicts.py. Every other number on which a verdict depends is a "
            "named constant in paper/claims/thresholds.py or paper/paper_parameters.py. The sizes that our reading "
            "of the paper's words requires are also halved and doubled; verdicts that change are marked." + quick)


# --- Contents -----------------------------------------------------------------------------------

FIRST_PICTURES = ("5b", "1b", "4c")  # the first that exists begins the report
CLAIMS = "Claim by claim"


def contents(folder, about, judged):
    """[(kind, value)] of the whole report, in its order: what is found, then each figure, then each claim."""
    made = {figure["name"]: image_of(figure) for figure in about["figures"]}
    blocks = [("picture", made[name]) for name in FIRST_PICTURES if made.get(name)][:1]
    blocks += [("bullets", main_results(folder)), ("text", counts(judged)), ("text", INTRODUCTION),
               ("small", f"{how_to_read(about)} {crossings_of_one_setting(folder)}".strip())]
    for heading, figures in by_section(about["figures"]):
        blocks += [("section", heading), ("figures", figures)]
    blocks += [("section", "Contradictions in the paper, and the choices of this program"),
               ("table", (["topic", "the paper", "this program"], CONTRADICTIONS)),
               ("section", "Parameters, versions, time"), ("table", (["", ""], parameter_rows(about))),
               ("section", CLAIMS)]
    for heading, group in disagreements(judged):
        blocks += [("text", f"{heading}:"), ("bullets", [f"{statement}" + (f" — {found}" if found else "")
                                                         for statement, found in group])]
    return [*blocks, ("claims", judged)]


# --- Markdown -----------------------------------------------------------------------------------

def cell(text):
    return str(text).replace("|", "\\|").replace("\n", " ")


def markdown_table(head, rows):
    def line(cells):
        return f"| {' | '.join(map(cell, cells))} |"
    return [line(head), "|---" * len(head) + "|", *map(line, rows), ""]


def claim_cells(k, j):
    sizes = with_sizes(j)
    return (k, f"{j.claim.statement} ({j.claim.source})", j.claim.on, j.found,
            f"{MARK[j.verdict]} {j.verdict}{sizes and f' ({sizes})'}", j.claim.command and f"`{j.claim.command}`")


def figure_markdown(figure, caption, findings, remarks):
    title, image, question = title_of(figure), image_of(figure), question_of(figure)
    return [f"### {title}", "", *([f"![{title}]({image})", ""] if image else []),
            *([f"*{question}*", ""] if question else []), *([caption, ""] if caption else []),
            *(f"- {finding}" for finding in findings), *(["", *remarks] if remarks else []),
            "", f"`swirl paper --figure {figure['name']}`", ""]


def markdown(folder, about, judged):
    texts, lines = figure_texts(about), [f"# {TITLE}", ""]
    for kind, value in contents(folder, about, judged):
        lines += {"picture": lambda: [f"![{TITLE}]({value})", ""], "section": lambda: [f"## {value}", ""],
                  "bullets": lambda: [*(f"- {text}" for text in value), ""], "text": lambda: [value, ""],
                  "small": lambda: [value, ""], "table": lambda: markdown_table(*value),
                  "figures": lambda: [line for f in value for line in figure_markdown(f, *texts[f["name"]])],
                  "claims": lambda: markdown_table(
                      ["#", "the paper says", "judged on", "found", "verdict", "command"],
                      [claim_cells(k, j) for k, j in enumerate(value, 1)])}[kind]()
    return "\n".join(lines).rstrip() + "\n"


# --- HTML ---------------------------------------------------------------------------------------

# An image wider than this, in pixels, is made for the width of the page; figures for one column have 1012
# (style.COLUMN). So is an image that is wider than FLAT times its height.
ONE_COLUMN = 1200
FLAT = 2.0


def is_wide(path):
    """From the header of a PNG."""
    with open(path, "rb") as file:
        width, height = struct.unpack(">16xII", file.read(24))
    return width > ONE_COLUMN or width > FLAT * height


def figures_html(folder, figures, texts):
    """One section of the page: wide images span both columns, which the browser balances."""
    return grid(figure_html(folder, figure, texts) for figure in figures)


def figure_html(folder, figure, texts):
    title = title_of(figure)
    image = image_of(figure, (".svg", ".png"))
    drawn = image_of(figure)
    kind = " class=wide" if drawn and is_wide(os.path.join(folder, drawn)) else ""
    image = (f'<img alt="{html.escape(title)}" src="{inline(os.path.join(folder, image))}">' if image else "")
    caption, findings, remarks = texts[figure["name"]]
    question = f"<p class=question>{rich(question_of(figure))}</p>" if question_of(figure) else ""
    caption = f"<p>{rich(caption)}</p>" if caption else ""
    runs = f"<p class=small>{rich(' '.join(remarks))}</p>" if remarks else ""
    return (f"<figure{kind}>{image}<figcaption><h3>{rich(title)}</h3>{question}{caption}{bullets(findings)}{runs}"
            f"<code>swirl paper --figure {html.escape(figure['name'])}</code></figcaption></figure>\n")


def claim_row(k, j):
    claim, sizes = j.claim, with_sizes(j)
    command = f"<br><code>{html.escape(claim.command)}</code>" if claim.command else ""
    words = f"<br><span class=small>{html.escape(sizes)}</span>" if sizes else ""
    return (td(k), f"<td>{rich(claim.statement)} <span class=small>({html.escape(claim.source)})</span></td>",
            td(claim.on), td(j.found), f"<td><span class='verdict {CLASS.get(j.verdict, 'other')}'>{MARK[j.verdict]} "
            f"{j.verdict}</span>{words}{command}</td>")


def page(folder, about, judged):
    texts, parts = figure_texts(about), [opening(TITLE), f"<h1>{TITLE}</h1>\n"]
    for kind, value in contents(folder, about, judged):
        parts.append({"picture": lambda: f'<img class=first alt="{TITLE}" src="{inline(os.path.join(folder, value))}">\n',
                      "section": lambda: f"<h2>{value}</h2>\n", "bullets": lambda: bullets(value),
                      "text": lambda: f"<p>{rich(value)}</p>\n", "small": lambda: f"<p class=small>{rich(value)}</p>\n",
                      "table": lambda: table(value[0], [map(td, row) for row in value[1]]),
                      "figures": lambda: figures_html(folder, value, texts),
                      "claims": lambda: table(
                          ["", "the paper says", "judged on", "found", "verdict, and how to reproduce it"],
                          [claim_row(k, j) for k, j in enumerate(value, 1)], "claims")}[kind]())
    return "".join([*parts, "</body></html>\n"])


# --- PDF ----------------------------------------------------------------------------------------

def figure_blocks(figure, caption, findings, remarks):
    image, question = image_of(figure), question_of(figure)
    return [("heading", title_of(figure)), *([("image", image)] if image else []),
            *([("text", question)] if question else []), *([("text", caption)] if caption else []),
            *(("bullet", finding) for finding in findings), *(("small", remark) for remark in remarks),
            ("small", f"swirl paper --figure {figure['name']}")]


def claim_blocks(k, j):
    small = "; ".join(filter(None, (f"judged on {j.claim.on}", with_sizes(j), j.claim.command)))
    return [("text", f"{k}. {j.claim.statement} ({j.claim.source})"), ("bullet", f"{j.verdict}: {j.found}"),
            ("small", small)]


def pdf(folder, about, judged):
    from report_pdf import report_pdf  # the only part that needs matplotlib
    texts, sections = figure_texts(about), [("", [])]  # the first page has no heading
    for kind, value in contents(folder, about, judged):
        if kind == "section":
            sections.append((value, []))
            continue
        sections[-1][1].extend({
            "picture": lambda: [("image", value)], "bullets": lambda: [("bullet", text) for text in value],
            "text": lambda: [("text", value)], "small": lambda: [("small", value)],
            "table": lambda: [("bullet", f"{row[0]}: " + " Here: ".join(map(str, row[1:]))) for row in value[1]],
            "figures": lambda: [block for f in value for block in figure_blocks(f, *texts[f["name"]])],
            "claims": lambda: [block for k, j in enumerate(value, 1) for block in claim_blocks(k, j)]}[kind]())
    return report_pdf(folder, TITLE, sections[0][1], sections[1:])


def write_all(folder):
    """Writes the report from paper.json and the tables."""
    with open(os.path.join(folder, "paper.json"), encoding="utf-8") as file:
        about = json.load(file)
    judged = judge(folder)
    atomic_file.write(os.path.join(folder, "report.md"), markdown(folder, about, judged))
    atomic_file.write(os.path.join(folder, "report.html"), page(folder, about, judged))
    atomic_file.write(os.path.join(folder, "report.pdf"), pdf(folder, about, judged))


def main():
    folder, _ = described_folder("paper.json", "swirl paper --out", "Writes report.md, report.html and report.pdf")
    try:
        write_all(folder)
    except OSError as error:
        sys.exit(f"'{error.filename}' cannot be written: {error.strerror}.")


if __name__ == "__main__":
    main()
