"""Claims on the M-frame profiles of Figures 2 and 3: how fast discs move at each angle θ."""

import math

import tables
from paper_parameters import CONTAINER_RADIUS, COUNTERROTATING_N
from verdicts import FAILS, Value, above, below, combined, every, mean_of, measured, within

from .thresholds import (AT_THE_WALL, BETWEEN_LAYERS, FIRST_LAYER, IDENTICAL, LEAST_CHANGE, LEAST_ROTATION,
                         LEAST_VISITS, MAJORITY, NEAR_OMEGA, SECOND_LAYER, SIMILAR)
from .wording import count, ends, monotonic, number, values


def by_discs(profile, least_visits=LEAST_VISITS):
    """(N, slices with more visits than these) in order of N."""
    return [(discs, [row for row in tables.select(profile, discs=discs) if row["visits"] > least_visits])
            for discs in sorted({row["discs"] for row in profile})]


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


def identity(study):
    """Eq. 1, ϖ_M = ϖ − Ω, is a change of frames, not a claim. It checks the measurements: both means are
    averages of the same runs, sampled 511 and 64 times per period."""
    profile, worst = study.table("3a"), 0.0
    try:
        rotation = study.table("1b")
    except FileNotFoundError:
        return ""
    for row in rotation:
        slices = [r for r in tables.select(profile, discs=row["discs"]) if r["visits"] > 0]
        total = sum(r["visits"] for r in slices)
        if not total:
            continue
        mean = sum(r["visits"] * r["varpi_m"] for r in slices) / total
        worst = max(worst, abs(mean + 1 - row["by_time"]))
    agreement = "as they must" if worst < IDENTICAL else "which they must not"
    return (f" Eq. 1, ϖ_M = ϖ − Ω, is an identity and not counted as a claim: ⟨ϖ_M⟩ + Ω of these profiles and "
            f"ϖ of the same runs differ by at most {worst:.2g} Ω, {agreement}.")


def clockwise(study):
    rows = [row for row in study.table("3a") if row["visits"] > LEAST_VISITS]
    negative = [below(v, -LEAST_ROTATION) for v in values(rows, "varpi_m")]
    fastest = max(rows, key=lambda row: row["varpi_m"])
    return every(negative), (
        f"⟨ϖ_M⟩ is certainly negative in {count(negative)} of {len(rows)} slices of θ and N, certainly positive "
        f"in {count(negative, FAILS)}; the highest is {number(measured(fastest, 'varpi_m'))} Ω.{identity(study)}")


# --- The pinned and the loose region ------------------------------------------------------------

def pinned_means(study, table, name):
    """The mean over the pinned region, a row for each N."""
    result = []
    for discs, slices in by_discs(study.table(table), least_visits=0):
        here = [row for row in pinned_slices(slices) if row[name] == row[name] and
                row[name + "_error"] == row[name + "_error"]] if slices else []
        if here:
            mean = mean_over_slices(here, name)
            result.append({"discs": discs, "mean": mean.mean, "mean_error": mean.error,
                           "point": here[0].get("point")})
    return result


def pinned_reach_wall(study):
    rows = pinned_means(study, "3b", "normalised")
    first, last = measured(rows[0], "mean"), measured(rows[-1], "mean")
    return combined(below(first, 1 - AT_THE_WALL), within(last, 1 - AT_THE_WALL, 1 + AT_THE_WALL)), (
        f"Normalised angular velocity in the pinned region: {ends(rows, 'mean')} (slower than the wall, or equal: "
        f"by {AT_THE_WALL}).")


def pinned_faster(study):
    rows = pinned_means(study, "3a", "varpi_m")
    judgement, reversal = monotonic(rows, "mean", falling=True, least=NEAR_OMEGA)
    return judgement, (f"⟨ϖ_M⟩/Ω in the pinned region: {ends(rows, 'mean')}{reversal} (required: a change of more "
                       f"than {NEAR_OMEGA}).")


def loose_peak(study):
    peaks = [(discs, min(rows, key=lambda row: row["varpi_m"])) for discs, rows in by_discs(study.table("3a"))]
    heights = [-measured(row, "varpi_m") for _, row in peaks]
    mean = mean_of(heights).mean
    similar = [within(h, (1 - SIMILAR) * mean, (1 + SIMILAR) * mean) for h in heights]
    scatter = max(abs(h.mean - mean) for h in heights) / mean
    return every(similar), (
        f"Highest |⟨ϖ_M⟩|: {heights[0].mean:.2f} Ω at θ = {peaks[0][1]['theta']:.0f}° for N = {peaks[0][0]:.0f}, "
        f"{heights[-1].mean:.2f} Ω at {peaks[-1][1]['theta']:.0f}° for N = {peaks[-1][0]:.0f}; within "
        f"{100 * scatter:.0f} % of their mean at all N (required: {100 * SIMILAR:.0f} %).")


def pinned_contribution(study):
    """Contributions to the difference of ⟨ϖ_M⟩ between few and many discs. ⟨ϖ_M⟩ = p P + (1 − p) L, with
    the share p of the visits to the pinned region and the means P there and L in the loose region. Each of the three changes,
    and the changes add up exactly if each is multiplied by the mean of the other factor at both ends."""
    profile = by_discs(study.table("3a"), least_visits=0)
    found = []
    for _, here in (profile[0], profile[-1]):
        pinned = pinned_slices(here)
        loose = [row for row in here if row not in pinned]
        share = sum(row["visits"] for row in pinned) / sum(row["visits"] for row in here)
        found.append((share, mean_over_slices(pinned, "varpi_m"), mean_over_slices(loose, "varpi_m")))
    (few, pinned_few, loose_few), (many, pinned_many, loose_many) = found
    share = (few + many) / 2
    by_pinned = (pinned_many - pinned_few) * share
    by_loose = (loose_many - loose_few) * (1 - share)
    by_share = ((pinned_few.mean + pinned_many.mean) - (loose_few.mean + loose_many.mean)) / 2 * (many - few)
    return [discs for discs, _ in profile], by_pinned, by_loose, by_share


def pinned_decides(study):
    numbers, pinned, loose, share = pinned_contribution(study)
    total = pinned.mean + loose.mean + share
    # More than half of the whole: more than everything else, with the sign of the whole.
    sign = -1 if total < 0 else 1
    lead = (pinned - loose - share) * sign
    return above(lead, (2 * MAJORITY - 1) * abs(total)), (
        f"From N = {numbers[0]:.0f} to {numbers[-1]:.0f} ⟨ϖ_M⟩/Ω changes by {number(Value(total))}: by "
        f"{number(pinned)} because pinned discs are faster, by {number(loose)} because loose discs are, and by "
        f"{number(Value(share))} because more discs are pinned (major contributor: more than {MAJORITY:.0%}).")


def loose_accelerate(study):
    gains, text = [], []
    for discs, here in by_discs(study.table("3a")):
        pinned = pinned_slices(here)
        loose = [row for row in here if row not in pinned]
        released = measured(nearest_slice(here, here[0]["residence_end"]), "speed")
        fastest = max(loose, key=lambda row: row["speed"])
        gains.append(above(measured(fastest, "speed") - released, LEAST_CHANGE * released.mean))
        text.append(f"{number(released)} where they depin and {number(measured(fastest, 'speed'))} at θ = "
                    f"{fastest['theta']:.0f}° for N = {discs:.0f}")
    return every(gains), (
        "Speed relative to the centre of mass in the M-frame, in units of the container's speed: "
        f"{text[0]}; {text[-1]}. Faster by more than {LEAST_CHANGE:.0%} for certain at {count(gains)} of "
        f"{len(gains)} N.")


def oblong(study):
    """Tested in the slices where discs pin and depin, which the table names."""
    farther, as_fast, slower, text = [], [], [], []
    for discs, here in by_discs(study.table("3a")):
        weights = [row["visits"] for row in here]
        distance, speed, rate = (mean_of(values(here, name), weights).mean
                                 for name in ("distance", "speed", "varpi_m"))
        words = []
        for name, event in (("residence_begin", "pin"), ("residence_end", "depin")):
            there = nearest_slice(here, here[0][name])
            away, fast = (measured(there, column) for column in ("distance", "speed"))
            slower.append(above(measured(there, "varpi_m"), rate))
            farther.append(above(away, distance))
            as_fast.append(within(fast, (1 - SIMILAR) * speed, (1 + SIMILAR) * speed))
            words.append(f"where they {event} (θ = {there['theta']:.0f}°) {away.mean / distance:.2f} times as "
                         f"far and {fast.mean / speed:.2f} times as fast")
        text.append(f"at N = {discs:.0f}, {' and '.join(words)}")
    return combined(every(slower), every(farther), every(as_fast)), (
        f"Discs relative to the centre of mass, compared with the average over θ: {text[0]}; {text[-1]}. At both "
        f"angles and all N ({len(farther)} cases): |⟨ϖ_M⟩| below average for certain in {count(slower)}, farther "
        f"in {count(farther)}, as fast within {100 * SIMILAR:.0f} % in {count(as_fast)}.")


def layers(study):
    """The number density in the pinned region against the gap to the wall."""
    discs = tables.select(study.table("3a"), discs=COUNTERROTATING_N)
    begin, end = discs[0]["residence_begin"], discs[0]["residence_end"]

    def angle(row):
        return math.degrees(math.atan2(row["y"], row["x"])) % 360
    cells = [row for row in study.table("2c") if row["map"] == "density" and row["density_error"] >= 0
             and (begin - angle(row)) % 360 <= (begin - end) % 360]

    def density(gaps):
        here = [row for row in cells
                if gaps[0] <= CONTAINER_RADIUS - math.hypot(row["x"], row["y"]) < gaps[1]]
        # Cells of one run are not independent, so their errors are added, not their squares.
        return Value(sum(row["density"] for row in here) / len(here),
                     sum(row["density_error"] for row in here) / len(here), [discs[0].get("point", "")])
    first, between, second = (density(gaps) for gaps in (FIRST_LAYER, BETWEEN_LAYERS, SECOND_LAYER))
    return every([above(layer - between * (1 + LEAST_CHANGE), 0) for layer in (first, second)]), (
        f"Number density of the centres in the pinned region at N = {COUNTERROTATING_N}, per r²: {number(first)} "
        f"at a gap of {FIRST_LAYER[0]:g} to {FIRST_LAYER[1]:g} radii to the wall, {number(between)} at "
        f"{BETWEEN_LAYERS[0]:g} to {BETWEEN_LAYERS[1]:g}, {number(second)} at {SECOND_LAYER[0]:g} to "
        f"{SECOND_LAYER[1]:g} (layers: denser by {LEAST_CHANGE:.0%}).")
