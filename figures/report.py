"""The report: report.md and report.html (one self-contained file) from what `swirl paper` left in a
folder.

    /usr/bin/python3 figures/report.py out
"""

import base64
import html
import json
import os
import re
import struct
import sys

import claims

ORDER = [claims.HOLDS, claims.IN_PART, claims.FAILS, claims.UNDECIDED, claims.UNTESTABLE,
         claims.MISSING]
MARK = {claims.HOLDS: "✓", claims.IN_PART: "◐", claims.FAILS: "✗", claims.UNDECIDED: "±",
        claims.UNTESTABLE: "–", claims.MISSING: "?"}

CONTRADICTIONS = [
    ("Amplitude of the path", "The main text says A = 0.96, the SI 1.892 with A/R = 0.22.",
     "The first is in disc diameters, the second in radii. The SI's value is used: with it the "
     "container moves at the speed 1 that the SI states."),
    ("Moment of inertia", "The table has I = 10 for m = r = 1. A rigid plane disc cannot exceed 1 "
     "(a ring); a solid disc has ½.", "The paper's 10 is the default. Figure “inertia” shows what "
     "1 and ½ do."),
    ("Minimal time between collisions", "Predicted contacts within 10⁻¹³ are discarded, since some "
     "were found to be false.", "Not done. Discs that touch and separate are never predicted to "
     "meet; discs that touch and approach meet now."),
    ("Period of the swirl", "The table calls 11.866071 the value of ω⁻¹.",
     "It is the period T; Ω = 2π/T. With 30 sides of A = 1.892 it gives the speed 1."),
    ("Slope against angle", "The SI's formula for becoming free compares a slope with an angle, "
     "and adds up where it means an average.", "Directions are compared with directions, and "
     "angles are averaged as directions."),
    ("“Strong slip (s ≪ 1)”", "In the conclusion s ≪ 1 is strong slip and s ≈ 1 minimal slip; the "
     "text before has s = 1 as no slip.", "Both agree: s = 1 rolls, s = 0 slips."),
    ("Steady state", "No warm-up is mentioned; the first events seem to count.",
     "The first 20 swirls are left out (a fifth of the run if that is less). Where spins take "
     "longer (no disc friction), figures “transient” and “5b-steady” show both."),
    ("Collisions with the wall", "The SI says that no sign changes need care because the wall does "
     "not spin.", "The disc's own spin enters the slip at the wall with the sign of the outward "
     "normal."),
    ("A ball that slips freely", "It has γ = 0 at s = 0 and “corresponds to rotation”, but also, in "
     "the introduction, a body that nothing turns has no sense of rotation.",
     "Without torque its spin in the lab stays 0, so γ = 1 and s = R_ball/R_container: figure "
     "“ball” simulates it. Rotation needs a torque, too."),
    ("Amplitude of the experiment", "1.15 cm in a dish of 5.1 cm diameter is 0.45 R as an amplitude "
     "and 0.225 R from peak to peak.", "The SI's A/R = 0.22 is matched by half of it, so 1.15 cm must "
     "be the diameter of the path."),
    ("Coriolis force", "0–200 cm/s². A disc that moves with the wall has about 720 in the M-frame.",
     "Computed from the velocities in the M-frame (measurement “centre”)."),
    ("Which average", "Figure 5b averages over events, the experiment over time.",
     "Both are given everywhere; figure “averages” compares them."),
]

# What each figure beyond the paper asks.
QUESTIONS = {
    "spheres": "The experiment has spheres that roll on the floor of a dish; the simulation of the "
               "paper has discs with a moment of inertia that no disc has. Do spheres with their "
               "own counterrotate, and where?",
    "spheres_ingredients": "Friction of the floor, friction of contacts along the vertical, "
                           "damping, a solid sphere's inertia: each is switched off alone, at "
                           "μ = 0.2. Which of them makes counterrotation?",
    "spheres_pinned": "What the paper measured of the spheres at the wall, and what it could not: "
                      "the rolling. The correlation is 1 where the floor has its way and "
                      "neighbours rub with the sum of their speeds, −1 where they roll on each "
                      "other.",
    "spheres_coins": "The paper's simulation is of discs, and shows counterrotation with a moment "
                     "of inertia that no disc has. Do solid discs (I = 1/2) counterrotate that lie "
                     "flat and slide on a floor?",
    "averages": "The paper averages over events, an observer over time. Does it matter?",
    "transient": "Without disc friction only the wall turns the discs' spins. How long does that "
                 "take, and does the paper's average see the end of it?",
    "5b-steady": "Figure 5b once more, after a warm-up long enough for the spins.",
    "friction": "The paper shows that less friction moves the crossing to higher N. How?",
    "inertia": "The paper's discs have more inertia than a rigid plane disc can have. What of "
               "solid discs and of rings?",
    "restitution": "The paper's collisions are elastic in the normal direction. What does a loss "
                   "change?",
    "tangential": "Friction only stops the slip in the paper. What if part of it is given back?",
    "polygon": "The paper's container runs along 30 straight sides. What does that change?",
    "energy": "The paper's program crashes when both frictions are zero. Where does the energy "
              "come from?",
    "map": "Which of the two frictions decides?",
}

CSS = """
:root { color-scheme: light; }
body { font: 16px/1.5 system-ui, "DejaVu Sans", sans-serif; color: #1b1b1b; background: #fff;
       max-width: 64rem; margin: 2.5rem auto; padding: 0 1.2rem; }
h1 { font-size: 1.7rem; line-height: 1.2; margin-bottom: .3rem; }
h2 { font-size: 1.25rem; margin-top: 2.4rem; border-bottom: 1px solid #ccc; }
h3 { font-size: 1rem; margin: 0 0 .3rem; }
table { border-collapse: collapse; width: 100%; font-size: .88rem; }
th, td { text-align: left; vertical-align: top; padding: .45rem .8rem .45rem 0;
         border-bottom: 1px solid #ddd; }
td.verdict { font-weight: 600; }
.holds { color: #00694e; } .part { color: #8a5a00; } .fails { color: #a63c00; }
.other { color: #666; }
code { font-size: .85em; background: #f3f3f3; padding: .05em .3em; border-radius: 3px; }
td code { white-space: normal; overflow-wrap: anywhere; }
sub { line-height: 0; font-size: .72em; }
.figures { display: grid; grid-template-columns: 1fr 1fr; grid-auto-flow: dense; gap: 1.6rem 2rem; }
figure { margin: 0; break-inside: avoid; min-width: 0; }
figure.wide { grid-column: 1 / -1; }
figure.beside { display: grid; grid-template-columns: 1fr 1fr; gap: 2rem; align-items: start; }
figure img { display: block; width: 100%; height: auto; max-height: 34rem; object-fit: contain;
             margin: 0 0 .5rem; }
figcaption { font-size: .88rem; }
figcaption ul { padding-left: 1.1rem; margin: .3rem 0 .6rem; }
figcaption li { margin-bottom: .25rem; }
.small { color: #555; font-size: .92em; }
table.claims { table-layout: fixed; }
.claims th:nth-child(1) { width: 2.2em; }
.claims th:nth-child(2) { width: 27%; }
.claims th:nth-child(4) { width: 12%; }
.claims th:nth-child(5) { width: 16%; }
.question { color: #333; font-style: italic; margin: 0 0 .3rem; }
@media (max-width: 50rem) { .figures, figure.beside { grid-template-columns: 1fr; } }
@page { size: A4; margin: 16mm 15mm; }
@media print {
  body { font-size: 9.5pt; max-width: none; margin: 0; padding: 0; }
  .figures { gap: .5cm .7cm; }
  figure.beside { gap: .7cm; }
  figure img { max-height: 11cm; }
  table { font-size: 8pt; }
  figcaption { font-size: 8pt; }
  tr { break-inside: avoid; }
  h3 { font-size: 10pt; }
  h2, h3 { break-after: avoid; }
  code { background: none; padding: 0; }
}
"""
CLASS = {claims.HOLDS: "holds", claims.IN_PART: "part", claims.FAILS: "fails"}


def duration(seconds):
    seconds = round(seconds)
    if seconds < 100:
        return f"{seconds} s"
    return f"{seconds // 60} min {seconds % 60} s"


def judge(folder):
    return [(claim, *claim.verdict(folder)) for claim in claims.CLAIMS]


def counts(judged):
    """"19 hold, 6 hold in part, 1 does not hold." """
    many = {claims.HOLDS: "hold", claims.IN_PART: "hold in part", claims.FAILS: "do not hold",
            claims.UNDECIDED: "are undecided", claims.UNTESTABLE: "are not testable by simulation", claims.MISSING: "were not made"}
    one = {claims.UNDECIDED: "is undecided", claims.UNTESTABLE: "is not testable by simulation", claims.MISSING: "was not made"}
    found = [verdict for _, verdict, _ in judged]
    words = []
    for v in ORDER:
        if v in found:
            n = found.count(v)
            words.append(f"{n} {one.get(v, v) if n == 1 else many[v]}")
    return f"Of {len(found)} claims " + ", ".join(words) + "."


def in_short(judged):
    """What disagrees, first of all: (what, [(says, found)])."""
    groups = ((claims.FAILS, "Does not hold"), (claims.IN_PART, "Holds in part"),
              (claims.UNDECIDED, "Undecided"))
    result = []
    for kind, heading in groups:
        here = [(claim.says, found) for claim, verdict, found in judged if verdict == kind]
        if here:
            result.append((heading, here))
    return result


def parameter_rows(about):
    c = about["defaults"]
    return [("moment of inertia", c["inertia"]), ("container radius", c["container_radius"]),
            ("amplitude", c["amplitude"]), ("sides of the path", c["sides"]),
            ("period", c["period"]), ("restitution", c["restitution"]),
            ("events of a run", f"{about['events_of_a_run']:,}"), ("first seed", about["seed"]),
            ("version", about["version"]), ("built with", about["build"]),
            ("command", about["command"]),
            ("runs", f"{about['runs']}, {about['runs_of_earlier_calls']} of them from an earlier "
                     "call"),
            ("time", f"{duration(about['seconds'])} for this call; all runs together "
                     f"{duration(about['seconds_on_one_core'])} of one core each")]


def quick_sentence(about):
    if not about["quick"]:
        return ""
    return ("This is the quick version: shorter runs and fewer points than the paper's, so errors "
            "are larger and verdicts may differ from those of the whole study.")


def intro(about):
    """What was asked, what was done."""
    return ("A dish of discs is swirled. With few discs the cluster rotates in the sense of the "
            "swirl, with many against it. L. Lee, J. P. Ryan, Y. Lahini, M. Holmes-Cerfon and "
            "S. M. Rubinstein, “Geometric frustration induces the transition between rotation and "
            "counterrotation in swirled granular media” (Phys. Rev. E 100, 012903, 2019), explain "
            "it by friction: at the wall and between the discs. Asked here is which of their claims "
            "an exact event-driven simulation of their model confirms. "
            "± is one standard error, between seeds and within runs, whichever is larger; three of "
            "them decide. What they do not decide is undecided, after "
            f"{about.get('most_seeds_of_a_point', 32)} seeds at the points concerned. Verdicts are "
            "computed from the tables by the rules of figures/verdicts.py; every other number that "
            "a verdict depends on has a name in figures/claims.py. "
            + quick_sentence(about)).strip()


# The same setting, both frictions 1 and I = 10, in several figures: (figure, curve, how).
SAME_SETTING = (("5b", "high", "by event"), ("1b", "high", "by time, the same runs"),
                ("restitution", "1", "by time, shorter runs, fewer seeds and N"),
                ("inertia", "10", "by time, shorter runs, fewer seeds and N"))


def crossings_of_one_setting(folder):
    """N_c for both frictions 1 wherever the report has it, and whether the values agree."""
    found = []
    for figure, curve, how in SAME_SETTING:
        try:
            c = claims.Folder(folder).crossing(figure, curve)
        except (FileNotFoundError, IndexError, KeyError):
            continue
        if c.verdict == "crosses":
            found.append((figure, c.at, how))
    if len(found) < 2:
        return ""
    first = found[0][1]
    apart = max(abs(at.mean - first.mean) / max((at - first).error, 1e-9)
                for _, at, _ in found[1:])
    listed = "; ".join(f"{claims.number(at)} (figure {figure}, {how})" for figure, at, how in found)
    return (f"N_c for both frictions 1 is estimated more than once: {listed}. The first is the one "
            f"to quote; the others differ from it by at most {apart:.1f} standard errors.")


def split(figures):
    """Those of the paper, of its experiment's spheres, and those that are new: with a heading
    each, if there are any."""
    groups = [("The paper’s figures", []), ("Spheres that roll", []), ("What is new", [])]
    for figure in figures:
        about = figure["description"]
        groups[2 if about.startswith("beyond the paper") else
               1 if about.startswith("spheres that roll") else 0][1].append(figure)
    return [(heading, members) for heading, members in groups if members]


def title_of(figure):
    text = figure["description"].removeprefix("beyond the paper: ").removeprefix("spheres that roll: ")
    name = figure["name"]
    return f"Figure {name}: {text}" if name[0].isdigit() else text[0].upper() + text[1:]


def question_of(figure):
    return QUESTIONS.get(figure["name"], "")


def sentence(text):
    # Not ϖ, whose capital is Π.
    return text[:1].upper() + text[1:] if text[:1].isascii() else text


def picture_of(figure):
    return next((f for f in figure["files"] if f.endswith(".png")), None)


# --- Markdown ---------------------------------------------------------------------------------

def cell(text):
    return str(text).replace("|", "\\|").replace("\n", " ")


def markdown(about, judged, same=""):
    lines = ["# The paper, claim by claim", "", intro(about), "", f"**{counts(judged)}**", ""]
    if same:
        lines += [same, ""]
    for heading, which in in_short(judged):
        lines += [f"{heading}:", ""] + [f"- {says} — {found}" for says, found in which] + [""]
    lines += ["## Claim by claim", "", "| # | the paper says | found | verdict | command |", "|---|---|---|---|---|"]
    for k, (claim, verdict, found) in enumerate(judged, 1):
        command = f"`{claim.command}`" if claim.command else ""
        lines.append(f"| {k} | {cell(claim.says)} ({claim.where}) | {cell(found)} | "
                     f"{MARK[verdict]} {verdict} | {command} |")
    for heading, figures in split(about["figures"]):
        lines += ["", f"## {heading}"]
        for figure in figures:
            lines += ["", f"### {title_of(figure)}", ""]
            if picture_of(figure):
                lines += [f"![{title_of(figure)}]({picture_of(figure)})", ""]
            if question_of(figure):
                lines += [f"*{question_of(figure)}*", ""]
            lines += [f"- {sentence(finding)}" for finding in figure["findings"]]
            lines += ["", f"`swirl paper --figure {figure['name']}`"]
    lines += ["", "## Where the paper contradicts itself, and what was assumed", "",
              "| matter | the paper | here |", "|---|---|---|"]
    lines += [f"| {cell(a)} | {cell(b)} | {cell(c)} |" for a, b, c in CONTRADICTIONS]
    lines += ["", "## Parameters, versions, time", "", "| | |", "|---|---|"]
    lines += [f"| {cell(a)} | {cell(b)} |" for a, b in parameter_rows(about)]
    return "\n".join(lines) + "\n"


# --- HTML -------------------------------------------------------------------------------------

def inline(path):
    with open(path, "rb") as file:
        return "data:image/png;base64," + base64.b64encode(file.read()).decode()


def table(head, rows, kind=""):
    top = "".join(f"<th>{html.escape(h)}</th>" for h in head)
    body = "".join("<tr>" + "".join(row) + "</tr>\n" for row in rows)
    return f"<table class='{kind}'><thead><tr>{top}</tr></thead><tbody>\n{body}</tbody></table>\n"


def td(text, kind=""):
    kind = f' class="{kind}"' if kind else ""
    return f"<td{kind}>{rich(text)}</td>"


SUBSCRIPT = re.compile(r"\b([NRVϖμγ])_(container|cluster|ball|wall|[A-Za-z])\b")


def rich(text):
    """Escaped, with N_c and its like as they are printed."""
    return SUBSCRIPT.sub(r"\1<sub>\2</sub>", html.escape(str(text)))


# Wider than this many times its height, a picture takes the whole width of the page.
WIDE = 1.45


def is_wide(path):
    """Of a PNG: the first thing in it is its width and height."""
    with open(path, "rb") as file:
        width, height = struct.unpack(">16xII", file.read(24))
    return width > WIDE * height


# And so many letters of findings stand beside their picture, across the page.
LONG = 900


def figure_html(folder, figure):
    title = rich(title_of(figure))
    picture = picture_of(figure)
    kind = ""
    if picture and is_wide(os.path.join(folder, picture)):
        kind = " class=wide"
    elif sum(len(finding) for finding in figure["findings"]) > LONG:
        kind = ' class="wide beside"'
    image = (f'<img alt="{html.escape(title_of(figure))}" '
             f'src="{inline(os.path.join(folder, picture))}">' if picture else "")
    question = (f"<p class=question>{rich(question_of(figure))}</p>" if question_of(figure)
                else "")
    findings = "".join(f"<li>{rich(sentence(finding))}</li>" for finding in figure["findings"])
    return (f"<figure{kind}>{image}<figcaption><h3>{title}</h3>{question}"
            f"{'<ul>' + findings + '</ul>' if findings else ''}"
            f"<code>swirl paper --figure {html.escape(figure['name'])}</code></figcaption>"
            "</figure>\n")


def grid(figures):
    """Two beside each other, and wide ones across."""
    return "<div class=figures>\n" + "".join(figures) + "</div>\n"


def page(folder, about, judged):
    rows = [(td(k), f"<td>{rich(claim.says)} <span class=small>({html.escape(claim.where)})"
             "</span></td>", td(found),
             td(f"{MARK[verdict]} {verdict}", "verdict " + CLASS.get(verdict, "other")),
             f"<td><code>{html.escape(claim.command)}</code></td>" if claim.command else "<td></td>")
            for k, (claim, verdict, found) in enumerate(judged, 1)]
    parts = [opening("The paper, claim by claim"),
             "<h1>The paper, claim by claim</h1>", f"<p>{html.escape(intro(about))}</p>\n",
             f"<p><b>{html.escape(counts(judged))}</b></p>\n"]
    same = crossings_of_one_setting(folder)
    if same:
        parts += [f"<p>{rich(same)}</p>\n"]
    for heading, which in in_short(judged):
        items = "".join(f"<li>{rich(says)} <span class=small>{rich(found)}</span></li>"
                        for says, found in which)
        parts += [f"<p>{heading}:</p><ul>{items}</ul>\n"]
    parts += ["<h2>Claim by claim</h2>\n",
             table(["", "the paper says", "found", "verdict", "command"], rows, "claims")]
    for heading, figures in split(about["figures"]):
        parts += [f"<h2>{heading}</h2>\n"]
        parts += [grid([figure_html(folder, figure) for figure in figures])]
    parts += ["<h2>Where the paper contradicts itself, and what was assumed</h2>\n",
              table(["matter", "the paper", "here"],
                    [(td(a), td(b), td(c)) for a, b, c in CONTRADICTIONS]),
              "<h2>Parameters, versions, time</h2>\n",
              table(["", ""], [(td(a), td(b)) for a, b in parameter_rows(about)]),
              "</body></html>\n"]
    return "".join(parts)


def write(path, text):
    aside = f"{path}.{os.getpid()}.partial"
    with open(aside, "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(aside, path)


def opening(title):
    """What every page begins with."""
    return ("<!doctype html>\n<html lang=en><head><meta charset=utf-8>"
            '<meta name=viewport content="width=device-width, initial-scale=1">'
            f"<title>{title}</title><style>{CSS}</style></head><body>\n")


def described_folder(name, command, what):
    """The folder that the call names, and what `command FOLDER` wrote of itself there as NAME."""
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print(f"usage: /usr/bin/python3 {sys.argv[0]} FOLDER\n"
              f"{what} from what `{command} FOLDER` left there", file=sys.stderr)
        sys.exit(0 if sys.argv[1:] in (["-h"], ["--help"]) else 2)
    folder = sys.argv[1]
    try:
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            return folder, json.load(file)
    except FileNotFoundError:
        sys.exit(f"There is no '{folder}/{name}'; `{command.removesuffix(' --out')}` writes it.")


def main():
    folder, about = described_folder("paper.json", "swirl paper --out",
                                     "writes report.md and report.html")
    judged = judge(folder)
    write(os.path.join(folder, "report.md"), markdown(about, judged, crossings_of_one_setting(folder)))
    write(os.path.join(folder, "report.html"), page(folder, about, judged))


if __name__ == "__main__":
    main()
