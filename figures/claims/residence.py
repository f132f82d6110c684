"""Claims on where discs pin and depin, and how many are pinned: by residences in the wall layer.

The SI's own criterion calls a disc pinned while it flies along the wall, however far from it. Its values are
reported next to those of the residences and decide nothing (docs/explanation/paper.md).
"""

import math

import tables
from paper_parameters import COUNTERROTATING_N, M_ANGLE, ROTATING_N
from verdicts import FAILS, Value, above, agreed, below, combined, measured, within

from .thresholds import LEAST_ADVANCE, OTHER_SIDE, SAME_ANGLE
from .wording import count, ends, monotonic, number


def one_row_per_discs(study):
    """The angles in table 3a are the same in all slices of an N."""
    rows = {row["discs"]: row for row in study.curve("3a")}
    return [rows[n] for n in sorted(rows)]


def unwrapped(rows, name):
    """Angles in degrees without jumps of a whole turn."""
    result = []
    for row in rows:
        angle = measured(row, name)
        if angle.mean != angle.mean:
            continue
        if result:
            angle.mean += 360 * round((result[-1].mean - angle.mean) / 360)
        result.append(angle)
    return result


def upstream_shift(rows, name):
    """The change of an angle from the first N to the last. Discs run clockwise, so a larger θ is earlier."""
    path = unwrapped(rows, name)
    return path[-1] - path[0]


def spread(rows, name):
    """The largest distance of an angle between any two N."""
    path = unwrapped(rows, name)
    return max(path, key=lambda a: a.mean) - min(path, key=lambda a: a.mean)


def by_choice(study):
    """{(layer in disc radii, shortest residence in periods): rows in order of N}, for every choice of the
    wall layer and of the shortest residence that counts."""
    points = {row["discs"]: row.get("point") for row in study.table("3a")}
    choices = {}
    for row in study.curve("3a_sensitivity"):
        # The layer is computed from the container's radius; its last digit differs between N.
        choice = (round(row["layer"], 6), round(row["min_length"], 6))
        choices.setdefault(choice, []).append(row | {"point": points.get(row["discs"])})
    return choices


def choices_in_words(choices):
    layers, lengths = sorted({c[0] for c in choices}), sorted({c[1] for c in choices})
    return (f"{len(choices)} choices of the layer ({layers[0]:g} to {layers[-1]:g} radii from the wall) and of the "
            f"shortest residence ({lengths[0]:.2f} to {lengths[-1]:.2f} periods)")


def span_over_choices(found):
    found = [v.mean for v in found if v.known]
    return f"{min(found):.0f} to {max(found):.0f}" if found else "n/a"


def pinned_grows(study):
    rows, choices = one_row_per_discs(study), by_choice(study)
    found = [monotonic(c, "share")[0] for c in choices.values()]
    return agreed(found), (
        f"Share of the discs that reside at the wall: {ends(rows, 'residence_share')}; it rises for {count(found)} "
        f"of {choices_in_words(choices)}. Pinned by the SI's criterion: {ends(rows, 'share')}.")


def pinned_earlier(study):
    rows, choices = one_row_per_discs(study), by_choice(study)
    shifts = [upstream_shift(c, "pinning") for c in choices.values()]
    return agreed([above(shift, LEAST_ADVANCE) for shift in shifts]), (
        f"Residences at the wall begin at θ = {ends(rows, 'residence_begin')} (degrees). This angle moves upstream "
        f"by {number(upstream_shift(rows, 'residence_begin'))}° (earlier: more than {LEAST_ADVANCE:.0f}°), and by "
        f"{span_over_choices(shifts)}° with the {choices_in_words(choices)}. By the SI's sharp turns: "
        f"{ends(rows, 'pinning')}.")


def resultants(rows, name):
    return f"{rows[0][name]:.2f} and {rows[-1][name]:.2f}"


def free_fixed(study):
    rows, choices = one_row_per_discs(study), by_choice(study)
    spreads = [spread(c, "depinning") for c in choices.values()]
    same = [below(s, SAME_ANGLE) for s in spreads]
    return agreed(same), (
        f"Residences at the wall end at θ = {ends(rows, 'residence_end')} (degrees; resultant length "
        f"{resultants(rows, 'residence_end_resultant')}). Over all N this angle moves by "
        f"{number(spread(rows, 'residence_end'))}°, and by {span_over_choices(spreads)}° with the "
        f"{choices_in_words(choices)}. The location is certainly the same (within {SAME_ANGLE:.0f}°) with {count(same)} "
        f"of them, and certainly different with {count(same, FAILS)}. By the SI's criterion {ends(rows, 'depinning')}, "
        f"with resultants {resultants(rows, 'depinning_resultant')}: it also counts discs that fly along the wall "
        f"far from it{two_locations(study, 'si_depinning')}.")


def two_locations(study, name):
    """At the last N: the angle where most discs depin, and the one on the other side of the container. The mean
    of two such angles is an angle where few do."""
    try:
        rows = study.table("pinning")
    except FileNotFoundError:
        return ""
    last = max(row["discs"] for row in rows)
    rows = tables.select(rows, discs=last)
    highest = max(rows, key=lambda row: row[name])
    across = [row for row in rows
              if abs((row["theta"] - highest["theta"] + 180) % 360 - 180) > OTHER_SIDE]
    second = max(across, key=lambda row: row[name])
    return (f", and its angles spread: at N = {last:.0f} most are at θ = {highest['theta']:.0f}° "
            f"({100 * highest[name]:.0f} % in 10°), and farther than {OTHER_SIDE:.0f}° from there up to "
            f"{100 * second[name]:.0f} % at {second['theta']:.0f}°")


def top_left(study):
    """The middle of the pinned region must be in the quadrant 90° to 180°, at the N of Figures 2b and 2c."""
    middles = []
    for row in [row for row in one_row_per_discs(study) if row["discs"] in (ROTATING_N, COUNTERROTATING_N)]:
        begin, end = measured(row, "residence_begin"), measured(row, "residence_end")
        ahead = Value((begin.mean - end.mean) % 360, math.hypot(begin.error, end.error), end.points)
        middles.append(Value(end.mean, 0.0, begin.points) - ahead * -0.5)
    if len(middles) < 2:
        raise ValueError("one of the two N is missing")
    return combined(*(within(middle, 90.0, 180.0) for middle in middles)), (
        "The middle between the beginning and the end of residences at the wall is at θ = " + " and ".join(
            f"{number(middle)}° for N = {n}" for middle, n in zip(middles, (ROTATING_N, COUNTERROTATING_N))) +
        f" (top left: 90° to 180°; 180° is left, {M_ANGLE:.0f}° is M).")


# --- The same for spheres: rows of one friction coefficient --------------------------------------

def grows(rows):
    judgement, reversal = monotonic(rows, "residence_share")
    return judgement, f"share that resides at the wall: {ends(rows, 'residence_share')}{reversal}"


def earlier(rows):
    shift = upstream_shift(rows, "residence_begin")
    return above(shift, LEAST_ADVANCE), (
        f"residences at the wall begin at θ = {ends(rows, 'residence_begin')} (degrees): this angle moves upstream "
        f"by {number(shift)}° (earlier: more than {LEAST_ADVANCE:.0f}°)")


def same_location(rows):
    apart = spread(rows, "residence_end")
    return below(apart, SAME_ANGLE), (
        f"residences at the wall end at θ = {ends(rows, 'residence_end')} (degrees): over all N this angle moves by "
        f"{number(apart)}° (the same location: within {SAME_ANGLE:.0f}°)")
