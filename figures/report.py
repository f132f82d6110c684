"""The report: report.md and report.html (one self-contained file) from what `swirl paper` left in a
folder.

    /usr/bin/python3 figures/report.py out
"""

import base64
import html
import json
import math
import os
import re
import struct
import sys

import claims
import verdicts
import atomic_file

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
    ("Which rotation", "ϖ is the mean over the discs of (r × v)/r² about the centre of mass: those near "
     "it, whose r² is small, weigh most, and the variance diverges.", "The paper's mean is the one that is "
     "judged. Every table also has the rotation of the rigid body that fits the velocities best "
     "(rigid_by_event, rigid_by_time). The two change sign at different N; figure 5b has N_c by all four "
     "rates."),
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
    "spheres_ingredients_rough": "Does the answer depend on the friction? Once more at μ = 0.3.",
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
    "inertia": "The paper's discs have more inertia than a rigid plane disc can have. Where do solid discs "
               "(I = ½), rings (1) and discs of other inertia change their direction?",
    "restitution": "The paper's collisions are elastic in the normal direction. What does a loss "
                   "change?",
    "tangential": "Friction only stops the slip in the paper. What if part of it is given back?",
    "polygon": "The paper's container runs along 30 straight sides. What does that change?",
    "condensation": "Without disc friction the paper sees a loose, gas-like cluster. How long does it "
                    "last, and what comes after it?",
    "energy": "The paper's program crashes when both frictions are zero. Where does the energy "
              "come from?",
    "map": "Which of the two frictions decides?",
}

# What each figure shows, in the words of the field. Numbers are the findings', from the tables.
CAPTIONS = {
    "1b": "Rotation frequency ϖ of the cluster about its centre of mass, in units of the swirl's Ω, "
          "against the number of discs: above zero the cluster rotates with the swirl, below it "
          "counterrotates. Dashed: a rigid pancake of the cluster's perimeter that rolls along the "
          "wall without slipping, 1 − P_container/P_cluster. Averages over time.",
    "1c": "Left: the centre C of the dish runs round the centre S of the swirl, and the dish does not "
          "turn; M is the point of the wall farthest from S. Middle: in the M-frame, which turns with "
          "the swirl, S, C and M stand still and the wall turns clockwise with −Ω. Right: the inertial "
          "forces there, the centrifugal force away from S (orange) and, on one disc, the Coriolis "
          "force to the right of its velocity v.",
    "2a": "One instant in the M-frame. Pinned discs fly along the wall until their path turns sharply "
          "(the SI's criterion); loose ones cross the dish. Shaded: one of the angular slices over "
          "which the profiles of Figure 3 are averaged. M is at the bottom, at θ = 270°.",
    "2b": "Averages in the M-frame, of few discs: number density of their centres (colour), and their mean "
          "velocity relative to the dish (arrows), in units of the speed of the dish. S is the centre "
          "of the swirl, M the point of the wall farthest from it. Where an arrow is short, discs move "
          "with the wall.",
    "2c": "The same of many discs. Each map has its own scale of colours.",
    "3a": "Mean angular velocity of the discs about the centre of mass of the cluster, in the M-frame, "
          "against the angle θ; one curve for each number of discs. Dashed: −Ω, the wall's. Discs move "
          "clockwise, to smaller θ. Slices are 5° wide; the paper's slice slides around the container, and its width "
          "is not given (figures/figure_3a.py draws slices of any width that slide by 5°). Triangles: where residences in the wall layer begin, on average, "
          "circles: where they end.",
    "3b": "The same, divided by the angular velocity that the wall has at this θ about the same centre "
          "of mass: 1 (dashed) is motion with the wall.",
    "pinning": "How the places at which discs become pinned (above) and free (below) are distributed over the "
               "angle θ, for few discs and for many. Red, dashed: by the criterion of the SI as it stands, a disc "
               "is pinned while it flies along the wall, however far from it, and becomes pinned where it turns "
               "sharply. Blue: a disc is pinned while it is resident in the layer at the wall, its rim within half a radius "
               "of it, that lasts at least 40/511 of a swirl. Triangles: mean directions. The resultant is the "
               "length of the mean of unit vectors towards the places: 1 if all are one, 0 if they have no mean "
               "direction. Claims on the pinned region go by the residences.",
    "4a": "Slip parameter s at the wall: 1 is rolling without slip, 0 free slip. Of the discs resident in the "
          "wall layer (full), of all that the SI's criterion calls pinned (dashed), and of the whole cluster "
          "(dotted); for a rough wall and rough discs (μ = 1) and for smooth ones (μ = 0.1).",
    "4b": "How discs at the wall are kept from spinning; full red symbols are discs resident in the wall layer, "
          "open ones those that the SI's criterion calls pinned. Left: mean magnitude of the spin, in Ω; 0 is "
          "a disc that sticks to the wall. Middle: correlation of the spins of neighbours, one or both "
          "of which are resident, and, weighted by impulse, of colliding discs; gears would have −1. Right: share of the contacts that close a triangle, "
          "which cannot all roll, share of the collisions in which friction stops the slip altogether, and the "
          "hexatic order ψ6 of the packing.",
    "4c": "Rotation of the cluster against the number of discs for smooth (μ = 0.1) and rough (μ = 1) "
          "discs and walls. The frictions of the experiment's smooth and roughened spheres are not "
          "known: these two are a choice. Averages over time.",
    "5a": "A snapshot of the simulation in the lab frame; the line on each disc turns with it. The "
          "circle is the path of the dish's centre C round S.",
    "5b": "Rotation of the cluster against the number of discs for five pairs of frictions, between discs "
          "(μ_d) and at the wall (μ_w), averaged over events as in the paper. Below, the same around zero.",
    "5c": "Number density of the discs' centres in the M-frame, counted by event on 100 × 100 cells as in "
          "the paper; each map has its own scale.",
    "5d": "Mean velocity of the discs relative to the dish, in units of the speed of the dish, in the "
          "M-frame on 20 × 20 cells. One scale for both numbers of discs.",
    "ball": "The paper's minimal model, simulated: one large disc in the dish. γ is its angular "
            "velocity in the M-frame over Ω, so that it counterrotates above 1; dashed: γ of rolling "
            "without slip. With e = 0.5 it loses energy where it hits the wall, with e = 1 none.",
    "states": "Motion in the M-frame with both frictions and without one of them. Left: the mean speed of "
              "the discs; right: the granular temperature, the mean energy of what is left after the local "
              "mean flow is taken off. Without disc friction this is the state after 300 periods; what was before it "
              "is in figure “condensation”.",
    "condensation": "Without disc friction, from the start. Above: the period in which the cluster condenses, that "
                    "is, from which on the discs hardly move in the M-frame and the cluster turns with ϖ = Ω. Below: "
                    "the granular temperature until then and in the 50 periods after it.",
    "times": "How close in time two collisions of a run come, which is what the precision of the event "
             "times must resolve.",
    "spheres": "Rotation of spheres that roll on the floor of the experiment's dish against their number, for several "
               "frictions μ of the spheres and the wall. Averages over time. The scale is coarser above the dotted "
               "line. 56 and 57 spheres fit, too, and are left out: the packing that a run began with decides there, "
               "not friction.",
    "spheres_ingredients": "Rotation against the number of spheres with all ingredients of the model (black), and "
                           "with one of them taken away. Vertical friction is the part of the contacts' friction "
                           "that acts on the vertical slip of spheres that roll.",
    "spheres_ingredients_rough": "Rotation with all ingredients (black), and with one of them taken away, where the "
                                 "sense of rotation is decided.",
    "spheres_pinned": "Of spheres resident in the wall layer (full) and of those that the SI's criterion calls "
                      "pinned (open): slip parameter s and the spin about the vertical. Below, of all spheres: the "
                      "share that rolls on the floor without slip, and the correlation of the rolling of neighbours "
                      "along the line of their centres.",
    "spheres_coins": "Rotation against the number of solid discs that lie flat on the floor, without friction of the "
                     "floor and for three values of it.",
    "spheres_sense": "Every number of spheres at which the direction of rotation changes, against the friction "
                     "of spheres and wall. Bars without a point: the change lies between two numbers that were "
                     "run. Crosses: the sign is undetermined there. Dashed: where the paper's experiment has the "
                     "change.",
    "spheres_restitution": "Rotation of spheres against their number, for the restitution e of their "
                           "contacts.",
    "spheres_few": "A few spheres after a long warm-up: ϖ, and the share of them that is resident at the wall. A row that "
                   "rolls along the wall with the swirl has 1 for both (ϖ in units of Ω).",
    "spheres_map": "Rotation of the cluster in colour and as a number: positive rotates with the swirl, "
                   "negative against it.",
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
.verdict { font-weight: 600; }
.holds { color: #00694e; } .part { color: #8a5a00; } .fails { color: #a63c00; }
.other { color: #666; }
code { font-size: .85em; background: #f3f3f3; padding: .05em .3em; border-radius: 3px; }
td code { white-space: normal; overflow-wrap: anywhere; }
sub { line-height: 0; font-size: .72em; }
.figures { display: grid; grid-template-columns: 1fr 1fr; gap: 1.6rem 2rem; }
.figures > div { min-width: 0; }
.figures > div > figure + figure { margin-top: 1.6rem; }
figure { margin: 0; min-width: 0; }
figure.beside { break-inside: avoid; }
figure:not(.beside) img { break-inside: avoid; break-after: avoid; }
figure:not(.beside) li { break-inside: avoid; }
figcaption > code { display: block; width: fit-content; break-before: avoid; }
figure.wide { grid-column: 1 / -1; }
figure.beside { display: grid; grid-template-columns: 1fr 1fr; gap: 2rem; align-items: start; }
figure img { display: block; width: 100%; height: auto; max-height: 44rem; object-fit: contain;
             margin: 0 0 .5rem; }
figcaption { font-size: .88rem; }
figcaption p { margin: 0 0 .3rem; }
figcaption ul { padding-left: 1.1rem; margin: .3rem 0 .6rem; }
figcaption li { margin-bottom: .25rem; }
.small { color: #555; font-size: .92em; }
table.claims { table-layout: fixed; }
.claims th:nth-child(1) { width: 2.2em; }
.claims th:nth-child(2) { width: 26%; }
.claims th:nth-child(4) { width: 18%; }
.question { color: #333; font-style: italic; margin: 0 0 .3rem; }
@media screen and (max-width: 50rem) { .figures, figure.beside { grid-template-columns: 1fr; } }
@page { size: A4; margin: 16mm 15mm; }
@media print {
  body { font-size: 9.5pt; max-width: none; margin: 0; padding: 0; }
  .figures { gap: .5cm .7cm; }
  .figures > div > figure + figure { margin-top: .5cm; }
  figure.beside { gap: .7cm; }
  figure img { max-height: 15cm; }
  table { font-size: 8pt; }
  figcaption { font-size: 8pt; }
  tr { break-inside: avoid; }
  h3 { font-size: 10pt; }
  h2, h3, .heading { break-after: avoid; }
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
    judged = [(claim, *claim.verdict(folder)) for claim in claims.CLAIMS]
    return [(claim, verdict, in_words(found)) for claim, verdict, found in judged]


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
    """What disagrees, first of all: (what, [(says, found)]). Of what is undecided the table says more."""
    groups = ((claims.FAILS, "Does not hold"), (claims.IN_PART, "Holds in part"),
              (claims.UNDECIDED, "Undecided"))
    result = []
    for kind, heading in groups:
        here = [(claim.says, "" if kind == claims.UNDECIDED else found)
                for claim, verdict, found in judged if verdict == kind]
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


TITLE = "Rotation and counterrotation of swirled discs"


def intro():
    """What was asked."""
    return ("A dish of discs is swirled. With few discs the cluster rotates in the sense of the "
            "swirl, with many against it. L. Lee, J. P. Ryan, Y. Lahini, M. Holmes-Cerfon and "
            "S. M. Rubinstein, “Geometric frustration induces the transition between rotation and "
            "counterrotation in swirled granular media” (Phys. Rev. E 100, 012903, 2019), explain "
            "it by friction: at the wall and between the discs. Asked here is which of their claims "
            "an exact event-driven simulation of their model confirms, and of spheres that roll on a "
            "floor, as those of their experiment do.")


def how_to_read(about):
    seeds = about.get("seeds_of_a_point", 8)
    return ("ϖ is the rotation frequency of the cluster, Ω that of the swirl, N the number of discs, μ "
            "the friction (μ_d between discs, μ_w at the wall). "
            "± is one standard error, between seeds and within runs, whichever is larger. A claim is "
            "decided by the probability of three standard deviations, 99.73 %: with "
            f"{seeds} seeds these are {verdicts.threshold(seeds - 1):.1f} errors. A sign alone decides "
            "nothing: each claim has a size that would matter, which the text gives. A claim that is not "
            f"decided gets up to {about.get('most_seeds_of_a_point', 32)} seeds at the points that could "
            "decide it, and is undecided after that. Verdicts are "
            "computed from the tables by the rules of figures/verdicts.py; every other number that "
            "a verdict depends on has a name in figures/claims.py. "
            + quick_sentence(about)).strip()


# --- what was found, in words -----------------------------------------------------------------

def statement(part, holds, fails, undecided):
    """The one that the verdict calls for."""
    if part.verdict == claims.IN_PART:
        return fails.replace("is not confirmed", "is confirmed only in part")
    return {claims.HOLDS: holds, claims.UNDECIDED: undecided}.get(part.verdict, fails)


def rotation_at(row, column="by_event"):
    return f"ϖ/Ω = {claims.number(claims.value(row, column))} at N = {row['discs']:.0f}"


def known(rows, column="by_event"):
    return [row for row in rows if row[column] == row[column]]


def lowest_of(folder, setting):
    return rotation_at(min(known(folder.curve("5b", most=math.inf, setting=setting)),
                           key=lambda row: row["by_event"]))


def change_of(crossing):
    """Where a curve changes its sense, for a sentence."""
    if crossing.verdict == "crosses":
        return f"at {claims.crossing_sentence(crossing.words)}"
    low = f"ϖ/Ω is lowest at N = {crossing.lowest_discs:.0f}, {claims.number(crossing.lowest)}"
    if crossing.verdict == "always rotates":
        return f"not at all ({low})"
    if crossing.verdict == "always counterrotates":
        return f"nowhere, as all counterrotate ({low})"
    return f"nowhere for certain ({low})"


def found_transition(folder):
    part, _ = claims.transition(folder)
    rows = known(folder.curve("5b", setting="high"))
    ends = f"{rotation_at(rows[0])}, {rotation_at(rows[-1])}"
    change = change_of(folder.crossing("5b", "high"))
    return statement(
        part,
        "With friction at the wall and between the discs (μ = 1), few discs rotate with the swirl and "
        f"many against it ({ends}); the sense changes {change}.",
        "That with friction at the wall and between the discs (μ = 1) few discs rotate with the swirl and "
        f"many against it is not confirmed: {ends}; the sense changes {change}.",
        "Whether with friction at the wall and between the discs (μ = 1) few discs rotate with the swirl "
        f"and many against it is undecided: {ends}; the sense changes {change}.")


def found_order(folder):
    part, _ = claims.friction_order(folder)
    changes = ", ".join(f"with μ = {mu} {change_of(folder.crossing('5b', name))}"
                        for mu, name in (("0.5", "medium"), ("0.1", "low")))
    return statement(
        part, f"The less friction, the later: {changes}.",
        f"Less friction does not always move the change to more discs: {changes}.",
        f"Whether less friction always moves the change to more discs is undecided: {changes}.")


def found_both_needed(folder):
    """That there is no counterrotation without either friction."""
    cases = [(claims.never_crosses(setting)(folder)[0], words, lowest_of(folder, setting))
             for setting, words in (("no-wall", "friction at the wall"),
                                    ("no-disc", "friction between the discs"))]
    if all(part.verdict == claims.HOLDS for part, _, _ in cases):
        return ("The cluster counterrotates only with both: " + ", and ".join(
            f"without {words} it rotates with the swirl at every N (lowest: {lowest})"
            for _, words, lowest in cases) + ".")
    return " ".join(statement(
        part, f"Without {words} the cluster rotates with the swirl at every N (lowest: {lowest}).",
        f"Counterrotation does not need {words}: without it there is {lowest}.",
        f"Whether counterrotation needs {words} is undecided: without it the lowest is {lowest}.")
        for part, words, lowest in cases)


def found_pinned(folder):
    moves, _ = claims.pinned_reach_wall(folder)
    rolls, _ = claims.slip_rises(folder)
    speeds = claims.ends(claims.pinned_means(folder, "3b", "normalised"), "mean")
    slips = claims.ends(folder.curve("4a", setting="high"), "slip_resident")
    told = f"angular velocity over the wall's, {speeds}; slip parameter, {slips}"
    if moves.verdict == rolls.verdict == claims.HOLDS:
        return ("With more discs those pinned at the wall come to move with it, and hardly slip on it any "
                f"more ({told}).")
    said = {claims.HOLDS: "is confirmed", claims.UNDECIDED: "is undecided",
            claims.IN_PART: "is confirmed in part"}
    return ("That with more discs those pinned at the wall come to move with it "
            f"{said.get(moves.verdict, 'is not confirmed')}, that they hardly slip on it any more "
            f"{said.get(rolls.verdict, 'is not confirmed')} ({told}).")


def found_condensation(folder):
    """No claim of the paper's: what comes after the gas."""
    every_row = folder.table("condensation")
    rows = [row for row in every_row if row["condensed"]]
    if not rows:
        return ""
    times = ", ".join(f"{claims.number(claims.value(row, 'waiting'))} periods at N = {row['discs']:.0f}"
                      for row in rows)
    late = [f"{row['seeds'] - row['condensed']:.0f} of {row['seeds']:.0f} at N = {row['discs']:.0f}"
            for row in every_row if row["condensed"] < row["seeds"]]
    after = [claims.value(row, "after_by_time") for row in rows]
    return ("Without friction between the discs the cluster is a gas at first and then condenses into a crystal that "
            f"turns with the swirl (ϖ/Ω = {min(v.mean for v in after):.3f} to {max(v.mean for v in after):.3f}): "
            f"after {times}." + (f" Runs that did not condense: {', '.join(late)}." if late else ""))


def inertia_of_discs(folder):
    """Where frustration is blamed: the paper's discs have none of the rolling, and what decides."""
    sentence = claims.inertia_sentence(folder)
    return f" Discs do not roll; where they change their direction depends on their inertia{sentence}." if sentence else ""


def found_spheres(folder):
    turn, _ = claims.spheres_transition(folder)
    blame, _ = claims.spheres_frustration(folder)
    discs = claims.DENSE_SPHERES[-1]
    numbers = ", ".join(
        f"{claims.number(claims.spheres_at(folder, 'spheres_ingredients', curve, discs))} {words}"
        for curve, words in ((f"{claims.PLASTIC:g}", "with it"), ("no-vertical", "without")))
    numbers = f"(ϖ/Ω at N = {discs}, μ = {claims.PLASTIC:g}: {numbers})"
    what = "friction of the contacts along the vertical, which opposes their rolling,"
    cause = statement(blame, f"{what} drives them that way", f"{what} does not drive them that way",
                      f"whether {what} drives them that way is undecided")
    try:
        changes = claims.last_changes(folder)
    except FileNotFoundError:
        changes = {}
    changes = ", ".join(f"{at.words} (μ = {mu:g})" for mu, at in sorted(changes.items()))
    where = f" Their sense changes for the last time at these N: {changes}." if changes else ""
    return statement(
        turn, f"Spheres that roll on a floor counterrotate, too, when they are many; {cause} {numbers}.{where}"
        f"{inertia_of_discs(folder)}",
        f"That many spheres that roll on a floor counterrotate is not confirmed {numbers}.{where}",
        f"Whether many spheres that roll on a floor counterrotate is undecided {numbers}.{where}")


def what_was_found(path):
    """The main results as sentences: each is chosen by the verdict on its claim, and says the numbers of
    the tables. Without its tables a sentence is missing."""
    sentences = []
    for say in (found_transition, found_order, found_both_needed, found_condensation, found_pinned,
                found_spheres):
        try:
            sentences.append(say(claims.Folder(path)))
        except (FileNotFoundError, IndexError, KeyError, ValueError, ZeroDivisionError):
            continue
    return [sentence for sentence in sentences if sentence]


# The same discs in several figures, whose N_c the report has more than once: (figure, curve, how).
SAME_SETTING = {
    1.0: (("5b", "high", "by event"), ("5b-steady", "high", "after a long warm-up"),
          ("1b", "high", "by time, the runs of 5b"), ("friction", None, "by time, searched for"),
          ("restitution", "1", "by time, shorter runs, fewer seeds and N"),
          ("inertia", "10", "the runs of restitution")),
    0.5: (("5b", "medium", "by event"), ("5b-steady", "medium", "after a long warm-up"),
          ("friction", None, "by time, searched for")),
}


def crossing_of(folder, figure, curve, mu):
    """N_c of a figure's curve, and its words; None if it has none."""
    if curve is None:
        row = claims.tables.select(folder.table(figure), mu=mu)[0]
        return (claims.crossing_value(row), claims.crossing_words(row)) if row["crosses"] else None
    found = folder.crossing(figure, curve)
    return (found.at, found.words) if found.verdict == "crosses" else None


def crossings_of_one_setting(path):
    """N_c wherever the report has it more than once, and whether the values agree."""
    folder, sentences = claims.Folder(path), []
    for mu, places in SAME_SETTING.items():
        found = []
        for figure, curve, how in places:
            try:
                at = crossing_of(folder, figure, curve, mu)
            except (FileNotFoundError, IndexError, KeyError):
                continue
            if at:
                found.append((figure, *at, how))
        if len(found) < 2:
            continue
        first = found[0][1]
        apart = max(abs(at.mean - first.mean) / max((at - first).error, 1e-9) for _, at, _, _ in found[1:])
        listed = "; ".join(f"{words} (figure {figure}, {how})" for figure, _, words, how in found)
        sentences.append(f"N_c for both frictions {mu:g} is estimated more than once: {listed}. The first is "
                         f"the one to quote; the others differ from it by at most {apart:.1f} standard errors.")
    return " ".join(sentences)


def split(figures):
    """Those of the paper, of its experiment's spheres, and those that are new: with a heading
    each, if there are any."""
    groups = [("The paper’s figures", []), ("Spheres that roll", []), ("What is new", [])]
    for figure in figures:
        about = figure["description"]
        groups[2 if about.startswith("beyond the paper") else
               1 if about.startswith("spheres that roll") else 0][1].append(figure)
    return [(heading, members) for heading, members in groups if members]


PART_OF_THE_STUDY = re.compile(r"^(?:beyond the paper|spheres that roll(?:, beside them)?): ")


def title_of(figure):
    text, name = PART_OF_THE_STUDY.sub("", figure["description"]), figure["name"]
    if name[0].isdigit() and not text.startswith("Figure"):
        return f"Figure {name}: {text}"
    return text[0].upper() + text[1:]


def question_of(figure):
    return QUESTIONS.get(figure["name"], "")


def caption_of(figure):
    return CAPTIONS.get(figure["name"], "")


# What `swirl paper` calls its points and runs, in words.
CURVES = {"high": "μ = 1", "medium": "μ = 0.5", "low": "μ = 0.1", "no-wall": "μ_w = 0",
          "no-disc": "μ_d = 0", "no-vertical": "no vertical friction",
          "no-vertical-disc": "no vertical friction between spheres",
          "no-vertical-wall": "no vertical friction at the wall", "no-damping": "e = 1",
          "shell": "hollow spheres"}
POINT = re.compile(r"\b(?:(?:run|measured|spheres|settled|steady|dense|varied)_)*"
                   r"((?:(?:inertia|restitution|tangential)_|e)?[\d.]+|(?:no-)?[a-z][a-z-]*(?:_f[\d.]+)?)"
                   r"_N(\d+)(?:_\d+of\d+periods|_\d+events|_\d+periods)?(?:_seed(\d+))?\b")
FRICTIONS = re.compile(r"\bmap_d([\d.]+)_w([\d.]+)_(?:\d+of\d+periods|\d+events|\d+periods)\b")
VARIED = re.compile(r"(inertia|restitution|tangential|e)_?(?=[\d.])")
SYMBOLS = {"inertia": "I", "restitution": "e", "e": "e", "tangential": "β", "tangential_restitution": "β"}
PARAMETER = re.compile(rf"^({'|'.join(SYMBOLS)}) (?=[\d.])")


POWER_OF_TEN = re.compile(r"\b10\^(\d+)")
POWER = re.compile(r"(?<![\w.])(\d+(?:\.\d+)?)e([+-]?)0*(\d+)\b")
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def powers(text):
    """2e-09 as 2·10⁻⁹, 1e-11 as 10⁻¹¹, and 10^6 as 10⁶."""
    def power(match):
        digits, sign, exponent = match.groups()
        ten = "10" + (sign.replace("+", "") + exponent).translate(SUPERSCRIPTS)
        return ten if digits == "1" else f"{digits}·{ten}"
    text = POWER_OF_TEN.sub(lambda match: "10" + match.group(1).translate(SUPERSCRIPTS), text)
    return POWER.sub(power, text)


def in_words(finding):
    """A finding without the names that only the program gives its points."""
    def point(match):
        curve, discs, seed = match.groups()
        rough = ", μ = 0.3" if curve.endswith("-rough") else ""
        curve = curve.removesuffix("-rough")
        curve = CURVES.get(curve) or (f"μ = {curve}" if curve[0].isdigit() else
                                      VARIED.sub(lambda m: f"{SYMBOLS[m.group(1)]} = ", curve, count=1)
                                      if VARIED.match(curve) else
                                      curve.replace("_f", ", μ_f = ").replace("-", " "))
        curve += rough
        return f"{curve} with N = {discs}" + (f" (seed {seed})" if seed else "")
    finding = re.sub(r"^Figure \S+: (drawn; )?", "", finding)
    finding = FRICTIONS.sub(r"(μ_d, μ_w) = (\1, \2)", finding)
    finding = re.sub(r" Another --seed than \d+ may not meet it\.|; docs/physics\.md", "", finding)
    finding = PARAMETER.sub(lambda match: f"{SYMBOLS[match.group(1)]} = ", POINT.sub(point, finding))
    return powers(finding)


# What is said of the runs, not of what they show.
REMARK = re.compile(r"(Not shown to be steady|At \d+ of \d+ points the seeds|\d+ of them have fewer|"
                    r"\d+ runs? failed|Figure \S+: )")


class Said(dict):
    """Findings by the figure that has them first: what stands below one is not said again below the
    next."""

    def of(self, figure):
        """(findings, remarks on the runs, name of an earlier figure that has more of them)"""
        new = [f for f in figure["findings"] if self.setdefault(f, figure["name"]) == figure["name"]]
        earlier = [self[f] for f in figure["findings"] if self[f] != figure["name"]]
        words = [sentence(in_words(f)) for f in new]
        return ([w for f, w in zip(new, words) if not REMARK.match(f)],
                [w for f, w in zip(new, words) if REMARK.match(f)], earlier[0] if earlier else "")


def name_of(earlier, figures):
    figure = next(f for f in figures if f["name"] == earlier)
    return f"Figure {earlier}" if earlier[0].isdigit() else f"“{title_of(figure)}”"


def figure_texts(about):
    """name: (caption, findings, remarks) of each figure, in the order of the page."""
    said, texts = Said(), {}
    for _, figures in split(about["figures"]):
        for figure in figures:
            findings, remarks, earlier = said.of(figure)
            if earlier:
                remarks.append(f"More on its runs: {name_of(earlier, about['figures'])}.")
            texts[figure["name"]] = (caption_of(figure), findings, remarks)
    return texts


def sentence(text):
    # Not ϖ, whose capital is Π, nor the e of "e = 1".
    return text[:1].upper() + text[1:] if text[:1].isascii() and text[1:2] != " " else text


def picture_of(figure, endings=(".png",)):
    """The first file of these kinds, the best kind first."""
    return next((f for ending in endings for f in figure["files"] if f.endswith(ending)), None)


# --- Markdown ---------------------------------------------------------------------------------

def cell(text):
    return str(text).replace("|", "\\|").replace("\n", " ")


def markdown(about, judged, same="", found=()):
    lines = [f"# {TITLE}", "", "**Asked.** " + intro(), ""]
    if found:
        lines += ["**Found.**", ""] + [f"- {text}" for text in found] + [""]
    lines += [f"**{counts(judged)}** {how_to_read(about)}", ""]
    if same:
        lines += [same, ""]
    for heading, which in in_short(judged):
        lines += [f"{heading}:", ""] + [f"- {says}" + (f" — {why}" if why else "")
                                          for says, why in which] + [""]
    lines += ["## Claim by claim", "", "| # | the paper says | found | verdict | command |", "|---|---|---|---|---|"]
    for k, (claim, verdict, found) in enumerate(judged, 1):
        command = f"`{claim.command}`" if claim.command else ""
        lines.append(f"| {k} | {cell(claim.says)} ({claim.where}) | {cell(found)} | "
                     f"{MARK[verdict]} {verdict} | {command} |")
    texts = figure_texts(about)
    for heading, figures in split(about["figures"]):
        lines += ["", f"## {heading}"]
        for figure in figures:
            lines += ["", f"### {title_of(figure)}", ""]
            if picture_of(figure):
                lines += [f"![{title_of(figure)}]({picture_of(figure)})", ""]
            if question_of(figure):
                lines += [f"*{question_of(figure)}*", ""]
            caption, findings, remarks = texts[figure["name"]]
            lines += [caption, ""] if caption else []
            lines += [f"- {finding}" for finding in findings]
            lines += ["", *remarks] if remarks else []
            lines += ["", f"`swirl paper --figure {figure['name']}`"]
    lines += ["", "## Where the paper contradicts itself, and what was assumed", "",
              "| matter | the paper | here |", "|---|---|---|"]
    lines += [f"| {cell(a)} | {cell(b)} | {cell(c)} |" for a, b, c in CONTRADICTIONS]
    lines += ["", "## Parameters, versions, time", "", "| | |", "|---|---|"]
    lines += [f"| {cell(a)} | {cell(b)} |" for a, b in parameter_rows(about)]
    return "\n".join(lines) + "\n"


# --- HTML -------------------------------------------------------------------------------------

def inline(path):
    kind = "svg+xml" if path.endswith(".svg") else "png"
    with open(path, "rb") as file:
        return f"data:image/{kind};base64," + base64.b64encode(file.read()).decode()


def table(head, rows, kind=""):
    top = "".join(f"<th>{html.escape(h)}</th>" for h in head)
    body = "".join("<tr>" + "".join(row) + "</tr>\n" for row in rows)
    return f"<table class='{kind}'><thead><tr>{top}</tr></thead><tbody>\n{body}</tbody></table>\n"


def td(text, kind=""):
    kind = f' class="{kind}"' if kind else ""
    return f"<td{kind}>{rich(text)}</td>"


SUBSCRIPT = re.compile(r"\b([NPRVϖμγ])_(container|cluster|ball|wall|[A-Za-z])\b")


# What no line should end in the middle of: N = 48, 0.5 ± 0.1.
LETTER_IS = re.compile(r"(?<![\w/])([^\W\d](?:_\w+)?) = (?=[\d−])")


def rich(text):
    """Escaped, with N_c and its like as they are printed."""
    text = LETTER_IS.sub("\\1\u00a0=\u00a0", html.escape(str(text))).replace(" ± ", "\u00a0±\u00a0")
    return SUBSCRIPT.sub(r"\1<sub>\2</sub>", text)


# A picture that is made for the width of the page, with its letters as they are, is wider than this, in
# pixels: figures of one column have 1012 of them (style.COLUMN). So is one that is very flat.
ONE_COLUMN = 1200
FLAT = 2.0


def size_of(path):
    """Of a PNG, whose width and height are the first things in it."""
    with open(path, "rb") as file:
        return struct.unpack(">16xII", file.read(24))


def is_wide(path):
    width, height = size_of(path)
    return width > ONE_COLUMN or width > FLAT * height


# The height of a line of a caption, and how many letters it has, for a column that is 1 wide.
LINE, LETTERS = 0.045, 62


def heights(folder, figure, texts):
    """Of the picture and of the text below it, where a column is 1 wide: about."""
    picture = picture_of(figure)
    width, height = size_of(os.path.join(folder, picture)) if picture else (1, 0)
    caption, findings, remarks = texts[figure["name"]]
    blocks = [question_of(figure), caption, *findings, *remarks]
    return height / width, LINE * (3 + sum(-(-len(block) // LETTERS) for block in blocks))


LONGEST = 12  # figures that are arranged at once
BACK = 0.3  # what it costs that a figure begins above the one before it


def in_columns(sizes):
    """Which of two columns each figure stands in, and what that leaves empty: as even as can be, without
    much jumping back. `sizes` are the heights of figures with their texts."""
    best = None
    for choice in range(1 << max(len(sizes) - 1, 0)):
        ends, begin, cost, sides = [0.0, 0.0], 0.0, 0.0, []
        for k, size in enumerate(sizes):
            side = choice >> (k - 1) & 1 if k else 0
            # Of two that end alike, the left one.
            cost += BACK * max(begin - ends[side], 0.0) + (1e-6 if side and ends[0] == ends[1] else 0)
            begin = ends[side]
            ends[side] += size
            sides.append(side)
        cost += abs(ends[0] - ends[1])
        if best is None or cost < best[0]:
            best = (cost, sides)
    return best


def arranged(sizes):
    """Of each figure, made for a column, the column (0 or 1) or None, which is across the page with its
    text at its side: the first, the last, or both, where that leaves less empty. `sizes` are heights of pictures
    and of texts."""
    if not sizes:
        return []
    if len(sizes) > LONGEST:
        return arranged(sizes[:LONGEST]) + arranged(sizes[LONGEST:])
    whole = [picture + text for picture, text in sizes]
    cost, sides = in_columns(whole)
    for first, last in ((1, 0), (0, 1), (1, 1)):
        if first + last > len(sizes):
            continue
        inner = range(first, len(sizes) - last)
        less, others = in_columns([whole[k] for k in inner])
        less += sum(abs(picture - text) for k, (picture, text) in enumerate(sizes)
                    if k not in inner)
        if less < cost:
            cost, sides = less, [None] * first + others + [None] * last
    return sides


def figures_html(folder, figures, texts):
    """A part of the page: pictures as wide as the page across it, others in two columns."""
    parts, row = [], []

    def end_of_row():
        columns = [[], []]

        def end_of_columns():
            if columns[0]:
                parts.extend("<div>\n" + "".join(column) + "</div>\n" for column in columns)
            columns[:] = [[], []]
        for figure, side in zip(row, arranged([heights(folder, f, texts) for f in row])):
            if side is None:
                end_of_columns()
                parts.append(figure_html(folder, figure, "wide beside", texts))
            else:
                columns[side].append(figure_html(folder, figure, "", texts))
        end_of_columns()
        row.clear()

    for figure in figures:
        picture = picture_of(figure)
        if picture is None or is_wide(os.path.join(folder, picture)):
            end_of_row()
            parts.append(figure_html(folder, figure, "wide", texts))
        else:
            row.append(figure)
    end_of_row()
    return grid(parts)


def figure_html(folder, figure, kind, texts):
    title = rich(title_of(figure))
    picture = picture_of(figure, (".svg", ".png"))
    kind = "" if not kind else f' class="{kind}"' if " " in kind else f" class={kind}"
    image = (f'<img alt="{html.escape(title_of(figure))}" '
             f'src="{inline(os.path.join(folder, picture))}">' if picture else "")
    caption, findings, remarks = texts[figure["name"]]
    question = (f"<p class=question>{rich(question_of(figure))}</p>" if question_of(figure)
                else "")
    caption = f"<p>{rich(caption)}</p>" if caption else ""
    found = "".join(f"<li>{rich(finding)}</li>" for finding in findings)
    runs = f"<p class=small>{rich(' '.join(remarks))}</p>" if remarks else ""
    return (f"<figure{kind}>{image}<figcaption><h3>{title}</h3>{question}{caption}"
            f"{'<ul>' + found + '</ul>' if found else ''}{runs}"
            f"<code>swirl paper --figure {html.escape(figure['name'])}</code></figcaption>"
            "</figure>\n")


def grid(figures):
    """Two beside each other, and wide ones across."""
    return "<div class=figures>\n" + "".join(figures) + "</div>\n"


def page(folder, about, judged):
    rows = [(td(k), f"<td>{rich(claim.says)} <span class=small>({html.escape(claim.where)})"
             "</span></td>", td(found),
             f"<td><span class='verdict {CLASS.get(verdict, 'other')}'>{MARK[verdict]} {verdict}</span>"
             + (f"<br><code>{html.escape(claim.command)}</code>" if claim.command else "") + "</td>")
            for k, (claim, verdict, found) in enumerate(judged, 1)]
    parts = [opening(TITLE), f"<h1>{TITLE}</h1>\n",
             "<p class=small>The claims of a paper, one by one, against a simulation</p>\n",
             f"<p><b>Asked.</b> {rich(intro())}</p>\n"]
    answer = what_was_found(folder)
    if answer:
        items = "".join(f"<li>{rich(text)}</li>" for text in answer)
        parts += [f"<p><b>Found.</b></p><ul>{items}</ul>\n"]
    parts += [f"<p><b>{html.escape(counts(judged))}</b></p>\n",
              f"<p class=small>{rich(how_to_read(about))} {rich(crossings_of_one_setting(folder))}"
              "</p>\n"]
    for heading, which in in_short(judged):
        items = "".join(f"<li>{rich(says)} <span class=small>{rich(found)}</span></li>"
                        for says, found in which)
        parts += [f"<p class=heading>{heading}:</p><ul>{items}</ul>\n"]
    parts += ["<h2>Claim by claim</h2>\n",
             table(["", "the paper says", "found", "verdict, and how to see it"], rows, "claims")]
    texts = figure_texts(about)
    for heading, figures in split(about["figures"]):
        parts += [f"<h2>{heading}</h2>\n", figures_html(folder, figures, texts)]
    parts += ["<h2>Where the paper contradicts itself, and what was assumed</h2>\n",
              table(["matter", "the paper", "here"],
                    [(td(a), td(b), td(c)) for a, b, c in CONTRADICTIONS]),
              "<h2>Parameters, versions, time</h2>\n",
              table(["", ""], [(td(a), td(b)) for a, b in parameter_rows(about)]),
              "</body></html>\n"]
    return "".join(parts)


def write(path, text):
    try:
        atomic_file.write(path, text)
    except OSError as error:
        sys.exit(f"'{path}' could not be written: {error.strerror}.")


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
    write(os.path.join(folder, "report.md"), markdown(
        about, judged, crossings_of_one_setting(folder), what_was_found(folder)))
    write(os.path.join(folder, "report.html"), page(folder, about, judged))


if __name__ == "__main__":
    main()
