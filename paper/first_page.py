"""The main results on the first page of the report. Each sentence is chosen by the judgement on its claim, and
its numbers come from the tables."""

import math

from claims import contacts, rotation, spheres
from claims.settings import SPHERES, WORDS
from claims.study import Study, crossing_sentence
from claims.wording import ends, known, number, value_at
from paper_parameters import ROUGH_CHANGE_N, SMOOTH_CHANGE_N
from verdicts import HOLDS, IN_PART, UNDECIDED, measured

MOST = 6  # results
ANSWERS = {HOLDS: "is confirmed", UNDECIDED: "is undecided", IN_PART: "is confirmed in part"}
NO_TABLE = (FileNotFoundError, IndexError, KeyError)


def statement(judgement, holds, fails, undecided):
    """The sentence for this judgement."""
    if judgement.verdict == IN_PART:
        return fails.replace("is not confirmed", "is confirmed only in part")
    return {HOLDS: holds, UNDECIDED: undecided}.get(judgement.verdict, fails)


def rotation_at(row):
    return f"ϖ/Ω = {value_at(row, 'mean_by_event')}"


def lowest_of(study, setting):
    return rotation_at(min(known(study.curve("5b", last=math.inf, setting=setting), "mean_by_event"),
                           key=lambda row: row["mean_by_event"]))


def change_of(crossing):
    """The change of the direction of rotation along a curve, as part of a sentence."""
    if crossing.verdict == "crosses":
        return f"at {crossing_sentence(crossing.words)}"
    low = f"ϖ/Ω is lowest at N = {crossing.lowest_discs:.0f}, {number(crossing.lowest)}"
    if crossing.verdict == "always rotates":
        return f"at no N ({low})"
    if crossing.verdict == "always counterrotates":
        return f"at no N, as all counterrotate ({low})"
    return f"at no N for certain ({low})"


def transition_found(study):
    judgement, _ = rotation.transition(study, "high")
    rows = known(study.curve("5b", setting="high"), "mean_by_event")
    values = f"{rotation_at(rows[0])}, {rotation_at(rows[-1])}"
    change = change_of(study.crossing("5b", "high"))
    claim = ("with friction at the wall and between the discs (μ = 1) few discs rotate with the swirl and many "
             "against it")
    return statement(
        judgement,
        "With friction at the wall and between the discs (μ = 1), few discs rotate with the swirl and many against "
        f"it ({values}); the direction changes {change}.",
        f"The claim that {claim} is not confirmed: {values}; the direction changes {change}.",
        f"Whether {claim} is undecided: {values}; the direction changes {change}.")


def order_found(study):
    judgement, _ = rotation.friction_order(study)
    changes = ", ".join(f"with μ = {mu} {change_of(study.crossing('5b', name))}"
                        for mu, name in (("0.5", "medium"), ("0.1", "low")))
    return statement(
        judgement, f"With less friction the direction changes at higher N: {changes}.",
        f"Less friction does not always move the change to larger N: {changes}.",
        f"It is undecided whether less friction always moves the change to larger N: {changes}.")


def both_frictions_found(study):
    """Without either friction there is no counterrotation."""
    cases = [(rotation.never_crosses(setting)(study)[0], words, lowest_of(study, setting))
             for setting, words in (("no-wall", "friction at the wall"), ("no-disc", "friction between the discs"))]
    if all(judgement.verdict == HOLDS for judgement, _, _ in cases):
        return ("The cluster counterrotates only with both: " + ", and ".join(
            f"without {words} it rotates with the swirl at every N (lowest: {lowest})"
            for _, words, lowest in cases) + ".")
    return " ".join(statement(
        judgement, f"Without {words} the cluster rotates with the swirl at every N (lowest: {lowest}).",
        f"Counterrotation does not need {words}: without it there is {lowest}.",
        f"Whether counterrotation needs {words} is undecided: without it the lowest is {lowest}.")
        for judgement, words, lowest in cases)


def condensation_found(study):
    """Not a claim of the paper: what follows the gas."""
    every_row = study.table("condensation")
    rows = [row for row in every_row if row["condensed"]]
    if not rows:
        return ""
    times = ", ".join(f"{number(measured(row, 'waiting'))} periods at N = {row['discs']:.0f}" for row in rows)
    late = [f"{row['seeds'] - row['condensed']:.0f} of {row['seeds']:.0f} at N = {row['discs']:.0f}"
            for row in every_row if row["condensed"] < row["seeds"]]
    after = [row["after_mean_by_time"] for row in rows]
    return ("Without friction between the discs the cluster is a gas at first and then condenses into a crystal that "
            f"rotates with the swirl (ϖ/Ω = {min(after):.3f} to {max(after):.3f}): after {times}." +
            (f" Runs that did not condense: {', '.join(late)}." if late else ""))


def experiment_found(study):
    """What spheres at the amplitude of the experiment do, next to the numbers of the paper."""
    judgement, _ = rotation.transition(study, "smooth")
    known_changes = []
    for setting in SPHERES:
        try:
            known_changes.append(f"that of {WORDS[setting]} {change_of(study.crossing('spheres', setting))}")
        except NO_TABLE:
            continue
    changes = (f"their direction changes: {'; '.join(known_changes)} (paper: {SMOOTH_CHANGE_N} for smooth, "
               f"{ROUGH_CHANGE_N} for roughened spheres; each friction coefficient is fitted to it)")
    few_many = "few spheres that roll on a floor rotate with the swirl and many against it, as in the experiment"
    return statement(judgement, f"{few_many[0].upper()}{few_many[1:]}; {changes}.",
                     f"That {few_many}, is not confirmed; {changes}.",
                     f"Whether {few_many}, is undecided; {changes}.")


def predictions_found(study):
    """No parameter is fitted to these, but restitution, floor friction and amplitude are assumed."""
    slip, _ = contacts.slip_rises(study, "smooth")
    spin, _ = contacts.wall_spin(study, "smooth")
    slips = ends(study.curve("4a", setting="smooth"), "slip_resident")
    spins = ends(study.curve("4b", setting="smooth"), "resident_spin")
    return (f"With the assumed restitution and floor friction: that the slip parameter of pinned spheres rises from about 0.5 to nearly 1 "
            f"{ANSWERS.get(slip.verdict, 'is not confirmed')} ({slips}); that their spin at the wall falls "
            f"{ANSWERS.get(spin.verdict, 'is not confirmed')} ({spins}, in Ω).")


def frustration_found(study):
    """The title of the paper, judged by the figure that stops the spins."""
    title, _ = spheres.frustration(study)
    parts = []
    for body in ("discs", "spheres"):
        induces, _ = spheres.stopped_spins(study, body)
        free, stopped = (value_at(study.curve("cause", body=body, spins=spins, contacts="none between particles")[-1],
                                  "mean_by_time") for spins in ("free", "stopped"))
        parts.append(f"for {body} {ANSWERS.get(induces.verdict, 'is not confirmed')} (ϖ/Ω {free} if they can spin, {stopped} "
                     "if they cannot)")
    claim = "geometric frustration induces counterrotation"
    words = (f"That stopped spins induce it without friction between particles {' and '.join(parts)}. That neighbours stop "
             "them as frustrated gears is a claim of its own (figure 4b).")
    return statement(title, f"The title holds: {claim}. {words}", f"The title, {claim}, is not confirmed. {words}",
                     f"Whether {claim} is undecided. {words}")


def main_results(path):
    """Sentences; one whose tables do not exist is left out."""
    sentences = []
    study = Study(path)
    for find in (transition_found, order_found, both_frictions_found, experiment_found, predictions_found,
                 frustration_found, condensation_found):
        try:
            sentences.append(find(study))
        except (*NO_TABLE, ValueError, ZeroDivisionError):
            continue
    return [sentence for sentence in sentences if sentence][:MOST]
