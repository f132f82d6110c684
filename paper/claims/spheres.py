"""Claims on the experiment that need figures of the spheres: where the direction changes, and what
causes it.

One friction coefficient of all contacts is fitted to the N_c of the smooth spheres, and one to that
of the roughened ones. That such coefficients exist is a result; that N_c is then 36 and 28 is not.
"""

from paper import tables
from paper.paper_parameters import ROUGH_CHANGE_N, SMOOTH_CHANGE_N
from paper.verdicts import above, any_holds, below, combined, every, falls, measured, within

from paper.claims import contacts
from paper.claims import thresholds as size
from paper.claims.rotation import elastic
from paper.claims.settings import WORDS, capital
from paper.claims.study import crossing_value, crossing_words
from paper.claims.thresholds import DENSE_SPHERES, FEW, JUMP
from paper.claims.wording import ends, number, value_at


# --- The change of direction --------------------------------------------------------------------


def changes(study, curve="experiment"):
    """[(μ, N_c with its words)] in order of μ, of the coefficients with a change of direction."""
    found = []
    for row in sorted(
        tables.select(study.table("spheres_friction"), curve=curve), key=lambda row: row["mu"]
    ):
        if row["crosses"]:
            found.append((row["mu"], crossing_value(row)))
            found[-1][1].words = crossing_words(row)
    return found


def changes_in_words(found):
    return (
        "; ".join(f"μ = {mu:g}: {at.words}" for mu, at in found) or "no change of direction"
    ) + "".join(
        f"; between μ = {low:g} and {high:g} it jumps"
        for (low, a), (high, b) in zip(found, found[1:])
        if abs(a.mean - b.mean) > JUMP
    )


def changes_near(found, discs):
    """[(friction coefficient, judgement)]: whether the change is near this N, for the coefficients
    that were run and for a coefficient between two of them. If the N of two neighbouring
    coefficients differ by more than JUMP, the change jumps with the friction coefficient, and no
    coefficient in between has it near this N."""
    runs = [(mu, within(at, discs - size.ROUGHLY, discs + size.ROUGHLY)) for mu, at in found]
    between = [
        ((low + high) / 2, every([above(smooth, discs), below(rough, discs)]))
        for (low, smooth), (high, rough) in zip(found, found[1:])
        if abs(smooth.mean - rough.mean) <= JUMP
    ]
    return sorted(runs + between, key=lambda near: near[0])


def fitted(study, discs):
    """The fitted coefficient, in words."""
    try:
        row = tables.select(
            study.table("spheres_friction_calibration"), curve="experiment", discs=discs
        )[0]
    except (FileNotFoundError, IndexError):
        return "n/a"
    return number(measured(row, "mu"))


def nc_of_all(study):
    """N_c against μ, with the same at half the amplitude."""
    half = changes(study, "A5.75")
    return (
        "N_c of spheres with one friction coefficient for all contacts: "
        f"{changes_in_words(changes(study))}"
        + (f". At A = 5.75 mm: {changes_in_words(half)}" if half else "")
    )


def change_near_36(study):
    return any_holds(judgement for _, judgement in changes_near(changes(study), SMOOTH_CHANGE_N)), (
        f"The coefficient with N_c = {SMOOTH_CHANGE_N} is μ = {fitted(study, SMOOTH_CHANGE_N)}. It "
        "is fitted, since the paper "
        "gives no friction coefficient: the claim holds if any coefficient has this N_c "
        f"(roughly: within {size.ROUGHLY:.0f}). {nc_of_all(study)}."
    )


def roughened(study):
    """One friction coefficient for the smooth spheres, and a higher one for the same spheres after
    sanding."""
    smooth, rough = (
        changes_near(changes(study), discs) for discs in (SMOOTH_CHANGE_N, ROUGH_CHANGE_N)
    )
    return any_holds(every([a, b]) for low, a in smooth for high, b in rough if high > low), (
        f"Fitted: μ = {fitted(study, SMOOTH_CHANGE_N)} for N_c = {SMOOTH_CHANGE_N}, μ = "
        f"{fitted(study, ROUGH_CHANGE_N)} for {ROUGH_CHANGE_N} (within {size.ROUGHLY:.0f}). "
        f"{nc_of_all(study)}."
    )


def friction_order(study):
    """For all friction coefficients, not only the two that are fitted."""
    found = falls([at for _, at in changes(study)], size.ONE_DISC)
    try:
        low, high = (study.crossing("4c", name).text for name in ("low", "high"))
        discs = f" Discs, μ = 0.1: {low}; μ = 1: {high}."
    except (FileNotFoundError, IndexError):
        discs = ""
    return found, f"{nc_of_all(study)}.{discs}"


def snake(study):
    """Main text, first page; the experiment itself has 24 spheres or more."""
    rows = [row for row in study.table("spheres_few") if row["discs"] <= FEW]
    found = [
        every(
            [
                within(measured(row, "mean_by_time"), 1 - size.NEAR_OMEGA, 1 + size.NEAR_OMEGA),
                above(measured(row, "residence_share"), size.ALMOST_ALL),
            ]
        )
        for row in rows
    ]
    return any_holds(found), (
        "After a long warm-up, ϖ/Ω and the share of the spheres that reside at the wall: "
        + "; ".join(
            f"{number(measured(row, 'mean_by_time'))} and {value_at(row, 'residence_share')}"
            for row in rows
        )
        + f". A line that rolls with the swirl has ϖ/Ω within {size.NEAR_OMEGA} of 1 and a share "
        f"above {size.ALMOST_ALL}."
    )


# --- What causes counterrotation ----------------------------------------------------------------


def ingredient(study, curve):
    """{N: ϖ/Ω by time} of one curve of smooth spheres."""
    rows = tables.select(study.table("spheres_ingredients"), curve=curve)
    return {
        row["discs"]: measured(row, "mean_by_time")
        for row in rows
        if row["mean_by_time"] == row["mean_by_time"]
    }


def dense(curve):
    return [curve[discs] for discs in DENSE_SPHERES]


def counterrotate(rotations):
    return every([below(v, -size.LEAST_ROTATION) for v in rotations])


def at_dense(curve):
    return ", ".join(f"{number(v)} at N = {n}" for v, n in zip(dense(curve), DENSE_SPHERES))


# Spins, friction, the sign that the rotation must have, and words: runs of figure "cause". Spheres
# have a floor, too, so the wall is tested without friction between them.
WITHOUT_BETWEEN = (
    (
        "free",
        "none between particles",
        1,
        "particles without friction between them, which stops no spin",
    ),
    ("stopped", "none between particles", -1, "the same, if they cannot spin"),
)
EXPERIMENTS = {
    "discs": (
        *WITHOUT_BETWEEN,
        ("stopped", "none at the wall", 1, "discs that cannot spin, at a smooth wall"),
    ),
    "spheres": (*WITHOUT_BETWEEN, ("stopped", "none at all", 1, "the last, at a smooth wall")),
}


def stopped_spins(study, body):
    """Do stopped spins reverse the cluster, and nothing else? At the largest N of figure
    "cause"."""
    judgements, words = [], []
    for spins, friction, sign, meaning in EXPERIMENTS[body]:
        row = study.curve("cause", body=body, spins=spins, contacts=friction)[-1]
        value = measured(row, "mean_by_time")
        judgements.append(above(value, 0) if sign > 0 else below(value, 0))
        words.append(f"{meaning}: {value_at(row, 'mean_by_time')}")
    return every(judgements), "; ".join(words)


def frustration(study):
    """The title, in two parts. Stopped spins induce counterrotation, for discs and spheres. What
    stops them is geometric frustration: pairs that no triangle frustrates turn like gears, and
    pairs in triangles do not."""
    judgements, text = [], []
    for body in ("discs", "spheres"):
        induces, words = stopped_spins(study, body)
        judgements.append(induces)
        text.append(
            f"{capital(body)}: stopped spins induce counterrotation (ϖ/Ω of {words}): "
            f"{induces.verdict}."
        )
    for setting in ("smooth", "rough", "high"):
        rows = study.curve("4b", setting=setting)
        free, caught = (
            contacts.gears(study, setting)[0],
            contacts.triangles_frustrate(study, setting)[0],
        )
        judgements += [free, caught]
        text.append(
            f"{capital(WORDS[setting])}: pairs in no triangle have opposed spins (correlation "
            f"{ends(rows, 'chain_correlation')}): {free.verdict}; pairs in triangles have no order "
            f"({ends(rows, 'triangle_correlation')}): {caught.verdict}."
        )
    return combined(*judgements), (
        f"{' '.join(text)} (Opposed: below {number(size.ANTIFERROMAGNETIC)}; no order: within "
        f"±{-size.ANTIFERROMAGNETIC:.3f}; induced: the sign of ϖ.) "
        f"Where discs change their direction depends on their inertia{inertia_sentence(study)}."
    )


def inertia_sentence(study):
    """Where discs with several moments of inertia change their direction, if it was run."""
    try:
        rows = study.table("inertia_crossings")
    except FileNotFoundError:
        return ""
    names = [f"{row['curve']:g}" for row in rows]
    return ": " + "; ".join(f"I = {name}: {study.crossing('inertia', name).text}" for name in names)


def no_damping(study):
    found = ingredient(study, "no-damping")
    discs, text = elastic(study)
    return combined(counterrotate(dense(found)), discs), (
        f"Smooth spheres with e = 1: ϖ/Ω = {at_dense(found)}. Discs with μ = 1, {text}"
    )


def substrate(study):
    """An ingredient is critical if spheres counterrotate with it and do not once it alone is
    removed."""
    curves = {
        "all ingredients": "all",
        "no floor": "no-floor",
        "no friction of rolling (vertical)": "no-vertical",
        "no damping": "no-damping",
    }
    found = {words: ingredient(study, curve) for words, curve in curves.items()}
    judged = {words: counterrotate(dense(rotations)) for words, rotations in found.items()}
    full = judged.pop("all ingredients")
    return combined(*(every([full, judgement]) for judgement in judged.values())), (
        "Smooth spheres, ϖ/Ω: "
        + "; ".join(f"{words}: {at_dense(rotations)}" for words, rotations in found.items())
        + ". An ingredient is not critical if spheres counterrotate without it. The paper's discs "
        "counterrotate without a floor, but with I = 10 m r², which no disc or sphere has."
    )
