"""Claims on where particles pin and depin, and how many are pinned: by residences in the wall
layer. Each judge gets the setting of the runs (settings.py).

The SI's own criterion calls a disc pinned while it flies along the wall, however far from it. Its
values are reported next to those of the residences and decide nothing (docs/results/paper.md).
"""

import math

from paper import tables
from paper.paper_parameters import COUNTERROTATING_N, ROTATING_N
from paper.verdicts import FAILS, Value, above, agreed, below, combined, every, measured, within

from paper.claims import thresholds as size
from paper.claims.thresholds import OTHER_SIDE
from paper.claims.wording import count, ends, monotonic, number


def one_row_per_discs(study, setting):
    """The angles in table 3a are the same in all slices of an N."""
    rows = {row["discs"]: row for row in study.curve("3a", setting=setting)}
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
    """The change of an angle from the first N to the last. Discs run clockwise, so a larger θ is
    earlier."""
    path = unwrapped(rows, name)
    return path[-1] - path[0]


def spread(rows, name):
    """The largest distance of an angle between any two N."""
    path = unwrapped(rows, name)
    return max(path, key=lambda a: a.mean) - min(path, key=lambda a: a.mean)


def by_choice(study, setting):
    """{(layer in disc radii, shortest residence in periods): rows in order of N}, for every choice
    of the wall layer and of the shortest residence that counts."""
    points = {row["discs"]: row.get("point") for row in study.curve("3a", setting=setting)}
    choices = {}
    for row in study.curve("3a_sensitivity", setting=setting):
        # The layer is computed from the container's radius; its last digit differs between N.
        choice = (round(row["layer"], 6), round(row["min_length"], 6))
        choices.setdefault(choice, []).append(row | {"point": points.get(row["discs"])})
    return choices


def choices_in_words(choices):
    layers, lengths = sorted({c[0] for c in choices}), sorted({c[1] for c in choices})
    return (
        f"{len(choices)} choices of the layer ({layers[0]:g} to {layers[-1]:g} radii from the "
        f"wall) and of the shortest residence ({lengths[0]:.2f} to {lengths[-1]:.2f} periods)"
    )


def span_over_choices(found):
    found = [v.mean for v in found if v.known]
    return f"{min(found):.0f} to {max(found):.0f}" if found else "n/a"


def with_size(rows, share, begin, end):
    """The rows with the size of the pinned region: the number of resident particles and its extent
    in degrees. Particles run clockwise, so the region reaches from the end of residences to their
    beginning."""
    return [
        row
        | {
            "residents": row[share] * row["discs"],
            "residents_error": row[f"{share}_error"] * row["discs"],
            "extent": (row[begin] - row[end]) % 360,
            "extent_error": math.hypot(row[f"{begin}_error"], row[f"{end}_error"]),
        }
        for row in rows
    ]


def pinned_grows(study, setting):
    """ "Increasing the size of the pinned region": both its number of particles and its extent. The
    share of the particles that reside there is not its size."""
    rows = with_size(
        one_row_per_discs(study, setting), "residence_share", "residence_begin", "residence_end"
    )
    choices = {
        choice: with_size(c, "share", "pinning", "depinning")
        for choice, c in by_choice(study, setting).items()
    }
    found = [
        every([monotonic(c, "residents")[0], monotonic(c, "extent")[0]]) for c in choices.values()
    ]
    return agreed(found), (
        f"{ends(rows, 'residents')} particles reside at the wall, and their region extends over "
        f"{ends(rows, 'extent')} "
        f"(degrees); both rise for {count(found)} of {choices_in_words(choices)}; the share that "
        "resides there is "
        f"{ends(rows, 'residence_share')}, that pinned by the SI's criterion {ends(rows, 'share')}"
    )


def pinned_earlier(study, setting):
    rows, choices = one_row_per_discs(study, setting), by_choice(study, setting)
    shifts = [upstream_shift(c, "pinning") for c in choices.values()]
    return agreed([above(shift, size.LEAST_ADVANCE) for shift in shifts]), (
        f"residences at the wall begin at θ = {ends(rows, 'residence_begin')} (degrees); this "
        "angle moves upstream by "
        f"{number(upstream_shift(rows, 'residence_begin'))}°, and by {span_over_choices(shifts)}° "
        f"with the {choices_in_words(choices)}; by the SI's sharp turns {ends(rows, 'pinning')}"
    )


def resultants(rows, name):
    return f"{rows[0][name]:.2f} and {rows[-1][name]:.2f}"


def free_fixed(study, setting):
    rows, choices = one_row_per_discs(study, setting), by_choice(study, setting)
    spreads = [spread(c, "depinning") for c in choices.values()]
    same = [below(s, size.SAME_ANGLE) for s in spreads]
    return agreed(same), (
        f"residences at the wall end at θ = {ends(rows, 'residence_end')} (degrees; resultant "
        f"length {resultants(rows, 'residence_end_resultant')}); over all N this angle moves by "
        f"{number(spread(rows, 'residence_end'))}°, and by {span_over_choices(spreads)}° with the "
        f"{choices_in_words(choices)}; certainly at the same location with {count(same)} of them, "
        f"certainly at different ones with {count(same, FAILS)}; by the SI's criterion "
        f"{ends(rows, 'depinning')}, with resultants "
        f"{resultants(rows, 'depinning_resultant')}, as it also counts those that move along the "
        f"wall far from it{two_locations(study, setting, 'si_depinning')}"
    )


def two_locations(study, setting, name):
    """At the last N: the angle where most particles depin, and the one on the other side of the
    container. The mean of two such angles is an angle where few do."""
    try:
        rows = study.curve("pinning", setting=setting)
        last = rows[-1]["discs"]
    except (FileNotFoundError, IndexError):
        return ""
    rows = tables.select(rows, discs=last)
    highest = max(rows, key=lambda row: row[name])
    across = [
        row for row in rows if abs((row["theta"] - highest["theta"] + 180) % 360 - 180) > OTHER_SIDE
    ]
    second = max(across, key=lambda row: row[name])
    return (
        f": at N = {last:.0f} most are at θ = {highest['theta']:.0f}° ({100 * highest[name]:.0f} % "
        "in 10°), and "
        f"farther than {OTHER_SIDE:.0f}° from there up to {100 * second[name]:.0f} % at "
        f"{second['theta']:.0f}°"
    )


def top_left(study, setting):
    """The middle of the pinned region must be in the quadrant 90° to 180°, at the N of Figures 2b
    and 2c."""
    middles = []
    for row in [
        row
        for row in one_row_per_discs(study, setting)
        if row["discs"] in (ROTATING_N, COUNTERROTATING_N)
    ]:
        begin, end = measured(row, "residence_begin"), measured(row, "residence_end")
        ahead = Value((begin.mean - end.mean) % 360, math.hypot(begin.error, end.error), end.points)
        middles.append(Value(end.mean, 0.0, begin.points) - ahead * -0.5)
    if len(middles) < 2:
        raise ValueError("one of the two N is missing")
    return combined(*(within(middle, 90.0, 180.0) for middle in middles)), (
        "the middle between the beginning and the end of residences at the wall is at θ = "
        + " and ".join(
            f"{number(middle)}° for N = {n}"
            for middle, n in zip(middles, (ROTATING_N, COUNTERROTATING_N))
        )
    )
