"""The main results on the first page of the report. Each sentence is chosen by the judgement on its claim, and
its numbers come from the tables."""

import math

import tables
from claims import contacts, profiles, rotation, spheres
from claims.study import Study, crossing_sentence, crossing_value, crossing_words
from claims.thresholds import DENSE_SPHERES, PLASTIC
from claims.wording import ends, known, number, value_at
from verdicts import HOLDS, IN_PART, UNDECIDED, measured

NO_TABLE = (FileNotFoundError, IndexError, KeyError)


def statement(judgement, holds, fails, undecided):
    """The sentence for this judgement."""
    if judgement.verdict == IN_PART:
        return fails.replace("is not confirmed", "is confirmed only in part")
    return {HOLDS: holds, UNDECIDED: undecided}.get(judgement.verdict, fails)


def rotation_at(row):
    return f"ϖ/Ω = {value_at(row, 'by_event')}"


def lowest_of(study, setting):
    return rotation_at(min(known(study.curve("5b", last=math.inf, setting=setting), "by_event"),
                           key=lambda row: row["by_event"]))


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
    judgement, _ = rotation.transition(study)
    rows = known(study.curve("5b", setting="high"), "by_event")
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


def pinned_found(study):
    moves, _ = profiles.pinned_reach_wall(study)
    rolls, _ = contacts.slip_rises(study)
    speeds = ends(profiles.pinned_means(study, "3b", "normalised"), "mean")
    slips = ends(study.curve("4a", setting="high"), "slip_resident")
    text = f"angular velocity relative to that of the wall: {speeds}; slip parameter: {slips}"
    if moves.verdict == rolls.verdict == HOLDS:
        return f"With more discs, the pinned discs approach the motion of the wall and hardly slip on it ({text})."
    words = {HOLDS: "is confirmed", UNDECIDED: "is undecided", IN_PART: "is confirmed in part"}
    return ("The claim that with more discs the pinned discs approach the motion of the wall "
            f"{words.get(moves.verdict, 'is not confirmed')}. The claim that they hardly slip on it "
            f"{words.get(rolls.verdict, 'is not confirmed')} ({text}).")


def condensation_found(study):
    """Not a claim of the paper: what follows the gas."""
    every_row = study.table("condensation")
    rows = [row for row in every_row if row["condensed"]]
    if not rows:
        return ""
    times = ", ".join(f"{number(measured(row, 'waiting'))} periods at N = {row['discs']:.0f}" for row in rows)
    late = [f"{row['seeds'] - row['condensed']:.0f} of {row['seeds']:.0f} at N = {row['discs']:.0f}"
            for row in every_row if row["condensed"] < row["seeds"]]
    after = [row["after_by_time"] for row in rows]
    return ("Without friction between the discs the cluster is a gas at first and then condenses into a crystal that "
            f"rotates with the swirl (ϖ/Ω = {min(after):.3f} to {max(after):.3f}): after {times}." +
            (f" Runs that did not condense: {', '.join(late)}." if late else ""))


def spheres_found(study):
    transition, _ = spheres.spheres_transition(study)
    frustration, _ = spheres.spheres_frustration(study)
    discs = DENSE_SPHERES[-1]
    numbers = ", ".join(f"{number(spheres.spheres_at(study, 'spheres_ingredients', curve, discs))} {words}"
                        for curve, words in ((f"{PLASTIC:g}", "with it"), ("no-vertical", "without")))
    numbers = f"(ϖ/Ω at N = {discs}, μ = {PLASTIC:g}: {numbers})"
    force = "vertical friction of the contacts, which opposes their rolling,"
    cause = statement(frustration, f"{force} causes this", f"{force} does not cause this",
                      f"whether {force} causes this is undecided")
    try:
        changes = ", ".join(f"{at.words} (μ = {mu:g})" for mu, at in sorted(spheres.last_changes(study).items()))
    except FileNotFoundError:
        changes = ""
    where = f" Their direction changes for the last time at these N: {changes}." if changes else ""
    # The paper's discs do not roll, so that frustration is not the same for them.
    inertia = spheres.inertia_sentence(study)
    inertia = (f" Discs do not roll; where they change their direction depends on their inertia{inertia}."
               if inertia else "")
    return statement(
        transition, f"Many spheres that roll on a floor also counterrotate; {cause} {numbers}.{where}{inertia}",
        f"That many spheres that roll on a floor counterrotate is not confirmed {numbers}.{where}",
        f"Whether many spheres that roll on a floor counterrotate is undecided {numbers}.{where}")


def main_results(path):
    """Sentences; one whose tables do not exist is left out."""
    sentences = []
    for find in (transition_found, order_found, both_frictions_found, condensation_found, pinned_found,
                 spheres_found):
        try:
            sentences.append(find(Study(path)))
        except (*NO_TABLE, ValueError, ZeroDivisionError):
            continue
    return [sentence for sentence in sentences if sentence]


# Figures with the same discs, so that the report has their N_c more than once: (figure, curve, how).
SAME_SETTING = {
    1.0: (("5b", "high", "by event"), ("5b-steady", "high", "after a long warm-up"),
          ("1b", "high", "by time, the runs of 5b"), ("friction", None, "by time, by a search"),
          ("restitution", "1", "by time, shorter runs, fewer seeds and N"),
          ("inertia", "10", "the runs of restitution")),
    0.5: (("5b", "medium", "by event"), ("5b-steady", "medium", "after a long warm-up"),
          ("friction", None, "by time, by a search")),
}


def crossing_of(study, figure, curve, mu):
    """N_c of a figure's curve, and its words; None if it does not cross."""
    if curve is None:
        row = tables.select(study.table(figure), mu=mu)[0]
        return (crossing_value(row), crossing_words(row)) if row["crosses"] else None
    found = study.crossing(figure, curve)
    return (found.at, found.words) if found.verdict == "crosses" else None


def crossings_of_one_setting(path):
    """N_c wherever the report has it more than once, and whether the values agree."""
    study, sentences = Study(path), []
    for mu, estimates in SAME_SETTING.items():
        found = []
        for figure, curve, how in estimates:
            try:
                at = crossing_of(study, figure, curve, mu)
            except NO_TABLE:
                continue
            if at:
                found.append((figure, *at, how))
        if len(found) < 2:
            continue
        first = found[0][1]
        apart = max(abs(at.mean - first.mean) / max((at - first).error, 1e-9) for _, at, _, _ in found[1:])
        listed = "; ".join(f"{words} (figure {figure}, {how})" for figure, _, words, how in found)
        sentences.append(f"N_c for both friction coefficients {mu:g} is estimated more than once: {listed}. Use the "
                         f"first; the others differ from it by at most {apart:.1f} standard errors.")
    return " ".join(sentences)
