"""Claims on spheres that settle at the wall: rigidity, encounters, and rolling in contact (figure
"settling"). Each judge gets the setting of the runs (settings.py)."""

from paper.verdicts import above, below, combined, every, measured

from paper.claims import thresholds as size
from paper.claims.wording import ends, number, values


def rigid(study, setting):
    """The velocities that a rigid motion of the resident particles leaves must be small, and
    smaller than those of the loose ones. Each N is a part of the claim."""
    rows = study.curve("settling", setting=setting)
    resident, loose = values(rows, "rigid_resident"), values(rows, "rigid_loose")
    return combined(
        *(every([below(a, size.RIGID), below(a - b, 0)]) for a, b in zip(resident, loose))
    ), (
        f"a rigid motion leaves {ends(rows, 'rigid_resident')} of the velocities of those that "
        f"reside at the wall, in ΩR, and {ends(rows, 'rigid_loose')} of those of loose ones"
    )


def settles(study, setting):
    rows = study.curve("settling", setting=setting)
    return every([above(v, size.MULTIPLE) for v in values(rows, "encounters")]), (
        f"{ends(rows, 'encounters')} encounters in the quarter period before a residence begins; "
        f"two or more before a share of {ends(rows, 'two_encounters')}"
    )


def single_file(study, setting):
    """ "Cannot advance as a tight single-file": fewer than half of those that advance in single
    file, in strong contact, roll on the floor."""
    rows = study.curve("settling", setting=setting)
    return every([below(v, size.MAJORITY) for v in values(rows, "rolling_single_file")]), (
        "of spheres in strong contact that move in single file, a share of "
        f"{ends(rows, 'rolling_single_file')} rolls"
    )


def side_by_side(study, setting):
    """ "Can only roll on the ground side-by-side": more of them roll than in single file, at every
    N."""
    rows = study.curve("settling", setting=setting)
    more = [
        measured(row, "rolling_side_by_side") - measured(row, "rolling_single_file") for row in rows
    ]
    return every([above(v, 0) for v in more]), (
        "of spheres in strong contact that move side by side, a share of "
        f"{ends(rows, 'rolling_side_by_side')} rolls; more than in "
        f"single file by {number(more[0])} and {number(more[-1])}"
    )
