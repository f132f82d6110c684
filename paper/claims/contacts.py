"""Claims on slip, spin and packing of the pinned particles: Figure 4, and the text on frustration.
Each judge gets the setting of the runs (settings.py)."""

from paper.paper_parameters import SLIP_AT_25
from paper.verdicts import (
    Value,
    above,
    agreed,
    below,
    combined,
    every,
    mean_of,
    measured,
    rises,
    within,
)

from paper.claims import thresholds as size
from paper.claims.settings import ROUGHER_THAN
from paper.claims.thresholds import HIGH_N
from paper.claims.wording import (
    count,
    ends,
    known,
    lowest_to_highest,
    monotonic,
    number,
    value_at,
    values,
)


def slip_rises(study, setting):
    """From a half at N = 25 to nearly 1, for both definitions of the pinned particles. The paper
    does not say which it uses, so they must agree."""
    rows = study.curve("4a", setting=setting)
    first = min(rows, key=lambda row: abs(row["discs"] - SLIP_AT_25[0]))
    judged, reversals = [], []
    for name in ("slip_resident", "pinned_region"):
        judgement, reversal = monotonic(rows, name, least=size.LEAST_SLIP_RISE)
        half = within(
            measured(first, name), SLIP_AT_25[1] - size.ABOUT_HALF, SLIP_AT_25[1] + size.ABOUT_HALF
        )
        judged.append(combined(judgement, half, above(measured(rows[-1], name), size.NEARLY_ONE)))
        reversals.append(reversal)
    return agreed(judged), (
        f"s of those that reside at the wall is {value_at(first, 'slip_resident')}, "
        f"{value_at(rows[-1], 'slip_resident')}"
        f"{reversals[0]}; of all pinned by the SI's criterion {value_at(first, 'pinned_region')}, "
        f"{value_at(rows[-1], 'pinned_region')}{reversals[1]}"
    )


def slip_rough(study, setting):
    """Is s "consistently closer to 1" for the rougher of two settings? On average over the N that
    both have by LEAST_SLIP_GAP, and at no N farther from 1 by as much."""
    rough, smooth = (study.curve("4a", setting=name) for name in ROUGHER_THAN[setting])
    smooth = {row["discs"]: row for row in smooth}
    pairs = [(row, smooth[row["discs"]]) for row in rough if row["discs"] in smooth]
    gains = [
        abs(measured(b, "slip_resident") - 1) - abs(measured(a, "slip_resident") - 1)
        for a, b in pairs
    ]
    mean = mean_of(gains)
    return every(
        [above(mean, size.LEAST_SLIP_GAP)] + [above(gain, -size.LEAST_SLIP_GAP) for gain in gains]
    ), (
        "s of those that reside at the wall is closer to 1 with more friction, on average over N "
        f"by {number(mean)}; "
        f"closer for certain at {count([above(gain, 0) for gain in gains])} of {len(gains)} N, "
        f"farther for certain at {count([below(gain, 0) for gain in gains])}"
    )


def wall_spin(study, setting):
    rows = study.curve("4b", setting=setting)
    judgement, reversal = monotonic(rows, "resident_spin", falling=True)
    return judgement, (
        f"⟨|ω|⟩/Ω of those that reside at the wall is {ends(rows, 'resident_spin')}{reversal}; of "
        "those pinned there by "
        f"the SI's criterion {ends(rows, 'pinned_wall_spin')}; the share of the contacts that "
        f"belong to a triangle is {ends(rows, 'triangles')}"
    )


# --- Spins of particles that touch --------------------------------------------------------------


def gears(study, setting):
    """Of the pairs that no common neighbour frustrates. Each N is a part of the claim. A mean over
    N says little where the values differ between N by many errors."""
    rows = known(study.curve("4b", setting=setting), "chain_correlation")
    opposed = [below(v, size.ANTIFERROMAGNETIC) for v in values(rows, "chain_correlation")]
    return combined(*opposed), (
        f"at {count(opposed)} of {len(opposed)} N; correlation of the spins of pairs that touch "
        f"and have no common neighbour {ends(rows, 'chain_correlation')} (over all N "
        f"{lowest_to_highest(rows, 'chain_correlation')}), of all pairs "
        f"that touch {ends(rows, 'spin_correlation')}, in collisions, weighted by impulse, "
        f"{ends(rows, 'correlation_by_impulse')}"
    )


def triangles_frustrate(study, setting):
    """Three gears that touch each other cannot turn: pairs with a common neighbour have no order.
    Each N is a part of the claim."""
    rows = known(study.curve("4b", setting=setting), "triangle_correlation")
    found = values(rows, "triangle_correlation")
    none = [within(v, size.ANTIFERROMAGNETIC, -size.ANTIFERROMAGNETIC) for v in found]
    weaker = [above(v - free, 0) for v, free in zip(found, values(rows, "chain_correlation"))]
    return combined(*none), (
        f"at {count(none)} of {len(none)} N; less opposed than pairs in no triangle for certain at "
        f"{count(weaker)}; "
        "correlation of the spins of pairs that touch and have a common neighbour "
        f"{ends(rows, 'triangle_correlation')} (over all N "
        f"{lowest_to_highest(rows, 'triangle_correlation')}); such "
        f"pairs are {ends(rows, 'triangles')} of all that touch"
    )


def prevented_from_rolling(study, setting):
    """At high N, fewer than half of those at the wall must roll. That fewer roll there than
    elsewhere does not suffice, if most do."""
    rows = known(study.curve("4b", setting=setting), "wall_rolling_share")
    return every(
        [
            below(v, size.MAJORITY)
            for v in values([row for row in rows if row["discs"] >= HIGH_N], "wall_rolling_share")
        ]
    ), (
        f"share of those at the wall that roll on the floor {ends(rows, 'wall_rolling_share')} "
        f"(over all N {lowest_to_highest(rows, 'wall_rolling_share')}), of all spheres "
        f"{ends(rows, 'rolling_share')}"
    )


# --- Packing and collisions ---------------------------------------------------------------------


def more_collisions(study, setting):
    rows = study.curve("4b", setting=setting)
    # The two kinds of one run are not independent: their errors add up.
    found = [
        Value(
            row["disc_disc_rate"] + row["disc_wall_rate"],
            row["disc_disc_rate_error"] + row["disc_wall_rate_error"],
            [row["point"]] if "point" in row else (),
        )
        for row in rows
    ]
    growth = found[-1] * (1 / found[0].mean)
    return rises(found, size.LEAST_CHANGE * found[0].mean), (
        f"a particle collides {number(growth)} times as often at N = {rows[-1]['discs']:.0f} as at "
        f"N = {rows[0]['discs']:.0f}"
    )


def six_fold(study, setting):
    """Particles at the wall are left out: they cannot have six neighbours."""
    rows = study.curve("4b", setting=setting)
    return above(measured(rows[-1], "six_pinned"), size.MAJORITY), (
        "share of those pinned by the SI's criterion, without those at the wall, that have six "
        "neighbours "
        f"{ends(rows, 'six_pinned')}; of all away from the wall {ends(rows, 'six')}; hexatic order "
        f"ψ6 of the pinned, including those at the wall, {ends(rows, 'psi6_pinned')}"
    )
