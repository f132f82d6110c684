"""Claims on ϖ(N): Figures 1b, 4c and 5b. Judges of claims on Figures 1 to 4 get the setting of the
runs (settings.py)."""

import math

from paper.paper_parameters import EXPERIMENT_N, LAST_N
from paper.verdicts import (
    FAILS,
    HOLDS,
    UNDECIDED,
    Judgement,
    Value,
    above,
    below,
    combined,
    any_holds,
    every,
    fact,
    mean_of,
    measured,
    within,
)

from paper.claims import thresholds as size
from paper.claims.settings import SPHERES, rotation_rows
from paper.claims.thresholds import HIGH_N, LEVEL_FROM, MOST_RUNS
from paper.claims.wording import count, ends, known, number, value_at, values


def transition(study, setting):
    rows, rate = rotation_rows(study, setting, LAST_N)
    crossing = study.crossing("spheres" if setting in SPHERES else "5b", setting)
    return (
        combined(
            above(measured(rows[0], rate), size.LEAST_ROTATION),
            crossing.crosses,
            below(measured(rows[-1], rate), -size.LEAST_ROTATION),
        ),
        f"{crossing.text}; ϖ/Ω = {ends(rows, rate)}",
    )


def simulated_transition(study):
    judgement, text = transition(study, "high")
    return judgement, f"{text} (μ = 1; rotation: more than {size.LEAST_ROTATION} Ω)."


def after_minimum(rows, name):
    """The row of the lowest point before the last, the last row, and the rise between them:
    negative if the curve falls to its end."""
    rows = known(rows, name)
    lowest, last = min(rows[:-1], key=lambda row: row[name]), rows[-1]
    return lowest, last, measured(last, name) - measured(lowest, name)


def minimum(study, setting):
    """The paper's mean over the particles is judged. In it every particle has the same weight, and
    those near the centre of mass have the highest angular velocities. N beyond the paper's last one
    count."""
    rows, rate = rotation_rows(study, setting)
    lowest, last, rise = after_minimum(rows, rate)
    text = (
        f"ϖ/Ω is lowest before the end with {value_at(lowest, rate)}, and at the end "
        f"{value_at(last, rate)}, higher by {number(rise)}"
    )
    rigid = rate.replace("mean", "rigid")
    if all(rigid in row for row in rows):
        rigid_lowest, rigid_last, rigid_rise = after_minimum(rows, rigid)
        trend = {
            HOLDS: "also rises",
            FAILS: "falls to the end",
            UNDECIDED: "neither certainly rises nor certainly falls",
        }[above(rigid_rise, 0).verdict]
        text += (
            f"; that of a rigid body, Σ r × v / Σ r², {trend}, from "
            f"{value_at(rigid_lowest, rigid)} to "
            f"{value_at(rigid_last, rigid)}"
        )
    return (
        every([below(measured(lowest, rate), -size.LEAST_ROTATION), above(rise, size.SLIGHT_DROP)]),
        text,
    )


def one_passage(found):
    """From rotation to counterrotation once: below some number of particles none counterrotates,
    and from it on none rotates."""
    return any_holds(
        every(
            [above(v, -size.LEAST_ROTATION) for v in found[:k]]
            + [below(v, size.LEAST_ROTATION) for v in found[k:]]
        )
        for k in range(1, len(found))
    )


def stalls(value):
    """ϖ is zero within its error, and this error is small: such a cluster does not rotate."""
    if abs(value.mean) <= value.margin and value.error < size.LEAST_ROTATION:
        return fact(True)
    return within(value, -size.LEAST_ROTATION, size.LEAST_ROTATION)


def passage(study, setting):
    """In the range of the experiment: one passage, and an N in it where the cluster stalls."""
    rows, rate = rotation_rows(study, setting, LAST_N)
    rows = [row for row in rows if row["discs"] >= EXPERIMENT_N[0]]
    found = values(rows, rate)
    rotating = [
        row for row in rows if above(measured(row, rate), size.LEAST_ROTATION).verdict == HOLDS
    ]
    against = [
        row for row in rows if below(measured(row, rate), -size.LEAST_ROTATION).verdict == HOLDS
    ]
    still = [row for row in rows if stalls(measured(row, rate)).verdict == HOLDS]
    return combined(one_passage(found), any_holds(stalls(v) for v in found)), (
        f"certainly rotating at {len(rotating)} N, the last of them {last_of(rotating)}, certainly "
        f"counterrotating at {len(against)}, the first of them {last_of(against[:1])}; stalling at "
        f"{', '.join(value_at(row, rate) for row in still) or 'none'}"
    )


def last_of(rows):
    return f"{rows[-1]['discs']:.0f}" if rows else "n/a"


def couple(study, setting):
    """ "Changes sign with the addition of a couple of marbles": from certain rotation to certain
    counterrotation."""
    rows, rate = rotation_rows(study, setting)
    rotating = [
        row["discs"]
        for row in rows
        if above(measured(row, rate), size.LEAST_ROTATION).verdict == HOLDS
    ]
    against = [
        row["discs"]
        for row in rows
        if below(measured(row, rate), -size.LEAST_ROTATION).verdict == HOLDS
    ]
    pairs = [(m - n, n, m) for n in rotating for m in against if m > n]
    if not pairs:
        return (
            Judgement(UNDECIDED, [row["point"] for row in rows if "point" in row]),
            "no change of sign is certain",
        )
    added, few, many = min(pairs)
    points = [row["point"] for row in rows if few < row["discs"] < many and "point" in row]
    # Points in between whose sign is not yet certain could make the change quicker.
    judgement = (
        fact(added <= size.COUPLE)
        if added <= size.COUPLE or not points
        else Judgement(UNDECIDED, points)
    )
    return (
        judgement,
        f"certainly rotating at N = {few:.0f}, certainly counterrotating at N = {many:.0f}",
    )


def friction_order(study):
    found = [study.crossing("5b", name) for name in ("high", "medium", "low")]
    steps = []
    for rougher, smoother in zip(found, found[1:]):
        if smoother.verdict == "crosses":
            steps.append(above(smoother.at - rougher.at, size.ONE_DISC))
        else:
            # A curve that rotates at every N that was run crosses later, if at all.
            steps.append(
                every(
                    [
                        rougher.crosses,
                        fact(smoother.verdict == "always rotates")
                        if smoother.verdict != "undecided"
                        else Judgement(UNDECIDED, smoother.points),
                    ]
                )
            )
    return (
        every(steps),
        "; ".join(f"μ = {mu}: {c.text}" for mu, c in zip((1, 0.5, 0.1), found)) + ".",
    )


# --- Runs that are not steady -------------------------------------------------------------------

# Columns that count the runs of a point that are not steady, and what such runs do.
NOT_STEADY = {
    "drifting_runs": "drift",
    "jumping_runs": "jump",
    "switching_runs": "switch between two states",
}


def runs_not_steady(row):
    """The number of runs that are not steady; 0 in a table without these columns."""
    return sum(row.get(column, 0) for column in NOT_STEADY)


def drifts(row):
    """True if most runs are not steady. Their average then does not describe one state."""
    return "seeds" in row and runs_not_steady(row) > MOST_RUNS * row["seeds"]


def steady(study, setting):
    """The experiment's range of N; all frictional curves of Figure 5b for discs."""
    rows = (
        study.curve("spheres", setting=setting)
        if setting in SPHERES
        else [
            row
            for row in study.table("5b")
            if row["setting"] in ("high", "medium", "low") and row["discs"] <= LAST_N
        ]
    )
    rows = [row for row in rows if setting not in SPHERES or row["discs"] >= EXPERIMENT_N[0]]
    judged = [row for row in rows if row["steady_runs"] + runs_not_steady(row) > 0]
    in_question = [row for row in rows if row["steady_runs"] < row["seeds"]] or rows
    points = {row["point"] for row in in_question if isinstance(row.get("point"), str)}
    if not judged:
        return Judgement(UNDECIDED, points), "all runs are too short for the test"
    runs = [row["steady_runs"] + runs_not_steady(row) for row in judged]
    # Every point has the same weight, whatever its number of seeds: seeds are added where runs
    # drift.
    share = sum(runs_not_steady(row) / n for row, n in zip(judged, runs)) / len(judged)
    # The error of a point is that with one more run, which drifts as often as all runs do: if none
    # of n runs drifts, the share is only known to be below about 1/n.
    estimated = [(runs_not_steady(row) + share) / (n + 1) for row, n in zip(judged, runs)]
    error = math.sqrt(sum(p * (1 - p) / n for p, n in zip(estimated, runs))) / len(judged)
    found = Value(share, max(error, 1 / sum(runs)), points)
    overall = below(found, size.DRIFT_BY_CHANCE)
    # A point whose runs mostly drift has no steady state, however steady the others are.
    exceptions = [row for row in judged if drifts(row)]
    counts = [
        f"{sum(row.get(column, 0) for row in judged):.0f} {word}"
        for column, word in NOT_STEADY.items()
    ]
    return combined(overall, fact(False)) if exceptions else overall, (
        f"of {sum(runs):.0f} runs {', '.join(counts)} "
        f"({sum(row['seeds'] for row in rows) - sum(runs):.0f} more are too short for the test), a "
        f"share of {number(found)} if every point has the same weight"
        + (
            "; most runs are not steady at "
            f"{', '.join(str(row.get('point', row['discs'])) for row in exceptions)}"
            if exceptions
            else ""
        )
    )


# --- One friction absent ------------------------------------------------------------------------

PROTOCOL = "all events of a run, from the first one on"


def near_omega(rows, bound, where):
    """By the paper's own protocol: the average over all events of a run from its first one on. So
    whether a run is steady does not matter."""
    inside = [within(measured(row, "mean_by_event"), 1 - bound, 1 + bound) for row in rows]
    worst = max(rows, key=lambda row: abs(row["mean_by_event"] - 1))
    return every(inside), (
        f"{where}ithin {100 * bound:.0f} % of Ω for certain at {count(inside)} of {len(rows)} N, "
        f"outside for certain at {count(inside, FAILS)}; the largest difference is at "
        f"{value_at(worst, 'mean_by_event')} ({PROTOCOL})."
    )


def no_wall_at_omega(study):
    return near_omega(study.curve("5b-start", setting="no-wall"), size.NEAR_OMEGA, "W")


def no_disc_close(study):
    rows = [row for row in study.curve("5b-start", setting="no-disc") if row["discs"] < HIGH_N]
    return near_omega(rows, size.CLOSE_TO_OMEGA, f"Below N = {HIGH_N} w")


def lowest_of(study, figure, setting):
    """The rows of a curve at all N that were run, and the one with the lowest rotation."""
    rows = known(study.curve(figure, last=math.inf, setting=setting), "mean_by_event")
    return rows, min(rows, key=lambda row: row["mean_by_event"])


def never_crosses(setting, figure="5b"):
    """All N that were run count, also beyond the paper's N = 48."""

    def judge(study):
        rows, lowest = lowest_of(study, figure, setting)
        rotating = [above(v, -size.LEAST_ROTATION) for v in values(rows, "mean_by_event")]
        return every(rotating), (
            f"ϖ/Ω is certainly not below −{size.LEAST_ROTATION} at {count(rotating)} of "
            f"{len(rows)} N from {rows[0]['discs']:.0f} to {rows[-1]['discs']:.0f}; the lowest is "
            f"{value_at(lowest, 'mean_by_event')}."
        )

    return judge


def no_disc_drop(study):
    rows = study.curve("5b-start", setting="no-disc")
    level = mean_of(
        values([row for row in rows if LEVEL_FROM <= row["discs"] < HIGH_N], "mean_by_event")
    )
    drop = level - measured(rows[-1], "mean_by_event")
    text = (
        f"Mean over N = {LEVEL_FROM} … {HIGH_N - 1}: {number(level)}; "
        f"{value_at(rows[-1], 'mean_by_event')}, lower "
        f"by {number(drop)} (a drop is more than {size.SLIGHT_DROP}; {PROTOCOL})."
    )
    try:
        last = study.curve("5b-steady", setting="no-disc")[-1]
        text += (
            " The drop is part of the transient: after a long warm-up ϖ/Ω = "
            f"{value_at(last, 'mean_by_event')}."
        )
    except (FileNotFoundError, IndexError):
        pass
    return above(drop, size.SLIGHT_DROP), text


# --- Comparisons --------------------------------------------------------------------------------


def elastic(study):
    """All runs of Figure 5b are elastic. Curves with damping have fewer seeds; they are reported
    only."""
    found = study.crossing("5b", "high")
    text = f"e = 1: {found.text}"
    try:
        damped = [(e, study.crossing("restitution", e)) for e in ("0.99", "0.9")]
        text += "".join(f"; e = {e}: {c.text}" for e, c in damped)
    except (FileNotFoundError, IndexError):
        pass
    return found.crosses, text + "."


def pancake(study, setting):
    rows = study.curve("1b", setting=setting)
    gap = [abs(measured(row, "mean_by_time") - measured(row, "pancake")) for row in rows]
    return combined(
        below(gap[-1] - gap[0], -size.LEAST_CHANGE * gap[0].mean), below(gap[-1], size.NEAR_PANCAKE)
    ), (
        f"distance from the line of the pancake {number(gap[0])} Ω at N = {rows[0]['discs']:.0f}, "
        f"{number(gap[-1])} Ω at N = {rows[-1]['discs']:.0f}"
    )
