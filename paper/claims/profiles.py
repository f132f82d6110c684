"""Claims on the M-frame profiles of Figures 2 and 3: how fast particles move at each angle θ. Each
judge gets the setting of the runs (settings.py)."""

import math

from paper import tables
from paper.paper_parameters import COUNTERROTATING_N, ROTATING_N
from paper.verdicts import FAILS, Value, above, below, combined, every, mean_of, measured, within

from paper.claims import thresholds as size
from paper.claims.settings import DISHES
from paper.claims.thresholds import (
    BETWEEN_LAYERS,
    FIRST_LAYER,
    IDENTICAL,
    LEAST_VISITS,
    PEAK_WINDOW,
    SECOND_LAYER,
)
from paper.claims.wording import count, ends, monotonic, number, values


def by_discs(profile, least_visits=LEAST_VISITS):
    """(N, slices with more visits than these) in order of N."""
    found = {}
    for row in profile:
        found.setdefault(row["discs"], []).append(row)
    return [
        (discs, [row for row in found[discs] if row["visits"] > least_visits])
        for discs in sorted(found)
    ]


def pinned_slices(rows):
    """Slices between the beginning and the end of a residence at the wall, clockwise (θ falls)."""
    start, end = rows[0]["residence_begin"], rows[0]["residence_end"]
    arc = (start - end) % 360
    return [row for row in rows if (start - row["theta"]) % 360 <= arc and row["visits"] > 0]


def mean_over_slices(rows, name):
    """The mean over the visits. Slices of one run are not independent, so their
    errors are added, not their squares."""
    visits = [row["visits"] for row in rows]
    mean = mean_of(values(rows, name), visits)
    error = sum(w * row[name + "_error"] for w, row in zip(visits, rows)) / sum(visits)
    return Value(mean.mean, error, mean.points)


def nearest_slice(rows, theta):
    if theta != theta:
        raise ValueError("the angle is unknown")
    return min(rows, key=lambda row: abs((row["theta"] - theta + 180) % 360 - 180))


def identity(study, setting):
    """Eq. 1, ϖ_M = ϖ − Ω, is a change of frames, not a claim. It checks the measurements: both
    means are averages of the same runs, sampled 511 and 64 times per period."""
    profile, worst = by_discs(study.curve("3a", setting=setting), least_visits=0), 0.0
    try:
        rotation = {row["discs"]: row for row in study.curve("1b", setting=setting)}
    except FileNotFoundError:
        return ""
    for discs, slices in profile:
        if slices and discs in rotation:
            total = sum(row["visits"] for row in slices)
            mean = sum(row["visits"] * row["varpi_m"] for row in slices) / total
            worst = max(worst, abs(mean + 1 - rotation[discs]["mean_by_time"]))
    agreement = "as they must" if worst < IDENTICAL else "which they must not"
    return (
        " (Eq. 1, ϖ_M = ϖ − Ω, is an identity and not counted as a claim: these runs differ from "
        f"it by at most {worst:.2g} Ω, {agreement})"
    )


def clockwise(study, setting):
    """Means over all particles in a slice. A single particle may move backwards for an instant."""
    rows = [row for row in study.curve("3a", setting=setting) if row["visits"] > LEAST_VISITS]
    negative = [below(v, -size.LEAST_ROTATION) for v in values(rows, "varpi_m")]
    fastest = max(rows, key=lambda row: row["varpi_m"])
    return every(negative), (
        f"⟨ϖ_M⟩ is certainly negative in {count(negative)} of {len(rows)} slices of θ and N, "
        "certainly positive "
        f"in {count(negative, FAILS)}; the highest is {number(measured(fastest, 'varpi_m'))} Ω"
        f"{identity(study, setting)}"
    )


# --- The pinned and the loose region ------------------------------------------------------------


def pinned_means(study, table, name, setting):
    """The mean over the pinned region, a row for each N."""
    result = []
    for discs, slices in by_discs(study.curve(table, setting=setting), least_visits=0):
        here = (
            [
                row
                for row in pinned_slices(slices)
                if row[name] == row[name] and row[name + "_error"] == row[name + "_error"]
            ]
            if slices
            else []
        )
        if here:
            mean = mean_over_slices(here, name)
            result.append(
                {
                    "discs": discs,
                    "mean": mean.mean,
                    "mean_error": mean.error,
                    "point": here[0].get("point"),
                }
            )
    return result


def pinned_reach_wall(study, setting):
    rows = pinned_means(study, "3b", "normalised", setting)
    first, last = measured(rows[0], "mean"), measured(rows[-1], "mean")
    return combined(
        below(first, 1 - size.AT_THE_WALL), within(last, 1 - size.AT_THE_WALL, 1 + size.AT_THE_WALL)
    ), (f"normalised angular velocity in the pinned region {ends(rows, 'mean')}")


def pinned_faster(study, setting):
    rows = pinned_means(study, "3a", "varpi_m", setting)
    judgement, reversal = monotonic(rows, "mean", falling=True, least=size.NEAR_OMEGA)
    return judgement, f"⟨ϖ_M⟩/Ω in the pinned region {ends(rows, 'mean')}{reversal}"


def aligned(rows):
    """(the slice of the peak of |ϖ_M|, {θ − θ_peak: |ϖ_M| − 1 near the peak})."""
    peak = min(rows, key=lambda row: row["varpi_m"])
    offsets = {round((row["theta"] - peak["theta"] + 180) % 360 - 180, 3): row for row in rows}
    return peak, {
        offset: -measured(row, "varpi_m") - 1
        for offset, row in offsets.items()
        if abs(offset) <= PEAK_WINDOW
    }


def loose_peak(study, setting):
    """Profiles are shifted so that their peaks coincide, and compared with the mean over N. What
    counts is |ϖ_M| above that of the wall: |ϖ_M| itself is nearly 1 everywhere, and similar in any
    case."""
    found = [
        (discs, *aligned(rows)) for discs, rows in by_discs(study.curve("3a", setting=setting))
    ]
    if not found:
        raise ValueError("no run of this setting")
    shared = set.intersection(*(set(shape) for _, _, shape in found))
    mean = {offset: mean_of([shape[offset] for _, _, shape in found]).mean for offset in shared}
    allowed = size.SIMILAR * abs(mean[0])
    apart, similar = [], []
    for _, _, shape in found:
        # Slices of one run are not independent, so their errors are added, not their squares.
        apart.append(
            Value(
                sum(abs(shape[k].mean - mean[k]) for k in shared) / len(shared),
                sum(shape[k].error for k in shared) / len(shared),
                shape[0].points,
            )
        )
        similar.append(
            every(
                [below(apart[-1], allowed), within(shape[0], mean[0] - allowed, mean[0] + allowed)]
            )
        )
    (first, peak, few), (last, other, many) = found[0], found[-1]
    return every(similar), (
        f"peak of |⟨ϖ_M⟩| above Ω {number(few[0])} Ω at θ = {peak['theta']:.0f}° for N = "
        f"{first:.0f}, {number(many[0])} Ω at {other['theta']:.0f}° for N = {last:.0f}; within "
        f"{PEAK_WINDOW:.0f}° of the peak the "
        f"shapes differ from their mean by up to {number(max(apart, key=lambda v: v.mean))} Ω on "
        f"average (allowed: {allowed:.3f} Ω)"
    )


def pinned_contribution(study, setting):
    """Contributions to the difference of ⟨ϖ_M⟩ between few and many particles. ⟨ϖ_M⟩ = p P + (1 −
    p) L, with the share p of the visits to the pinned region and the means P there and L in the
    loose region. Each of the three changes, and the changes add up exactly if each is multiplied by
    the mean of the other factor at both ends."""
    profile = by_discs(study.curve("3a", setting=setting), least_visits=0)
    found = []
    for _, here in (profile[0], profile[-1]):
        pinned = pinned_slices(here)
        loose = [row for row in here if row not in pinned]
        share = sum(row["visits"] for row in pinned) / sum(row["visits"] for row in here)
        found.append(
            (share, mean_over_slices(pinned, "varpi_m"), mean_over_slices(loose, "varpi_m"))
        )
    (few, pinned_few, loose_few), (many, pinned_many, loose_many) = found
    share = (few + many) / 2
    by_pinned = (pinned_many - pinned_few) * share
    by_loose = (loose_many - loose_few) * (1 - share)
    by_share = (
        ((pinned_few.mean + pinned_many.mean) - (loose_few.mean + loose_many.mean))
        / 2
        * (many - few)
    )
    return [discs for discs, _ in profile], by_pinned, by_loose, by_share


def pinned_decides(study, setting):
    numbers, pinned, loose, share = pinned_contribution(study, setting)
    total = pinned.mean + loose.mean + share
    # More than half of the whole: more than everything else, with the sign of the whole.
    sign = -1 if total < 0 else 1
    lead = (pinned - loose - share) * sign
    return above(lead, (2 * size.MAJORITY - 1) * abs(total)), (
        f"from N = {numbers[0]:.0f} to {numbers[-1]:.0f} ⟨ϖ_M⟩/Ω changes by "
        f"{number(Value(total))}: by "
        f"{number(pinned)} because pinned particles are faster, by {number(loose)} because loose "
        f"ones are, and by {number(Value(share))} because more are pinned"
    )


def loose_accelerate(study, setting):
    gains, text = [], []
    for discs, here in by_discs(study.curve("3a", setting=setting)):
        pinned = pinned_slices(here)
        loose = [row for row in here if row not in pinned]
        released = measured(nearest_slice(here, here[0]["residence_end"]), "speed")
        fastest = max(loose, key=lambda row: row["speed"])
        gains.append(
            above(measured(fastest, "speed") - released, size.LEAST_CHANGE * released.mean)
        )
        text.append(
            f"{number(released)} where they depin and {number(measured(fastest, 'speed'))} at θ = "
            f"{fastest['theta']:.0f}° for N = {discs:.0f}"
        )
    return every(gains), (
        "speed relative to the centre of mass in the M-frame, in units of the container's speed, "
        f"{text[0]}; {text[-1]}; certainly faster at {count(gains)} of {len(gains)} N"
    )


def oblong(study, setting):
    """Tested in the slices where particles pin and depin, which the table names."""
    farther, as_fast, slower, text = [], [], [], []
    for discs, here in by_discs(study.curve("3a", setting=setting)):
        weights = [row["visits"] for row in here]
        distance, speed, rate = (
            mean_of(values(here, name), weights).mean for name in ("distance", "speed", "varpi_m")
        )
        words = []
        for name, event in (("residence_begin", "pin"), ("residence_end", "depin")):
            there = nearest_slice(here, here[0][name])
            away, fast = (measured(there, column) for column in ("distance", "speed"))
            slower.append(above(measured(there, "varpi_m"), rate))
            farther.append(above(away, distance))
            as_fast.append(within(fast, (1 - size.SIMILAR) * speed, (1 + size.SIMILAR) * speed))
            words.append(
                f"where they {event} (θ = {there['theta']:.0f}°) {away.mean / distance:.2f} times "
                f"as far and {fast.mean / speed:.2f} times as fast"
            )
        text.append(f"at N = {discs:.0f}, {' and '.join(words)}")
    return combined(every(slower), every(farther), every(as_fast)), (
        f"relative to the centre of mass, compared with the average over θ, {text[0]}; {text[-1]}; "
        "at both angles and "
        f"all N ({len(farther)} cases) |⟨ϖ_M⟩| is certainly below average in {count(slower)}, the "
        f"distance above in {count(farther)}, the speed similar in {count(as_fast)}"
    )


# --- Maps ---------------------------------------------------------------------------------------

MAPS = {ROTATING_N: "2b", COUNTERROTATING_N: "2c"}


def cells_of(study, setting, discs, kind):
    return tables.select(study.table(MAPS[discs]), setting=setting, map=kind)


def layer_densities(study, setting, discs):
    """The number density in the pinned region in the first layer at the wall, between it and the
    second, and in the second."""
    profile = tables.select(study.curve("3a", setting=setting), discs=discs)
    begin, end = profile[0]["residence_begin"], profile[0]["residence_end"]
    radius = DISHES[setting][0]

    def angle(row):
        return math.degrees(math.atan2(row["y"], row["x"])) % 360

    cells = [
        row
        for row in cells_of(study, setting, discs, "density")
        if row["density_error"] >= 0 and (begin - angle(row)) % 360 <= (begin - end) % 360
    ]

    def density(gaps):
        here = [
            row for row in cells if gaps[0] <= radius - math.hypot(row["x"], row["y"]) < gaps[1]
        ]
        # Cells of one run are not independent, so their errors are added, not their squares.
        return Value(
            sum(row["density"] for row in here) / len(here),
            sum(row["density_error"] for row in here) / len(here),
            [profile[0].get("point", "")],
        )

    return [density(gaps) for gaps in (FIRST_LAYER, BETWEEN_LAYERS, SECOND_LAYER)]


def layers(study, setting):
    """At all N that have maps."""
    found = {discs: layer_densities(study, setting, discs) for discs in MAPS}
    return every(
        [
            above(layer - between * (1 + size.LEAST_CHANGE), 0)
            for first, between, second in found.values()
            for layer in (first, second)
        ]
    ), (
        "number density of the centres in the pinned region, per r², at a gap to the wall of "
        f"{FIRST_LAYER[0]:g} to {FIRST_LAYER[1]:g}, {BETWEEN_LAYERS[0]:g} to {BETWEEN_LAYERS[1]:g} "
        f"and {SECOND_LAYER[0]:g} to {SECOND_LAYER[1]:g} radii: "
        + "; ".join(
            f"{', '.join(map(number, densities))} at N = {discs}"
            for discs, densities in found.items()
        )
    )


def similarity(pairs):
    """Σ ab / √(Σ a² Σ b²): 1 for two maps of the same shape, 0 for unrelated ones."""
    pairs = [(a, b) for a, b in pairs if a == a and b == b]
    return sum(a * b for a, b in pairs) / math.sqrt(
        sum(a * a for a, _ in pairs) * sum(b * b for _, b in pairs)
    )


def maps_alike(study):
    """Spheres and discs, cell by cell: the deviation of the density from its mean, and the
    velocity. Both maps have the same cells, in units of the container's radius."""
    found = {}
    for discs in MAPS:
        for kind, columns in (("density", ("density",)), ("flow", ("u_x", "u_y"))):
            spheres, plane = (
                cells_of(study, setting, discs, kind) for setting in ("smooth", "high")
            )
            pairs = []
            for name in columns:
                both = [
                    (a[name], b[name])
                    for a, b in zip(spheres, plane)
                    if a[name] == a[name] and b[name] == b[name]
                ]
                means = [sum(column) / len(both) * (kind == "density") for column in zip(*both)]
                pairs += [(a - means[0], b - means[1]) for a, b in both]
            found[discs, kind] = similarity(pairs)
    return every([above(value, size.MAJORITY) for value in found.values()]), (
        "Correlation of the maps of spheres and discs, cell by cell (qualitatively similar: above "
        f"{size.MAJORITY}): "
        + ", ".join(f"{value:.2f} ({kind}, N = {discs})" for (discs, kind), value in found.items())
        + "."
    )
