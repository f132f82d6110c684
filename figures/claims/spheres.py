"""Claims on the experiment, judged by spheres that roll on a floor.

The friction coefficient of the experiment's spheres is unknown. A claim therefore holds if it holds for at
least one of the friction coefficients that were run.
"""

import math

import tables
from paper_parameters import EXPERIMENT_N, ROUGH_CHANGE_N, SMOOTH_CHANGE_N
from verdicts import FAILS, HOLDS, above, below, combined, either, every, falls, measured, within

from .contacts import closer_to_one
from .rotation import after_minimum, one_passage
from .study import crossing_value, crossing_words
from .thresholds import (ABOUT_HALF, ALMOST_ALL, DENSE_SPHERES, FEW, HIGH_N, INDUCED, JUMP, LEAST_ROTATION,
                         LEAST_SLIP_RISE, MAJORITY, NEARLY_ONE, NEAR_OMEGA, ONE_DISC, PLASTIC, ROUGHER, ROUGHLY,
                         SLIGHT_DROP)
from .wording import count, ends, known, monotonic, number, value_at, values


def spheres_at(study, figure, curve, discs):
    """ϖ/Ω by time of one curve at one N."""
    rows = [row for row in study.table(figure) if str(row["curve"]) == curve and row["discs"] == discs]
    return measured(rows[0], "by_time")


def dense_spheres(study, figure, curve):
    return [spheres_at(study, figure, curve, discs) for discs in DENSE_SPHERES]


def counterrotate(rotations):
    return every([below(v, -LEAST_ROTATION) for v in rotations])


def at_dense(rotations):
    return ", ".join(f"{number(v)} at N = {n}" for v, n in zip(rotations, DENSE_SPHERES))


def for_some_friction(study, figure, judge):
    """`judge` gets the rows of one friction coefficient and returns its judgement and words."""
    judged = [(mu, *judge(study.curve(figure, last=math.inf, mu=mu)))
              for mu in sorted({row["mu"] for row in study.table(figure)})]
    found = [judgement for _, judgement, _ in judged]
    text = "; ".join(f"μ = {mu:g}: {words}" for mu, _, words in judged)
    return either(found), f"{text}. It holds for {count(found)} of {len(found)} friction coefficients"


def of_pinned_spheres(judge):
    """A claim about the pinned spheres, judged by the rows of one friction coefficient."""
    def judge_study(study):
        judgement, text = for_some_friction(study, "spheres_pinned", judge)
        return judgement, f"Spheres, {text}."
    return judge_study


# --- The change of direction --------------------------------------------------------------------

def spheres_transition(study):
    def judge(rows):
        dense = [row for n in DENSE_SPHERES for row in rows if row["discs"] == n]
        if len(dense) < len(DENSE_SPHERES):
            raise IndexError("a number of spheres is missing")
        return (every([above(measured(rows[0], "by_time"), LEAST_ROTATION), counterrotate(values(dense, "by_time"))]),
                ", ".join(value_at(row, "by_time") for row in [rows[0], *dense]))

    judgement, text = for_some_friction(study, "spheres", judge)
    return judgement, f"ϖ/Ω with their real moment of inertia: {text}."


def last_changes(study):
    """{friction coefficient: N of the last change to counterrotation}; from there on all spheres counterrotate.
    If signs beyond it are undetermined, the last change lies between it and the last of them."""
    table, points = study.table("spheres_direction"), study.table("spheres")
    found = {}
    for row in tables.select(table, direction="counterrotation"):
        beyond = [other["after"] for other in tables.select(table, direction="undetermined", mu=row["mu"])
                  if other["before"] >= row["after"]]
        if beyond:
            row = {**row, "crossing": math.nan, "lower": row["before"], "upper": max(beyond)}
        near = {p["point"] for p in points
                if p["mu"] == row["mu"] and row["before"] <= p["discs"] <= row["after"]}
        found[row["mu"]] = crossing_value(row, near)
        found[row["mu"]].words = crossing_words(row)
    return found


def changes_in_words(changes):
    return "N of the last change to counterrotation, " + "; ".join(f"μ = {mu:g}: {at.words}" for mu, at in changes)


def changes_near(changes, discs):
    """[(friction coefficient, judgement)]: whether the change is near this N, for the coefficients that were
    run and for a coefficient between two of them. If the N of two
    neighbouring coefficients differ by more than JUMP, the last change jumps with the friction coefficient, and
    no coefficient in between has it near this N."""
    runs = [(mu, within(at, discs - ROUGHLY, discs + ROUGHLY)) for mu, at in changes]
    between = [((low + high) / 2, every([above(smooth, discs), below(rough, discs)]))
               for (low, smooth), (high, rough) in zip(changes, changes[1:])
               if abs(smooth.mean - rough.mean) <= JUMP]
    return sorted(runs + between, key=lambda found: found[0])


def jumps(changes):
    return "".join(
        f"; between μ = {low:g} and {high:g} it jumps from {number(a)} to {number(b)}, which does not determine the N "
        "between" for (low, a), (high, b) in zip(changes, changes[1:]) if abs(a.mean - b.mean) > JUMP)


def spheres_change_near(discs):
    def judge(study):
        changes = sorted(last_changes(study).items())
        return either(judgement for _, judgement in changes_near(changes, discs)), (
            f"{changes_in_words(changes)}{jumps(changes)} (roughly: within {ROUGHLY:.0f} of {discs}; the friction "
            "coefficient of the spheres is unknown).")
    return judge


def spheres_roughened(study):
    """One friction coefficient for the smooth spheres, and a higher one for the same spheres after sanding."""
    changes = sorted(last_changes(study).items())
    smooth, rough = (changes_near(changes, discs) for discs in (SMOOTH_CHANGE_N, ROUGH_CHANGE_N))

    def in_words(found):
        certain = [f"{mu:g}" for mu, judgement in found if judgement.verdict == HOLDS]
        return "μ = " + " or ".join(certain) if certain else "no friction coefficient for certain"
    return either(every([a, b]) for low, a in smooth for high, b in rough if high > low), (
        f"{changes_in_words(changes)}{jumps(changes)}. Smooth, {SMOOTH_CHANGE_N}: {in_words(smooth)}; rough, "
        f"{ROUGH_CHANGE_N}: {in_words(rough)} (within {ROUGHLY:.0f}).")


def spheres_friction_order(study):
    changes = sorted(last_changes(study).items())
    return falls([at for _, at in changes], ONE_DISC), f"{changes_in_words(changes)}."


def spheres_minimum(study):
    def judge(rows):
        lowest, last, rise = after_minimum(rows, "by_time")
        return (every([below(measured(lowest, "by_time"), -LEAST_ROTATION), above(rise, SLIGHT_DROP)]),
                f"lowest before the end {value_at(lowest, 'by_time')}, at the end {value_at(last, 'by_time')}")

    judgement, text = for_some_friction(study, "spheres", judge)
    return judgement, f"ϖ/Ω: {text}."


def spheres_passage(study):
    def judge(rows):
        rows = [row for row in rows if EXPERIMENT_N[0] <= row["discs"] <= EXPERIMENT_N[1]]
        found = values(rows, "by_time")
        return one_passage(found), (
            f"certainly rotating at {count([above(v, LEAST_ROTATION) for v in found])}, certainly counterrotating at "
            f"{count([below(v, -LEAST_ROTATION) for v in found])} of {len(rows)} N")

    judgement, text = for_some_friction(study, "spheres", judge)
    return judgement, f"N = {EXPERIMENT_N[0]} to {EXPERIMENT_N[1]}, {text}."


def snake(study):
    """Main text, first page; the experiment itself has 24 spheres or more."""
    rows = [row for row in study.table("spheres_few") if row["discs"] <= FEW]
    found = [every([within(measured(row, "by_time"), 1 - NEAR_OMEGA, 1 + NEAR_OMEGA),
                    above(measured(row, "residence_share"), ALMOST_ALL)]) for row in rows]
    return either(found), (
        "After a long warm-up, ϖ/Ω and the share of the spheres that reside at the wall: " + "; ".join(
            f"{number(measured(row, 'by_time'))} and {value_at(row, 'residence_share')}" for row in rows) +
        f" (μ = {PLASTIC:g}). A line that rolls with the swirl has ϖ/Ω within {NEAR_OMEGA} of 1 and a share above "
        f"{ALMOST_ALL}.")


# --- What causes counterrotation ----------------------------------------------------------------

def frustrated(study, name, full, ending):
    """At one friction coefficient: do dense spheres counterrotate, and is ϖ higher without vertical friction?"""
    curves = [dense_spheres(study, name, curve)
              for curve in (full, *(f"no-vertical{where}{ending}" for where in ("", "-disc", "-wall")))]
    text = "; ".join(f"{words}: {at_dense(found)}" for words, found in zip(
        ("all ingredients", "without vertical friction", "without it between spheres only",
         "without it at the wall only"), curves))
    with_it, without = curves[0], curves[1]
    rotate = {HOLDS: "certainly rotate", FAILS: "do not all rotate"}.get(
        every([above(v, LEAST_ROTATION) for v in without]).verdict, "perhaps rotate")
    return combined(counterrotate(with_it),
                    every([above(free - v * (1 - INDUCED), 0) for v, free in zip(with_it, without)])), (
        f"ϖ/Ω with {text}; without vertical friction they {rotate}")


def spheres_frustration(study):
    found = [(f"{PLASTIC:g}", *frustrated(study, "spheres_ingredients", f"{PLASTIC:g}", ""))]
    try:
        found.append((f"{ROUGHER:g}", *frustrated(study, "spheres_ingredients_rough", f"{ROUGHER:g}", "-rough")))
    except FileNotFoundError:
        pass  # this figure was not requested
    text = ". ".join(f"μ = {mu}: {words}" for mu, _, words in found)
    return either([judgement for _, judgement, _ in found]), (
        f"{text} (induced by it: more than {INDUCED:.0%} of the counterrotation disappears). That spheres rotate "
        "without it is not a claim of the paper. Discs have no such friction; for them the moment of inertia "
        f"decides{inertia_sentence(study)}.")


def inertia_sentence(study):
    """Where discs with several moments of inertia change their direction, if it was run."""
    try:
        rows = study.table("inertia_crossings")
    except FileNotFoundError:
        return ""
    names = [f"{row['curve']:g}" for row in rows]
    return ": " + "; ".join(f"I = {name}: {study.crossing('inertia', name).text}" for name in names)


def spheres_elastic(study):
    found = dense_spheres(study, "spheres_ingredients", "no-damping")
    return counterrotate(found), f"With e = 1, and the same floor: ϖ/Ω = {at_dense(found)}."


def substrate(study):
    """An ingredient is critical if spheres counterrotate with it and do not once it alone is removed."""
    curves = {"all ingredients": f"{PLASTIC:g}", "no floor": "no-floor",
              "no friction of rolling (vertical)": "no-vertical", "no damping": "no-damping"}
    found = {words: dense_spheres(study, "spheres_ingredients", curve) for words, curve in curves.items()}
    judged = {words: counterrotate(rotations) for words, rotations in found.items()}
    full = judged.pop("all ingredients")
    return combined(*(every([full, judgement]) for judgement in judged.values())), (
        "Spheres with their own moment of inertia, ϖ/Ω: " +
        "; ".join(f"{words}: {at_dense(rotations)}" for words, rotations in found.items()) +
        ". An ingredient is not critical if spheres counterrotate without it. The paper's discs counterrotate "
        "without a floor, but with I = 10 m r², which no disc or sphere has.")


# --- The pinned spheres -------------------------------------------------------------------------

def spin_falls(rows):
    rows = known(rows, "resident_spin")
    judgement, reversal = monotonic(rows, "resident_spin", falling=True)
    return judgement, (f"|ω_z|/Ω of those that reside at the wall {ends(rows, 'resident_spin')}{reversal}, of those "
                       f"pinned there by the SI's criterion {ends(rows, 'pinned_wall_spin')}")


def slip_from_a_half(rows):
    judgement, reversal = monotonic(rows, "slip_resident", least=LEAST_SLIP_RISE)
    half = [within(measured(row, "slip_resident"), 0.5 - ABOUT_HALF, 0.5 + ABOUT_HALF)
            for row in rows if abs(row["discs"] - 25) <= ROUGHLY]
    return combined(judgement, either(half), above(measured(rows[-1], "slip_resident"), NEARLY_ONE)), (
        f"{ends(rows, 'slip_resident')}{reversal}, of all pinned by the SI's criterion {ends(rows, 'pinned_region')}")


def spheres_slip(study):
    judgement, text = for_some_friction(study, "spheres_pinned", slip_from_a_half)
    return judgement, (f"s of those that reside at the wall, {text} (approximately 0.5: within {ABOUT_HALF}; nearly 1: "
                       f"above {NEARLY_ONE}).")


def spheres_slip_rough(study):
    coefficients = sorted({row["mu"] for row in study.table("spheres_pinned")})
    smooth, rough = (study.curve("spheres_pinned", last=math.inf, mu=mu)
                     for mu in (coefficients[0], coefficients[-1]))
    judgement, found = closer_to_one(rough, smooth)
    return judgement, (f"s of those that reside at the wall is closer to 1 for μ = {coefficients[-1]:g} than for μ = "
                       f"{coefficients[0]:g}, {found}.")


def spheres_prevented_from_rolling(study):
    """At high N, fewer than half of the spheres at the wall must roll. That fewer roll there than elsewhere does
    not suffice, if most do."""
    def judge(rows):
        wall = {row["discs"]: measured(row, "wall_rolling_share") for row in rows}
        excess = {row["discs"]: measured(row, "rolling_share") - wall[row["discs"]] for row in rows}
        few, many = rows[0]["discs"], rows[-1]["discs"]
        return every([below(share, MAJORITY) for discs, share in wall.items() if discs >= HIGH_N]), (
            ", ".join(f"{number(share)} at N = {discs:.0f}" for discs, share in wall.items()) +
            f"; of all spheres more roll, by {number(excess[few])} at N = {few:.0f} and {number(excess[many])} at "
            f"{many:.0f}")

    judgement, text = for_some_friction(study, "spheres_pinned", judge)
    return judgement, f"Share of the spheres at the wall that roll (prevented: below {MAJORITY}): {text}."
