"""The main results on the first page of the report. Each sentence is chosen by the judgement on its
claim, as in the table of claims: without the points that the claim needs, or with shortened runs,
it is undecided. Its numbers come from the tables."""

from paper.claims import claim_stating, rotation, spheres
from paper.claims.settings import SPHERES, WORDS, capital
from paper.claims.study import Study, crossing_sentence
from paper.claims.thresholds import LEAST_ROTATION
from paper.claims.wording import ends, known, number, value_at
from paper.paper_parameters import ROUGH_CHANGE_N, SMOOTH_CHANGE_N
from paper.verdicts import (
    FAILS,
    HOLDS,
    IN_PART,
    MISSING,
    UNDECIDED,
    Judgement,
    above,
    combined,
    every,
    measured,
)

MOST = 6  # results
ANSWERS = {HOLDS: "is confirmed", UNDECIDED: "is undecided", IN_PART: "is confirmed in part"}
NO_TABLE = (FileNotFoundError, IndexError, KeyError)

# The claims that choose the sentences.
TRANSITION = claim_stating(
    "With friction at the wall and between the discs the cluster rotates with the swirl at low N "
    "and counterrotates at high N."
)
ORDER = claim_stating(
    "The lower the friction, the higher the N at which the direction of rotation changes."
)
NO_WALL = claim_stating("Without wall friction there is never a transition.")
NO_DISC = claim_stating("Without disc friction there is never a transition.")
EXPERIMENT = claim_stating("Few particles rotate with the swirl, many counterrotate.")
SLIP = claim_stating(
    "The slip parameter of the pinned particles rises with N, from approximately 0.5 at N = 25 to "
    "nearly 1."
)
SPIN = claim_stating("The spin of the particles along the wall in the pinned region falls with N.")
TITLE = claim_stating("Geometric frustration induces counterrotation.")
GAS = claim_stating(
    "Without disc friction the cluster is loose and gas-like: in the paper's 10^6 events, from the "
    "start until it condenses."
)
GAS_AFTER = claim_stating(
    "Without disc friction the cluster is loose and gas-like: in the steady state, after that."
)


def judged(claim, study):
    """The judgement of the table of claims. IndexError if its tables do not exist, or hold too few
    runs."""
    judgement, _ = claim.judged(study)
    if judgement.verdict == MISSING:
        raise IndexError(claim.statement)
    return judgement


def statement(judgement, holds, fails, undecided):
    """The sentence for this judgement."""
    if judgement.verdict == IN_PART:
        return fails.replace("is not confirmed", "is confirmed only in part")
    return {HOLDS: holds, UNDECIDED: undecided}.get(judgement.verdict, fails)


def rotation_at(row):
    return f"ϖ/Ω = {value_at(row, 'mean_by_event')}"


def lowest_in_words(study, figure, setting):
    rows, lowest = rotation.lowest_of(study, figure, setting)
    return f"lowest of {len(rows)} N up to {rows[-1]['discs']:.0f}: {rotation_at(lowest)}"


def change_of(crossing):
    """The change of the direction of rotation along a curve, as part of a sentence."""
    if crossing.verdict == "crosses":
        return f"at {crossing_sentence(crossing.words)}"
    low = f"ϖ/Ω is lowest at N = {crossing.lowest_discs:.0f}, {number(crossing.lowest)}"
    if crossing.verdict == "always rotates":
        return f"at no N that was run ({low})"
    if crossing.verdict == "always counterrotates":
        return f"at no N that was run, as all counterrotate ({low})"
    return f"at no N for certain ({low})"


def transition_found(study):
    judgement = judged(TRANSITION, study)
    rows = known(study.curve("5b", setting="high"), "mean_by_event")
    values = f"{rotation_at(rows[0])}, {rotation_at(rows[-1])}"
    change = change_of(study.crossing("5b", "high"))
    claim = (
        "with friction at the wall and between the discs (μ = 1) few discs rotate with the swirl "
        "and many against it"
    )
    return statement(
        judgement,
        "With friction at the wall and between the discs (μ = 1), few discs rotate with the swirl "
        f"and many against it ({values}); the direction changes {change}.",
        f"The claim that {claim} is not confirmed: {values}; the direction changes {change}.",
        f"Whether {claim} is undecided: {values}; the direction changes {change}.",
    )


def order_found(study):
    judgement = judged(ORDER, study)
    changes = ", ".join(
        f"with μ = {mu} {change_of(study.crossing('5b', name))}"
        for mu, name in (("0.5", "medium"), ("0.1", "low"))
    )
    return statement(
        judgement,
        f"With less friction the direction changes at higher N: {changes}.",
        f"Less friction does not always move the change to larger N: {changes}.",
        f"It is undecided whether less friction always moves the change to larger N: {changes}.",
    )


def both_frictions_found(study):
    """Without either friction there is no counterrotation."""
    cases = [
        (judged(claim, study), words, lowest_in_words(study, claim.figure, setting))
        for claim, setting, words in (
            (NO_WALL, "no-wall", "friction at the wall"),
            (NO_DISC, "no-disc", "friction between the discs"),
        )
    ]
    if all(judgement.verdict == HOLDS for judgement, _, _ in cases):
        return (
            "The cluster counterrotates only with both: "
            + ", and ".join(
                f"without {words} it never does ({lowest})" for _, words, lowest in cases
            )
            + "."
        )
    return " ".join(
        statement(
            judgement,
            f"Without {words} the cluster never counterrotates ({lowest}).",
            f"Counterrotation does not need {words} ({lowest}).",
            f"Whether counterrotation needs {words} is undecided ({lowest}).",
        )
        for judgement, words, lowest in cases
    )


def condensation_found(study):
    """Not a claim of the paper: what follows the gas."""
    every_row = study.table("condensation")
    rows = [row for row in every_row if row["condensed"]]
    if not rows:
        return ""
    times = ", ".join(
        f"{number(measured(row, 'waiting'))} periods at N = {row['discs']:.0f}" for row in rows
    )
    late = [
        f"{row['seeds'] - row['condensed']:.0f} of {row['seeds']:.0f} at N = {row['discs']:.0f}"
        for row in every_row
        if row["condensed"] < row["seeds"]
    ]
    after = [row["after_mean_by_time"] for row in rows]
    gas, gas_after = judged(GAS, study), judged(GAS_AFTER, study)
    ceases = Judgement({HOLDS: FAILS, FAILS: HOLDS}.get(gas_after.verdict, gas_after.verdict))
    rotates = every([above(measured(row, "after_mean_by_time"), LEAST_ROTATION) for row in rows])
    claim = (
        "without friction between the discs the cluster is a gas at first and then condenses into "
        "a crystal that rotates with the swirl"
    )
    found = f"ϖ/Ω = {min(after):.3f} to {max(after):.3f}, after {times}"
    return statement(
        combined(gas, ceases, rotates),
        f"{capital(claim)} ({found}).",
        f"That {claim}, is not confirmed ({found}).",
        f"Whether {claim}, is undecided ({found}).",
    ) + (f" Runs that did not condense: {', '.join(late)}." if late else "")


def experiment_found(study):
    """What spheres at the amplitude of the experiment do, next to the numbers of the paper."""
    judgement = judged(EXPERIMENT, study)
    known_changes = []
    for setting in SPHERES:
        try:
            known_changes.append(
                f"that of {WORDS[setting]} {change_of(study.crossing('spheres', setting))}"
            )
        except NO_TABLE:
            continue
    changes = (
        f"their direction changes: {'; '.join(known_changes)} (paper: {SMOOTH_CHANGE_N} for "
        "smooth, "
        f"{ROUGH_CHANGE_N} for roughened spheres; each friction coefficient is fitted to it)"
    )
    few_many = (
        "few spheres that roll on a floor rotate with the swirl and many against it, as in "
        "the experiment"
    )
    return statement(
        judgement,
        f"{capital(few_many)}; {changes}.",
        f"That {few_many}, is not confirmed; {changes}.",
        f"Whether {few_many}, is undecided; {changes}.",
    )


def predictions_found(study):
    """No parameter is fitted to these, but restitution, floor friction and amplitude are
    assumed."""
    slip, spin = judged(SLIP, study), judged(SPIN, study)
    slips = ends(study.curve("4a", setting="smooth"), "slip_resident")
    spins = ends(study.curve("4b", setting="smooth"), "resident_spin")
    return (
        "With the assumed restitution and floor friction: that the slip parameter of pinned "
        "spheres rises from about 0.5 to nearly 1 "
        f"{ANSWERS.get(slip.verdict, 'is not confirmed')} ({slips}); that their spin at the wall "
        f"falls {ANSWERS.get(spin.verdict, 'is not confirmed')} ({spins}, in Ω)."
    )


def frustration_found(study):
    """The title of the paper, judged by the figure that stops the spins."""
    title = judged(TITLE, study)
    incomplete = TITLE.why_undecided(study)
    parts = []
    for body in ("discs", "spheres"):
        induces = UNDECIDED if incomplete else spheres.stopped_spins(study, body)[0].verdict
        free, stopped = (
            value_at(
                study.curve("cause", body=body, spins=spins, contacts="none between particles")[-1],
                "mean_by_time",
            )
            for spins in ("free", "stopped")
        )
        parts.append(
            f"for {body} {ANSWERS.get(induces, 'is not confirmed')} (ϖ/Ω {free} if they can spin, "
            f"{stopped} if they cannot)"
        )
    claim = "geometric frustration induces counterrotation"
    words = (
        f"That stopped spins induce it without friction between particles {' and '.join(parts)}. "
        "That neighbours stop them as frustrated gears is a claim of its own (figure 4b)."
    )
    return statement(
        title,
        f"The title holds: {claim}. {words}",
        f"The title, {claim}, is not confirmed. {words}",
        f"Whether {claim} is undecided. {words}",
    )


def main_results(path):
    """Sentences; one whose tables do not exist is left out."""
    sentences = []
    study = Study(path)
    for find in (
        transition_found,
        order_found,
        both_frictions_found,
        experiment_found,
        predictions_found,
        frustration_found,
        condensation_found,
    ):
        try:
            sentences.append(find(study))
        except (*NO_TABLE, ValueError, ZeroDivisionError):
            continue
    return [sentence for sentence in sentences if sentence][:MOST]
