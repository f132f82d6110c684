"""Claims on ϖ(N): Figures 1b, 4c and 5b, and the minimal model's transition."""

import math

from paper_parameters import EVENTS, LAST_N
from verdicts import (FAILS, HOLDS, UNDECIDED, UNTESTABLE, Judgement, Value, above, below, combined, either,
                      every, fact, mean_of, measured, within)

from .thresholds import (CLOSE_TO_OMEGA, DRIFT_BY_CHANCE, HIGH_N, LEAST_CHANGE, LEAST_ROTATION, LEVEL_FROM,
                         MOST_RUNS, NEAR_OMEGA, NEAR_PANCAKE, ONE_DISC, SLIGHT_DROP)
from .wording import count, ends, known, number, value_at, values


def transition(study):
    crossing = study.crossing("5b", "high")
    rows = study.curve("5b", setting="high")
    return (combined(above(measured(rows[0], "by_event"), LEAST_ROTATION), crossing.crosses,
                     below(measured(rows[-1], "by_event"), -LEAST_ROTATION)),
            f"{crossing.text}; ϖ/Ω = {ends(rows, 'by_event')} (μ = 1; rotation: more than {LEAST_ROTATION} Ω).")


def after_minimum(rows, name):
    """The row of the lowest point before the last, the last row, and the rise between them: negative if the
    curve falls to its end."""
    rows = known(rows, name)
    lowest, last = min(rows[:-1], key=lambda row: row[name]), rows[-1]
    return lowest, last, measured(last, name) - measured(lowest, name)


def minimum(study):
    """The paper's mean over the discs is judged. In it every disc has the same weight, and discs near the
    centre of mass have the highest angular velocities."""
    rows = study.curve("5b", last=math.inf, setting="high")
    lowest, last, rise = after_minimum(rows, "by_event")
    text = (f"The lowest point before the last is at N = {lowest['discs']:.0f}, ϖ/Ω = "
            f"{number(measured(lowest, 'by_event'))}. At the last N that was run, {last['discs']:.0f}, ϖ/Ω = "
            f"{number(measured(last, 'by_event'))}, a rise of {number(rise)} (μ = 1).")
    if all("rigid_by_event" in row for row in rows):
        rigid_lowest, rigid_last, rigid_rise = after_minimum(rows, "rigid_by_event")
        trend = {HOLDS: "also rises", FAILS: "falls to the end",
                 UNDECIDED: "neither certainly rises nor certainly falls"}[above(rigid_rise, 0).verdict]
        text += (" This is the paper's mean over the discs of their angular velocities. The angular velocity "
                 f"of a rigid body, Σ r × v / Σ r², {trend}: from {value_at(rigid_lowest, 'rigid_by_event')} "
                 f"to {value_at(rigid_last, 'rigid_by_event')}.")
    return above(rise, SLIGHT_DROP), f"{text} (A rise is more than {SLIGHT_DROP} Ω.)"


def one_passage(found):
    """From rotation to counterrotation once: below some number of discs none counterrotates, and from it on
    none rotates."""
    return either(every([above(v, -LEAST_ROTATION) for v in found[:k]] +
                        [below(v, LEAST_ROTATION) for v in found[k:]]) for k in range(1, len(found)))


def passage(study):
    rows = known(study.curve("5b", last=math.inf, setting="high"), "by_event")
    rotating = [row for row in rows if above(measured(row, "by_event"), LEAST_ROTATION).verdict == HOLDS]
    against = [row for row in rows if below(measured(row, "by_event"), -LEAST_ROTATION).verdict == HOLDS]
    return one_passage(values(rows, "by_event")), (
        f"μ = 1: certainly above {LEAST_ROTATION} Ω at {len(rotating)} N, the last of them "
        f"{rotating[-1]['discs']:.0f}, and certainly below −{LEAST_ROTATION} Ω at {len(against)} N, the first of "
        f"them {against[0]['discs']:.0f}.")


def friction_order(study):
    found = [study.crossing("5b", name) for name in ("high", "medium", "low")]
    steps = []
    for rougher, smoother in zip(found, found[1:]):
        if smoother.verdict == "crosses":
            steps.append(above(smoother.at - rougher.at, ONE_DISC))
        else:
            # A curve that rotates at every N that was run crosses later, if at all.
            steps.append(every([rougher.crosses, fact(smoother.verdict == "always rotates")
                                if smoother.verdict != "undecided"
                                else Judgement(UNDECIDED, smoother.points)]))
    return every(steps), "; ".join(f"μ = {mu}: {c.text}" for mu, c in zip((1, 0.5, 0.1), found)) + "."


# --- Runs that are not steady -------------------------------------------------------------------

# Columns that count the runs of a point that are not steady, and what such runs do.
NOT_STEADY = {"drifting_runs": "drift", "jumping_runs": "jump",
              "switching_runs": "switch between two states"}


def runs_not_steady(row):
    """The number of runs that are not steady; 0 in a table without these columns."""
    return sum(row.get(column, 0) for column in NOT_STEADY)


def drifts(row):
    """True if most runs are not steady. Their average then does not describe one state."""
    return "seeds" in row and runs_not_steady(row) > MOST_RUNS * row["seeds"]


def steady(study):
    rows = [row for row in study.table("5b")
            if row["setting"] in ("high", "medium", "low") and row["discs"] <= LAST_N]
    judged = [row for row in rows if row["steady_runs"] + runs_not_steady(row) > 0]
    in_question = [row for row in rows if row["steady_runs"] < row["seeds"]] or rows
    points = {row["point"] for row in in_question if isinstance(row.get("point"), str)}
    if not judged:
        return Judgement(UNDECIDED, points), "All runs are too short for the test."
    runs = [row["steady_runs"] + runs_not_steady(row) for row in judged]
    # Every point has the same weight, whatever its number of seeds: seeds are added where runs drift.
    share = sum(runs_not_steady(row) / n for row, n in zip(judged, runs)) / len(judged)
    # The error of a point is that with one more run, which drifts as often as all runs do: if none of n
    # runs drifts, the share is only known to be below about 1/n.
    estimated = [(runs_not_steady(row) + share) / (n + 1) for row, n in zip(judged, runs)]
    error = math.sqrt(sum(p * (1 - p) / n for p, n in zip(estimated, runs))) / len(judged)
    found = Value(share, max(error, 1 / sum(runs)), points)
    overall = below(found, DRIFT_BY_CHANCE)
    # A point whose runs mostly drift has no steady state, however steady the others are.
    exceptions = [row for row in judged if drifts(row)]
    counts = [f"{sum(row.get(column, 0) for row in judged):.0f} {word}" for column, word in NOT_STEADY.items()]
    return combined(overall, fact(False)) if exceptions else overall, (
        f"Of {sum(runs):.0f} runs with both kinds of friction after 20 periods, {', '.join(counts)} "
        f"({sum(row['seeds'] for row in rows) - sum(runs):.0f} more are too short for the test). This is a share of "
        f"{number(found)} if every N and friction coefficient has the same weight; "
        f"{100 * DRIFT_BY_CHANCE:.0f} % are allowed for chance and slow states." +
        (f" Most runs are not steady at {', '.join(str(row.get('point', row['discs'])) for row in exceptions)}. These "
         "have no steady state within the paper's run." if exceptions else ""))


# --- One friction absent ------------------------------------------------------------------------

def near_omega(rows, bound, where):
    inside = [Judgement(UNDECIDED) if drifts(row)
              else within(measured(row, "by_event"), 1 - bound, 1 + bound) for row in rows]
    drifting = [row["discs"] for row in rows if drifts(row)]
    worst = max(rows, key=lambda row: abs(row["by_event"] - 1))
    return every(inside), (
        f"{where}ithin {100 * bound:.0f} % of Ω for certain at {count(inside)} of {len(rows)} N, outside for "
        f"certain at {count(inside, FAILS)}; the largest difference is at {value_at(worst, 'by_event')}." +
        (f" Most runs drift at {len(drifting)} N, from N = {min(drifting):.0f} on; nothing is decided there."
         if drifting else ""))


def no_wall_at_omega(study):
    return near_omega(study.curve("5b", setting="no-wall"), NEAR_OMEGA, "W")


def no_disc_close(study):
    rows = [row for row in study.curve("5b", setting="no-disc") if row["discs"] < HIGH_N]
    return near_omega(rows, CLOSE_TO_OMEGA, f"Below N = {HIGH_N} w")


def never_crosses(setting):
    """All N that were run count, also beyond the paper's N = 48."""
    def judge(study):
        rows = known(study.curve("5b", last=math.inf, setting=setting), "by_event")
        lowest = min(rows, key=lambda row: row["by_event"])
        rotating = [above(v, -LEAST_ROTATION) for v in values(rows, "by_event")]
        return every(rotating), (
            f"ϖ/Ω is certainly not below −{LEAST_ROTATION} at {count(rotating)} of {len(rows)} N from "
            f"{rows[0]['discs']:.0f} to {rows[-1]['discs']:.0f}; the lowest is {value_at(lowest, 'by_event')}.")
    return judge


def no_disc_drop(study):
    rows = study.curve("5b", setting="no-disc")
    level = mean_of(values([row for row in rows if LEVEL_FROM <= row["discs"] < HIGH_N], "by_event"))
    drop = level - measured(rows[-1], "by_event")
    text = (f"Mean over N = {LEVEL_FROM} … {HIGH_N - 1}: {number(level)}; {value_at(rows[-1], 'by_event')}, lower "
            f"by {number(drop)} (a drop is more than {SLIGHT_DROP}).")
    try:
        last = study.curve("5b-steady", setting="no-disc")[-1]
        text += (f" The drop is part of the transient: after a long warm-up ϖ/Ω = {value_at(last, 'by_event')}.")
    except (FileNotFoundError, IndexError):
        pass
    # The transient lasts longer than a short run, and ϖ is farther from Ω the less of it a run covers.
    if rows[-1].get("events", EVENTS) < EVENTS:
        return Judgement(UNDECIDED), (
            f"{text} Runs of {rows[-1]['events']:,.0f} events cover less of the transient than the paper's of "
            f"{EVENTS:,.0f}, and decide nothing.")
    return above(drop, SLIGHT_DROP), text


# --- Comparisons --------------------------------------------------------------------------------

def pancake(study):
    rows = study.curve("1b", setting="high")
    gap = [abs(measured(row, "by_time") - measured(row, "pancake")) for row in rows]
    return combined(below(gap[-1] - gap[0], -LEAST_CHANGE * gap[0].mean), below(gap[-1], NEAR_PANCAKE)), (
        f"Distance from the line of the pancake: {number(gap[0])} Ω at N = {rows[0]['discs']:.0f}, "
        f"{number(gap[-1])} Ω at N = {rows[-1]['discs']:.0f}.")


def rough_earlier(study):
    rough, smooth = study.crossing("4c", "high"), study.crossing("4c", "low")
    text = f"μ = 1: {rough.text}; μ = 0.1: {smooth.text}."
    if smooth.verdict == "crosses":
        return above(smooth.at - rough.at, ONE_DISC), text
    later = (Judgement(UNDECIDED, smooth.points) if smooth.verdict == "undecided"
             else fact(smooth.verdict == "always rotates"))
    return every([rough.crosses, later]), text


def elastic(study):
    """All runs of Figure 5b are elastic. Curves with damping have fewer seeds; they are reported only."""
    found = study.crossing("5b", "high")
    text = f"e = 1: {found.text}"
    try:
        damped = [(e, study.crossing("restitution", e)) for e in ("0.99", "0.9")]
        text += "".join(f"; e = {e}: {c.text}" for e, c in damped)
    except (FileNotFoundError, IndexError):
        pass
    return found.crosses, text + "."


def near_36(study):
    return Judgement(UNTESTABLE), (
        "The friction coefficient of the real spheres is unknown. The simulation with μ = 1, I = 10 has "
        f"{study.crossing('5b', 'high').text}.")
