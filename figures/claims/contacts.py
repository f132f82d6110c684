"""Claims on slip, spin and packing of the pinned discs: Figure 4, and the text on frustration."""

from paper_parameters import PERIOD
from verdicts import Value, above, below, combined, every, mean_of, measured, rises

from .thresholds import (ANTIFERROMAGNETIC, LEAST_CHANGE, LEAST_SLIP_GAP, LEAST_SLIP_RISE, MAJORITY, NEARLY_ONE,
                         RANDOM_SIX)
from .wording import count, ends, lowest_to_highest, monotonic, number, values


def slip_rises(study):
    rows = study.curve("4a", setting="high")
    judgement, reversal = monotonic(rows, "slip_resident", least=LEAST_SLIP_RISE)
    return combined(judgement, above(measured(rows[-1], "slip_resident"), NEARLY_ONE)), (
        f"s of the discs that reside at the wall: {ends(rows, 'slip_resident')}{reversal} (nearly 1: above "
        f"{NEARLY_ONE}); of all pinned by the SI's criterion: {ends(rows, 'pinned_region')}. The 0.5 at N = 25 is "
        "that of the experiment, whose friction coefficient is unknown.")


def closer_to_one(rough, smooth):
    """Rows of two friction coefficients: is s "consistently closer to 1" for the rougher one? On average over
    the N that both have by LEAST_SLIP_GAP, and at no N farther from 1 by as much."""
    smooth = {row["discs"]: row for row in smooth}
    pairs = [(row, smooth[row["discs"]]) for row in rough if row["discs"] in smooth]
    gains = [abs(measured(b, "slip_resident") - 1) - abs(measured(a, "slip_resident") - 1) for a, b in pairs]
    mean = mean_of(gains)
    return every([above(mean, LEAST_SLIP_GAP)] + [above(gain, -LEAST_SLIP_GAP) for gain in gains]), (
        f"on average over N by {number(mean)} (required: {LEAST_SLIP_GAP}); closer for certain at "
        f"{count([above(gain, 0) for gain in gains])} of {len(gains)} N, farther for certain at "
        f"{count([below(gain, 0) for gain in gains])}")


def slip_rough(study):
    low = study.curve("4a", setting="low")
    judgement, found = closer_to_one(study.curve("4a", setting="high"), low)
    return judgement, (
        f"s of the discs that reside at the wall is closer to 1 for μ = 1 than for μ = 0.1, {found}; for μ = 0.1: "
        f"{ends(low, 'slip_resident')}, of all pinned by the SI's criterion {ends(low, 'pinned_region')}.")


def wall_spin(study):
    rows = study.curve("4b", setting="high")
    judgement, reversal = monotonic(rows, "resident_spin", falling=True)
    return judgement, (
        f"⟨|ω|⟩/Ω of the discs that reside at the wall: {ends(rows, 'resident_spin')}{reversal}; of those at the "
        f"wall that are pinned by the SI's criterion: {ends(rows, 'pinned_wall_spin')}. The paper calls frustration "
        "the reason. It can be counted (no claim of the paper's): the share of the contacts that belong to a "
        f"triangle is {ends(rows, 'triangles')}.")


def gears(study):
    """In every kind of contact that could be strong, and at every N. A mean over N says little where the values
    differ between N by many errors."""
    rows = study.curve("4b", setting="high")
    return combined(*(every([below(v, ANTIFERROMAGNETIC) for v in values(rows, name)]) for name in
                      ("correlation_by_impulse", "resident_correlation", "along_wall"))), (
        "Correlation of the spins (gears have −1, independent spins 0; antiferromagnetic-like: below "
        f"{number(ANTIFERROMAGNETIC)}) over all N: in disc–disc collisions, weighted by impulse, "
        f"{lowest_to_highest(rows, 'correlation_by_impulse')}; of a disc that resides at the wall and any disc "
        f"that it touches, {lowest_to_highest(rows, 'resident_correlation')}; of neighbours along the wall, "
        f"{lowest_to_highest(rows, 'along_wall')}. Of pairs that are pinned by the SI's criterion: "
        f"{ends(rows, 'pinned_correlation')}; of all touching pairs: {ends(rows, 'spin_correlation')}.")


def more_collisions(study):
    rows = study.curve("4b", setting="high")
    # The two kinds of one run are not independent: their errors add up.
    found = [Value(PERIOD * (row["disc_disc_rate"] + row["disc_wall_rate"]),
                   PERIOD * (row["disc_disc_rate_error"] + row["disc_wall_rate_error"]),
                   [row["point"]] if "point" in row else ()) for row in rows]
    return rises(found, LEAST_CHANGE * found[0].mean), (
        f"Collisions of a disc per period: {number(found[0])} at N = {rows[0]['discs']:.0f}, {number(found[-1])} at "
        f"N = {rows[-1]['discs']:.0f}.")


def six_fold(study):
    """Discs at the wall are left out: they cannot have six neighbours."""
    rows = study.curve("4b", setting="high")
    return above(measured(rows[-1], "six_pinned"), MAJORITY), (
        "Share of the discs pinned by the SI's criterion, without those at the wall, that have six neighbours: "
        f"{ends(rows, 'six_pinned')} (often: more than {MAJORITY}; random points have {RANDOM_SIX}, a crystal 1); of "
        f"all discs away from the wall: {ends(rows, 'six')}. Hexatic order ψ6 of the pinned, including those at the "
        f"wall: {ends(rows, 'psi6_pinned')}.")
