"""The paper's claims, and what the tables say of each.

A claim has a function that reads the tables and returns a verdict with the numbers it rests on. No
verdict is written by hand: all come from the rules of verdicts.py, with three standard errors as
the one threshold; every other number is a constant with a name, below.

Claims that the paper does not make are none of these; nor is a fact of its experiment judged, whose
friction is not known, by the paper's discs. Spheres that roll on a floor are that experiment but for
their friction: of those, what is claimed must come out for one of the frictions that were tried,
all of it for the same one. Only what is said of several frictions must come out for all.

Source of all claims: L. Lee, J. P. Ryan, Y. Lahini, M. Holmes-Cerfon, S. M. Rubinstein, Physical
Review E 100, 012903 (2019), main text and Supplementary Information (SI).

    /usr/bin/python3 figures/claims.py out     writes out/verdicts.json: verdicts, and for what is
                                               undecided the points that need more seeds
"""

import json
import math
import os
import sys

import tables
import whole_file
from verdicts import (FAILS, HOLDS, IN_PART, MISSING, UNDECIDED, UNTESTABLE, Part, Value,  # noqa: F401
                      above, agreed, below, either, every, falls, mean_of, measured, parts, rises,
                      scattered, step_back, trend, true, within)

# What the paper leaves open.
NEAR_OMEGA = 0.05          # of Ω: "remains at that of the container"
CLOSE_TO_OMEGA = 0.1       # of Ω: "remains close to the container velocity"
HIGH_N = 41                # from here on N is "very high": above, a curve may drop
SLIGHT_DROP = 0.005        # of Ω: the least that is a drop
NEAR_PANCAKE = 0.05        # of Ω: "increasingly similarly to a model particle with no slip"
SAME_PLACE = 20.0          # degrees: "at the same location"
EARLIER = 10.0             # degrees: the least that is "earlier in its cycle"
SIMILAR = 0.15             # of the mean: "quantitatively similar"
NEARLY_ONE = 0.9           # "nearly 1", of the slip parameter
# "For six-fold packing, as we often see in the pinned region": the ψ6 (src/measure/hexatic_order.hpp)
# of a liquid of hard discs about to freeze, packing fraction 0.69, from a Monte Carlo simulation of
# 196 discs; and of points thrown at random.
SIX_FOLD, NO_ORDER = 0.63, 0.43
ABOUT_A_HALF = 0.1         # either way: "approximately 0.5", of the slip parameter
AT_THE_WALL = 0.05         # "approaches 1", of the normalised angular velocity
CHANCE_OF_DRIFT = 0.05     # share of the runs that may drift in a steady state
PERIOD, RADIUS = 11.866071, 8.6  # of the swirl, of the dish (SI)
# Of the experiment: 11.81 rad/s and discs of 3 mm radius. One r Ω² in cm/s².
EXPERIMENTS_R_OMEGA_SQUARE = 0.3 * 11.81 ** 2
GROWTH = 0.2               # of its mean: an energy that grows more "blows up"
IDENTICAL = 0.01           # of Ω: two means of the same runs, taken at different times
LITTLE_MOTION = 0.1        # of ΩR, in the M-frame: "very little internal movement"
SAME_RANGE = 0.15          # of the paper's highest force
TIMES_AROUND = 10.0        # factor either way: "around" a time
LEAST_VISITS = 200         # of a slice of θ that is looked at
ROUGHLY = 2.0              # spheres either way: "at roughly N = 36"
PLASTIC, ROUGHER = 0.2, 0.3  # frictions of the spheres of plastic, where one or two are chosen
DENSE_SPHERES = (44, 48)   # where all agree that they counterrotate

# What the paper says.
MOST_DISCS = 48            # "for each N between 5 and 48" (SI)
LOW_N, LARGE_N = 28, 48    # "for a rotating (N = 28) and counterrotating (N = 48) case"
MOST_FORCES = {"centrifugal": 460.0, "coriolis": 200.0}  # cm/s²: "0–460", "0–200"
SMALLEST = {1.0: 1e-11, 0.0: 1e-9}  # times between collisions, by friction (SI)
EVENTS = 1e6               # "number of events calculated" (SI)
SIDES = 30                 # "a polygonal path with 30 sides"
M_AT = 270.0               # degrees: M is "always positioned at the bottom"

# What a judge looks at, without a word in the paper.
LEVEL_FROM = 30            # N from which, up to HIGH_N, the level before a drop is taken
MOSTLY = 0.5               # share of the runs of a point: more of them steady, and it is
# Standard deviation of log10 of the smallest of many independent times: it is distributed
# exponentially, and the natural logarithm of such a time has π/√6.
SCATTER_OF_SMALLEST = math.pi / math.sqrt(6) / math.log(10)
APART = 90.0               # degrees: another place, not a neighbour of the first
TENTHS = 10                # an energy is averaged over these parts of a run, the first left out
NEAR_CROSSING = 3          # discs either way: points that could tell a crossing better


class Claim:
    def __init__(self, where, says, figure, judge):
        self.where, self.says, self.figure, self.judge = where, says, figure, judge

    @property
    def command(self):
        return f"swirl paper --figure {self.figure}" if self.figure else ""

    def judged(self, folder):
        """(Part, what was found)"""
        try:
            return self.judge(Folder(folder))
        except FileNotFoundError as missing:
            return Part(MISSING), f"The table {os.path.basename(missing.filename)} is not there."
        except KeyError as missing:
            return Part(MISSING), f"Its table has nothing called {missing.args[0]}."
        except (IndexError, ValueError, ZeroDivisionError):
            return Part(MISSING), "The table has too few runs in it."

    def verdict(self, folder):
        """(verdict, what was found)"""
        part, found = self.judged(folder)
        return part.verdict, found


class Folder:
    def __init__(self, path):
        self.path = path

    def table(self, name):
        return tables.read(os.path.join(self.path, f"figure_{name}.csv"))

    def crossing(self, name, curve):
        """Where a curve of a figure crosses zero; the points near it could tell it better."""
        # A curve named by a number is read back as one.
        def named(row, key):
            return curve == (f"{row[key]:g}" if isinstance(row[key], float) else row[key])
        row = [row for row in self.table(f"{name}_crossings") if named(row, "curve")][0]
        return Crossing(row, self.points_near(name, curve, row, named))

    def points_near(self, name, curve, crossing, named):
        try:
            rows = self.table(name)
        except FileNotFoundError:
            return ()
        rows = [row for row in rows
                if any(key in row and named(row, key) for key in ("setting", "curve"))]
        at = crossing["crossing"] if crossing["verdict"] == "crosses" else crossing["lowest_discs"]
        return {row["point"] for row in rows
                if "point" in row and abs(row["discs"] - at) <= NEAR_CROSSING}

    def curve(self, name, most=MOST_DISCS, **wanted):
        """Rows in order of N, up to the paper's last."""
        rows = [row for row in tables.select(self.table(name), **wanted)
                if row.get("steady_state") != "failed" and row["discs"] <= most]
        return sorted(rows, key=lambda row: row["discs"])


class Crossing:
    def __init__(self, row, points):
        self.verdict, self.points = row["verdict"], points
        self.at = Value(row["crossing"], row["crossing_error"], points)
        self.lowest = Value(row["lowest"], row["lowest_error"], points)
        self.lowest_discs = row["lowest_discs"]

    @property
    def crosses(self):
        if self.verdict == "undecided":
            return Part(UNDECIDED, self.points)
        return true(self.verdict == "crosses")

    @property
    def text(self):
        if self.verdict == "crosses":
            return f"N_c = {number(self.at)}"
        return (f"no crossing ({self.verdict}; lowest ϖ/Ω = {number(self.lowest)} at N = "
                f"{self.lowest_discs:.0f})")


# --- words and numbers ------------------------------------------------------------------------

def value(row, name, error=None):
    """A number of a row with its error, and the point that it belongs to."""
    return measured(row, name, error)


def number(mean, error=float("nan")):
    """1.234 ± 0.012, with as many digits as the error supports."""
    if isinstance(mean, Value):
        mean, error = mean.mean, mean.error
    if mean != mean:
        return "not known"
    if not error > 0:
        return f"{mean:.3g}".replace("-", "−")
    digits = max(0, -math.floor(math.log10(error)) + (1 if error / 10 ** math.floor(
        math.log10(error)) < 1.95 else 0))
    return f"{mean:.{digits}f} ± {error:.{digits}f}".replace("-", "−")


def ends(rows, name):
    known = [row for row in rows if row[name] == row[name]]
    a, b = known[0], known[-1]
    return (f"{number(value(a, name))} at N = {a['discs']:.0f}, "
            f"{number(value(b, name))} at N = {b['discs']:.0f}")


def values(rows, name):
    return [value(row, name) for row in rows]


def rising(rows, name, falling=False):
    """The verdict on a curve that should rise (or fall) with N, and where it does not, in words."""
    found = values(rows, name)
    sought = [-v for v in found] if falling else found
    back = step_back(sought)
    if back is None:
        return rises(sought), ""
    a, b = (rows[k] for k in back)
    return rises(sought), (
        f", but it {'rises' if falling else 'falls'} from {number(value(a, name))} at N = "
        f"{a['discs']:.0f} to {number(value(b, name))} at N = {b['discs']:.0f}")


def count(statements, verdict=HOLDS):
    return sum(s.verdict == verdict for s in statements)


# --- the judges -------------------------------------------------------------------------------

def transition(folder):
    c = folder.crossing("5b", "high")
    rows = folder.curve("5b", setting="high")
    return (parts(above(value(rows[0], "by_event"), 0), c.crosses,
                  below(value(rows[-1], "by_event"), 0)),
            f"{c.text}; ϖ/Ω = {ends(rows, 'by_event')} (μ = 1).")


def after_minimum(rows, name):
    """The row of the lowest before the last, the last, and how much higher the last is: below zero
    if the curve falls to its end."""
    rows = [row for row in rows if row[name] == row[name]]
    lowest, last = min(rows[:-1], key=lambda row: row[name]), rows[-1]
    return lowest, last, value(last, name) - value(lowest, name)


def minimum(folder):
    rows = folder.curve("5b", most=math.inf, setting="high")
    lowest, last, rise = after_minimum(rows, "by_event")
    text = (f"Lowest before the end at N = {lowest['discs']:.0f}, ϖ/Ω = "
            f"{number(value(lowest, 'by_event'))}; at N = {last['discs']:.0f}, the last that was run, "
            f"it is {number(value(last, 'by_event'))}, a rise of {number(rise)} (μ = 1).")
    if all("rigid_by_event" in row for row in rows):
        # The paper's mean of single angular velocities is judged. A disc near the centre of mass
        # counts there for as much as any other, and has the highest of them.
        low, end, rigid = after_minimum(rows, "rigid_by_event")
        so = {HOLDS: "rises, too", FAILS: "falls to the end",
              UNDECIDED: "neither rises nor falls for certain"}[above(rigid, 0).verdict]
        text += (" That is the paper's mean over the discs of their angular velocities. The "
                 f"cluster's as that of a rigid body, Σ r × v / Σ r², {so}: from "
                 f"{number(value(low, 'rigid_by_event'))} at N = {low['discs']:.0f} to "
                 f"{number(value(end, 'rigid_by_event'))} at N = {end['discs']:.0f}.")
    return above(rise, 0), text


def friction_order(folder):
    found = [folder.crossing("5b", name) for name in ("high", "medium", "low")]
    text = "; ".join(f"μ = {mu}: {c.text}" for mu, c in zip((1, 0.5, 0.1), found)) + "."
    steps = []
    for a, b in zip(found, found[1:]):
        if b.verdict == "crosses":
            steps.append(above(b.at, a.at))
        else:
            # A curve that rotates at every N crosses later than one that crosses, if at all.
            steps.append(every([a.crosses, true(b.verdict == "always rotates")
                                if b.verdict != "undecided" else Part(UNDECIDED, b.points)]))
    return every(steps), text


def drifts(row):
    """Most of its runs do: their average is of the way to somewhere else. A row without the columns was
    never asked."""
    return "seeds" in row and row["drifting_runs"] > MOSTLY * row["seeds"]


def near_omega(rows, bound, where):
    inside = [Part(UNDECIDED) if drifts(row) else within(value(row, "by_event"), 1 - bound, 1 + bound)
              for row in rows]
    drifting = [row["discs"] for row in rows if drifts(row)]
    worst = max(rows, key=lambda row: abs(row["by_event"] - 1))
    return every(inside), (
        f"{where}ithin {100 * bound:.0f} % of Ω for certain at {count(inside)} of {len(rows)} N, "
        f"outside for certain at {count(inside, FAILS)}; farthest is "
        f"{number(value(worst, 'by_event'))} at N = {worst['discs']:.0f}." +
        (f" Where most runs drift, from N = {min(drifting):.0f} on at {len(drifting)} N, nothing is "
         "decided." if drifting else ""))


def no_wall_at_omega(folder):
    return near_omega(folder.curve("5b", setting="no-wall"), NEAR_OMEGA, "W")


def no_disc_close(folder):
    rows = [row for row in folder.curve("5b", setting="no-disc") if row["discs"] < HIGH_N]
    return near_omega(rows, CLOSE_TO_OMEGA, f"Below N = {HIGH_N} w")


def never_crosses(setting):
    def judge(folder):
        rows = folder.curve("5b", setting=setting)
        positive = [above(v, 0) for v in values(rows, "by_event")]
        lowest = min((row for row in rows if row["by_event"] == row["by_event"]),
                     key=lambda row: row["by_event"])
        return every(positive), (
            f"ϖ is certainly positive at {count(positive)} of {len(rows)} N; lowest is ϖ/Ω = "
            f"{number(value(lowest, 'by_event'))} at N = {lowest['discs']:.0f}.")
    return judge


def drop_of(rows):
    before = [row for row in rows if LEVEL_FROM <= row["discs"] < HIGH_N]
    level = mean_of(values(before, "by_event"))
    return level, level - value(rows[-1], "by_event")


def no_disc_drop(folder):
    rows = folder.curve("5b", setting="no-disc")
    level, drop = drop_of(rows)
    text = (f"Mean of N = {LEVEL_FROM} … {HIGH_N - 1}: {number(level)}; at N = "
            f"{rows[-1]['discs']:.0f}: {number(value(rows[-1], 'by_event'))}, lower by {number(drop)} (a "
            f"drop is more than {SLIGHT_DROP}).")
    try:
        steady = folder.curve("5b-steady", setting="no-disc")
        text += (" It belongs to the beginning: after a long warm-up ϖ/Ω = "
                 f"{number(value(steady[-1], 'by_event'))} at N = {steady[-1]['discs']:.0f}.")
    except (FileNotFoundError, IndexError):
        pass
    # The way there takes longer than a short run, and ϖ is the farther from Ω the less of it is seen.
    if rows[-1].get("events", EVENTS) < EVENTS:
        return Part(UNDECIDED), (f"{text} Runs of {rows[-1]['events']:,.0f} events see less of the way to the "
                                 f"steady state than the paper's of {EVENTS:,.0f}, and decide nothing.")
    return above(drop, SLIGHT_DROP), text


def identity(folder):
    """Eq. 1, ϖ_M = ϖ − Ω, is no claim but the change of frames: a check of ours."""
    profile, worst = folder.table("3a"), 0.0
    try:
        rotation = folder.table("1b")
    except FileNotFoundError:
        return ""
    for row in rotation:
        slices = [r for r in tables.select(profile, discs=row["discs"]) if r["visits"] > 0]
        total = sum(r["visits"] for r in slices)
        if not total:
            continue
        mean = sum(r["visits"] * r["varpi_m"] for r in slices) / total
        worst = max(worst, abs(mean + 1 - row["by_time"]))
    # Both means are of the same runs, looked at 511 and 64 times a period.
    agree = "as they must" if worst < IDENTICAL else "which they must not"
    return (f" Eq. 1, ϖ_M = ϖ − Ω, is an identity and not counted as a claim: ⟨ϖ_M⟩ + Ω of these "
            f"profiles and ϖ of the same runs differ by at most {worst:.2g} Ω, {agree}.")


def steady(folder):
    rows = [row for row in folder.table("5b")
            if row["setting"] in ("high", "medium", "low") and row["discs"] <= MOST_DISCS]
    judged = [row for row in rows if row["steady_runs"] + row["drifting_runs"] > 0]
    open_ones = [row for row in rows if row["steady_runs"] < row["seeds"]] or rows
    points = {row["point"] for row in open_ones if isinstance(row.get("point"), str)}
    if not judged:
        return Part(UNDECIDED, points), "All runs are too short to tell."
    runs = [row["steady_runs"] + row["drifting_runs"] for row in judged]
    drifting = [row["drifting_runs"] for row in judged]
    # Every point counts once, however many seeds were spent on it: they are spent where runs drift.
    share = sum(k / n for k, n in zip(drifting, runs)) / len(judged)
    # The error of a point as if one more of its runs had been seen, that drifts as often as all do;
    # of no drifting run among n one knows only that the share is below about 1/n.
    seen = [(k + share) / (n + 1) for k, n in zip(drifting, runs)]
    error = math.sqrt(sum(p * (1 - p) / n for p, n in zip(seen, runs))) / len(judged)
    found = Value(share, max(error, 1 / sum(runs)), points)
    return below(found, CHANCE_OF_DRIFT), (
        f"{sum(drifting):.0f} of {sum(runs):.0f} runs with both frictions drift after 20 swirls "
        f"({sum(row['seeds'] for row in rows) - sum(runs):.0f} more are too short to tell), a share "
        f"of {number(found)} if every N and friction counts alike; by chance, and for slow states, "
        f"{100 * CHANCE_OF_DRIFT:.0f} % are allowed.")


def clockwise(folder):
    rows = [row for row in folder.table("3a") if row["visits"] > LEAST_VISITS]
    negative = [below(v, 0) for v in values(rows, "varpi_m")]
    fastest = max(rows, key=lambda row: row["varpi_m"])
    return every(negative), (
        f"⟨ϖ_M⟩ is certainly negative in {count(negative)} of {len(rows)} slices of θ and N, "
        f"certainly positive in {count(negative, FAILS)}; the highest is "
        f"{number(value(fastest, 'varpi_m'))} Ω.{identity(folder)}")


def pancake(folder):
    rows = folder.curve("1b", setting="high")
    gap = [abs(value(row, "by_time") - value(row, "pancake")) for row in rows]
    return parts(below(gap[-1], gap[0]), below(gap[-1], NEAR_PANCAKE)), (
        f"Distance from the pancake's line: {number(gap[0])} Ω at N = {rows[0]['discs']:.0f}, "
        f"{number(gap[-1])} Ω at N = {rows[-1]['discs']:.0f}.")


def pinned_slices(rows):
    """Slices between the beginning and the end of a stay at the wall, clockwise (θ falling)."""
    start, end = rows[0]["stay_begins"], rows[0]["stay_ends"]
    arc = (start - end) % 360
    return [row for row in rows if (start - row["theta"]) % 360 <= arc and row["visits"] > 0]


def pinned_means(folder, table, name):
    profile, result = folder.table(table), []
    for discs in sorted({row["discs"] for row in profile}):
        here = [row for row in pinned_slices(tables.select(profile, discs=discs))
                if row[name] == row[name] and row[name + "_error"] == row[name + "_error"]]
        if not here:
            continue
        mean = mean_of(values(here, name), [row["visits"] for row in here])
        # Slices of one run are not independent of each other: their errors add up.
        total = sum(row["visits"] for row in here)
        error = sum(row["visits"] * row[name + "_error"] for row in here) / total
        result.append({"discs": discs, "mean": mean.mean, "mean_error": error,
                       "point": here[0].get("point")})
    return result


def pinned_reach_wall(folder):
    rows = pinned_means(folder, "3b", "normalised")
    first, last = value(rows[0], "mean"), value(rows[-1], "mean")
    return parts(below(first, 1), within(last, 1 - AT_THE_WALL, 1 + AT_THE_WALL)), (
        f"Normalised angular velocity in the pinned region: {ends(rows, 'mean')}.")


def pinned_faster(folder):
    rows = pinned_means(folder, "3a", "varpi_m")
    part, but = rising(rows, "mean", falling=True)
    return part, f"⟨ϖ_M⟩/Ω in the pinned region: {ends(rows, 'mean')}{but}."


def loose_peak(folder):
    peaks = []
    profile = folder.table("3a")
    for discs in sorted({row["discs"] for row in profile}):
        here = [row for row in tables.select(profile, discs=discs)
                if row["visits"] > LEAST_VISITS]
        peaks.append((discs, min(here, key=lambda row: row["varpi_m"])))
    heights = [-value(row, "varpi_m") for _, row in peaks]
    mean = mean_of(heights).mean
    similar = [within(h, (1 - SIMILAR) * mean, (1 + SIMILAR) * mean) for h in heights]
    scatter = max(abs(h.mean - mean) for h in heights) / mean
    return every(similar), (
        f"Highest |⟨ϖ_M⟩|: {heights[0].mean:.2f} Ω at θ = {peaks[0][1]['theta']:.0f}° for N = "
        f"{peaks[0][0]:.0f}, {heights[-1].mean:.2f} Ω at {peaks[-1][1]['theta']:.0f}° for N = "
        f"{peaks[-1][0]:.0f}; within {100 * scatter:.0f} % of their mean at all N (asked: "
        f"{100 * SIMILAR:.0f} %).")


def slip_rises(folder):
    rows = folder.curve("4a", setting="high")
    part, but = rising(rows, "slip_stays")
    return parts(part, above(value(rows[-1], "slip_stays"), NEARLY_ONE)), (
        f"s of the discs on a stay at the wall: {ends(rows, 'slip_stays')}{but} (nearly 1: "
        f"above {NEARLY_ONE}); of all pinned by the SI's criterion: {ends(rows, 'pinned_region')}. "
        "The 0.5 at N = 25 is of the experiment, whose friction is not known.")


def closer_to_one(rough, smooth):
    """Of rows of two frictions, at every N that both have: is s closer to 1 for the rougher?"""
    smooth = {row["discs"]: row for row in smooth}
    pairs = [(row, smooth[row["discs"]]) for row in rough if row["discs"] in smooth]
    closer = [below(abs(value(a, "slip_stays") - 1), abs(value(b, "slip_stays") - 1))
              for a, b in pairs]
    return every(closer), (
        f"certainly at {count(closer)} of {len(closer)} N, certainly not at {count(closer, FAILS)}")


def slip_rough(folder):
    low = folder.curve("4a", setting="low")
    part, found = closer_to_one(folder.curve("4a", setting="high"), low)
    return part, (
        f"s of the discs on a stay at the wall is closer to 1 for μ = 1 than for μ = 0.1, {found}; "
        f"for μ = 0.1: {ends(low, 'slip_stays')}, of all pinned by the SI's criterion "
        f"{ends(low, 'pinned_region')}.")


def wall_spin(folder):
    rows = folder.curve("4b", setting="high")
    part, but = rising(rows, "stay_spin", falling=True)
    return part, (
        f"⟨|ω|⟩/Ω of the discs on a stay at the wall: {ends(rows, 'stay_spin')}{but}; of those at the "
        f"wall that are pinned by the SI's criterion: {ends(rows, 'pinned_wall_spin')}. What the "
        "paper calls the reason, frustration, can be counted (no claim of the paper's): the share of "
        f"the contacts that belong to a triangle is {ends(rows, 'triangles')}.")


def gears(folder):
    rows = folder.curve("4b", setting="high")
    # In strong contact, at all N together: the runs at different N are independent.
    strong = values(rows, "correlation_by_impulse")
    mean = mean_of([v for v in strong if v.known])
    held = value(rows[-1], "stay_correlation")
    return parts(below(mean, 0), below(held, 0)), (
        f"Correlation of the spins in disc–disc collisions, each counted with its impulse: "
        f"{number(mean)} on average over N, {ends(rows, 'correlation_by_impulse')}; certainly "
        f"negative at {count([below(v, 0) for v in strong])} of {len(rows)} N. Of discs on "
        f"a stay at the wall and any that they touch: {ends(rows, 'stay_correlation')}, of neighbours "
        f"along the wall alone: {ends(rows, 'along_wall')}, of pairs that are pinned by the SI's "
        f"criterion: {ends(rows, 'pinned_correlation')}; of all touching pairs, most of which "
        f"hardly press: {ends(rows, 'spin_correlation')}. Judged is the sign; gears would have −1.")


def rough_earlier(folder):
    rough, smooth = folder.crossing("4c", "high"), folder.crossing("4c", "low")
    text = f"μ = 1: {rough.text}; μ = 0.1: {smooth.text}."
    if smooth.verdict == "crosses":
        return above(smooth.at, rough.at), text
    later = (Part(UNDECIDED, smooth.points) if smooth.verdict == "undecided"
             else true(smooth.verdict == "always rotates"))
    return every([rough.crosses, later]), text


def angles(folder):
    rows = folder.curve("3a")
    seen = {row["discs"]: row for row in rows}
    return [seen[n] for n in sorted(seen)]


def unwrapped(rows, name):
    """Angles in degrees without jumps of a whole turn."""
    result = []
    for row in rows:
        angle = value(row, name)
        if angle.mean != angle.mean:
            continue
        if result:
            angle.mean += 360 * round((result[-1].mean - angle.mean) / 360)
        result.append(angle)
    return result


def by_choice(folder):
    """Places and shares of the stays for every choice of the wall's layer and of the least length
    of a stay: (layer in disc radii, length in swirls): rows in order of N."""
    points = {row["discs"]: row.get("point") for row in folder.table("3a")}
    choices = {}
    for row in folder.curve("3a_sensitivity"):
        # The layer is computed from the dish's radius, and its last digit differs between N.
        choice = (round(row["layer"], 6), round(row["least_length"], 6))
        choices.setdefault(choice, []).append(row | {"point": points.get(row["discs"])})
    return choices


def from_to(choices, found):
    """Of numbers found for each choice the lowest and the highest, and what was chosen."""
    found = [v.mean for v in found if v.known]
    layers, lengths = sorted({c[0] for c in choices}), sorted({c[1] for c in choices})
    return (f"{min(found):.0f} to {max(found):.0f}" if found else "not known"), (
        f"{len(choices)} choices of the layer ({layers[0]:g} to {layers[-1]:g} radii from the wall) "
        f"and of the least length of a stay ({lengths[0]:.2f} to {lengths[-1]:.2f} swirls)")


def pinned_grows(folder):
    rows, choices = angles(folder), by_choice(folder)
    found = [rises(values(c, "share")) for c in choices.values()]
    return agreed(found), (
        f"Share of the discs that is on a stay at the wall: {ends(rows, 'stay_share')}; it rises for "
        f"{count(found)} of {from_to(choices, [])[1]}. Pinned by the SI's criterion: "
        f"{ends(rows, 'share')}.")


def upstream(rows, name):
    """How far a place moves from the first N to the last: who runs clockwise is earlier at a larger θ."""
    path = unwrapped(rows, name)
    return path[-1] - path[0]


def spread(rows, name):
    """How far apart a place is at any two N."""
    path = unwrapped(rows, name)
    return max(path, key=lambda a: a.mean) - min(path, key=lambda a: a.mean)


def pinned_earlier(folder):
    rows, choices = angles(folder), by_choice(folder)
    shifts = [upstream(c, "becoming_pinned") for c in choices.values()]
    span, choice = from_to(choices, shifts)
    return agreed([above(shift, EARLIER) for shift in shifts]), (
        f"Stays at the wall begin at θ = {ends(rows, 'stay_begins')} (degrees); the place moves "
        f"upstream by {number(upstream(rows, 'stay_begins'))}° (earlier: more than {EARLIER:.0f}°), and "
        f"by {span}° with the {choice}. By the SI's sharp turns: {ends(rows, 'becoming_pinned')}.")


def resultants(rows, name):
    return f"{rows[0][name]:.2f} and {rows[-1][name]:.2f}"


def free_fixed(folder):
    rows, choices = angles(folder), by_choice(folder)
    spreads = [spread(c, "becoming_free") for c in choices.values()]
    same = [below(s, SAME_PLACE) for s in spreads]
    span, choice = from_to(choices, spreads)
    return agreed(same), (
        f"Stays at the wall end at θ = {ends(rows, 'stay_ends')} (degrees; resultant length "
        f"{resultants(rows, 'stay_ends_resultant')}): over all N the place moves by "
        f"{number(spread(rows, 'stay_ends'))}°, and by {span}° with the {choice}. The same place "
        f"(within {SAME_PLACE:.0f}°) for certain with {count(same)} of them, another for certain "
        f"with {count(same, FAILS)}. By the SI's criterion {ends(rows, 'becoming_free')}, with "
        f"resultants {resultants(rows, 'becoming_free_resultant')}: it counts discs that fly along "
        f"the wall far from it, too{two_places(folder, 'si_free')}.")


def two_places(folder, name):
    """Where most become free, and where on the other side of the dish, at the last N: the mean of two
    such places is a place where few do."""
    try:
        rows = folder.table("pinning")
    except FileNotFoundError:
        return ""
    last = max(row["discs"] for row in rows)
    rows = tables.select(rows, discs=last)
    most = max(rows, key=lambda row: row[name])
    across = [row for row in rows
              if abs((row["theta"] - most["theta"] + 180) % 360 - 180) > APART]
    second = max(across, key=lambda row: row[name])
    return (f", and its places spread: at N = {last:.0f} most are at θ = {most['theta']:.0f}° "
            f"({100 * most[name]:.0f} % in 10°), and farther than {APART:.0f}° from there up to "
            f"{100 * second[name]:.0f} % at {second['theta']:.0f}°")


def grows(rows):
    part, but = rising(rows, "stay_share")
    return part, f"share that is on a stay at the wall: {ends(rows, 'stay_share')}{but}"


def earlier(rows):
    shift = upstream(rows, "stay_begins")
    return above(shift, EARLIER), (
        f"stays at the wall begin at θ = {ends(rows, 'stay_begins')} (degrees): the place moves "
        f"upstream by {number(shift)}° (earlier: more than {EARLIER:.0f}°)")


def same_place(rows):
    apart = spread(rows, "stay_ends")
    return below(apart, SAME_PLACE), (
        f"stays at the wall end at θ = {ends(rows, 'stay_ends')} (degrees): over all N the place "
        f"moves by {number(apart)}° (the same place: within {SAME_PLACE:.0f}°)")


def left_of_M(folder):
    rows = folder.curve("1b", setting="high")
    lag = [M_AT - row["centre_theta"] for row in rows]
    return parts(every([above(v, 0.5) for v in values(rows, "left")]),
                 every([below(v, 0) for v in values(rows, "centre_x")])), (
        f"Share of the discs left of the line from C to M: {ends(rows, 'left')}; x of the centre "
        f"of mass, in disc radii: {ends(rows, 'centre_x')}. It lags behind the swirl by "
        f"{lag[0]:.0f}° at N = {rows[0]['discs']:.0f} and {lag[-1]:.0f}° at N = "
        f"{rows[-1]['discs']:.0f}.")


def more_collisions(folder):
    rows = folder.curve("4b", setting="high")
    # The two kinds of one run are not independent: their errors add up.
    found = [Value(PERIOD * (row["disc_disc_rate"] + row["disc_wall_rate"]),
                   PERIOD * (row["disc_disc_rate_error"] + row["disc_wall_rate_error"]),
                   [row["point"]] if "point" in row else ()) for row in rows]
    return rises(found), (
        f"Collisions of a disc in a swirl: {number(found[0])} at N = {rows[0]['discs']:.0f}, "
        f"{number(found[-1])} at N = {rows[-1]['discs']:.0f}.")


def six_fold(folder):
    rows = folder.curve("4b", setting="high")
    return above(value(rows[-1], "psi6_stays"), SIX_FOLD), (
        f"Hexatic order ψ6 of the discs on a stay at the wall: {ends(rows, 'psi6_stays')} (often "
        f"six-fold: above {SIX_FOLD}, that of a liquid of hard discs about to freeze; points without any "
        f"order have {NO_ORDER}, a crystal 1); of all that are pinned by the SI's criterion: "
        f"{ends(rows, 'psi6_pinned')}; of all discs: {ends(rows, 'psi6')}.")


def oblong(folder):
    profile = folder.table("3a")
    farther, as_fast, told = [], [], []
    for discs in sorted({row["discs"] for row in profile}):
        here = [row for row in tables.select(profile, discs=discs)
                if row["visits"] > LEAST_VISITS]
        slow = max(here, key=lambda row: row["varpi_m"])
        weights = [row["visits"] for row in here]
        distance = mean_of(values(here, "distance"), weights)
        speed = mean_of(values(here, "speed"), weights).mean
        farther.append(above(value(slow, "distance"), distance))
        as_fast.append(within(value(slow, "speed"), (1 - SIMILAR) * speed, (1 + SIMILAR) * speed))
        told.append(f"at N = {discs:.0f}, θ = {slow['theta']:.0f}°, discs are "
                    f"{slow['distance'] / distance.mean:.2f} times as far from the centre of mass "
                    f"as on average and {slow['speed'] / speed:.2f} times as fast")
    return parts(every(farther), every(as_fast)), (
        f"Where |⟨ϖ_M⟩| is least: {told[0]}; {told[-1]}. Farther for certain at {count(farther)} "
        f"of {len(farther)} N, as fast within {100 * SIMILAR:.0f} % for certain at "
        f"{count(as_fast)}.")


def forces(folder):
    rows = folder.curve("1b", setting="high")
    # In units of r Ω², then of the experiment.
    per_unit = EXPERIMENTS_R_OMEGA_SQUARE / (2 * math.pi / PERIOD) ** 2
    points = [row["point"] for row in rows if isinstance(row.get("point"), str)]
    # A highest force has no error of its own; those at different N are independent.
    found = {name: scattered([row[f"most_{name}"] * per_unit for row in rows], points)
             for name in MOST_FORCES}
    agree = [within(found[name], (1 - SAME_RANGE) * most, (1 + SAME_RANGE) * most)
             for name, most in MOST_FORCES.items()]
    mean = mean_of(values(rows, "coriolis")) * per_unit
    wall = 2 * RADIUS * EXPERIMENTS_R_OMEGA_SQUARE
    return parts(*agree), (
        f"In the experiment's units the centrifugal force on a disc is "
        f"{number(found['centrifugal'])} and the Coriolis force {number(found['coriolis'])} cm/s² at "
        f"most, on average over N (the paper's range: within {100 * SAME_RANGE:.0f} % of its end). "
        f"The mean Coriolis force is {number(mean)}, that of a disc that moves with the wall about "
        f"{wall:.0f}, so 200 can only hold for slow ones.")


def rim(folder):
    rows = [row for row in folder.table("states") if row["discs"] == LARGE_N]
    by_setting = {row["setting"]: row for row in rows}
    omega = 2 * math.pi / PERIOD
    speed = {name: value(row, "coriolis") * (1 / (2 * omega ** 2 * RADIUS))
             for name, row in by_setting.items()}
    return below(speed["no-wall"], LITTLE_MOTION), (
        f"Mean speed in the M-frame at N = {LARGE_N}, in ΩR: {number(speed['no-wall'])} without "
        f"wall friction, {number(speed['high'])} with both (little: below {LITTLE_MOTION}).")


def is_steady(row):
    """Most of its runs are; a row without the columns was never asked."""
    return "seeds" not in row or row["steady_runs"] > MOSTLY * row["seeds"]


def gas(folder):
    rows = {(row["setting"], row["discs"]): row for row in folder.table("states")}
    pairs = [(rows["no-disc", n], rows["high", n]) for n in (LOW_N, LARGE_N)]
    temperatures = [[value(row, "granular") for row in pair] for pair in pairs]
    contacts = [[value(row, "coordination") for row in pair] for pair in pairs]
    words = {"high": "both frictions", "no-disc": "no disc friction"}
    drift = [f"{words[row['setting']]}, N = {row['discs']:.0f}" for pair in pairs for row in pair
             if not is_steady(row)]
    # A state that is still changing has no temperature, and more seeds would not give it one.
    part = Part(UNDECIDED) if drift else parts(
        every([below(loose, both) for loose, both in contacts]),
        every([above(loose, both) for loose, both in temperatures]))

    def told(found):
        return ", ".join(f"{number(a)} for {number(b)} with both frictions at N = {n}"
                         for n, (a, b) in zip((LOW_N, LARGE_N), found))
    return part, (
        f"Without disc friction, contacts of a disc: {told(contacts)} (loose: fewer); granular "
        f"temperature in m v²: {told(temperatures)} (gas-like: higher)." +
        (f" Most runs are not shown to be steady, and decide nothing: {'; '.join(drift)}."
         if drift else ""))


def smallest_times(folder):
    rows = folder.table("times")
    # The smallest of n independent times falls as 1/n (twelve runs of 10^6 events with friction:
    # log10 −8.77 ± 0.15; their tenths: −7.72 ± 0.05): shorter runs than the paper's have larger ones,
    # by that factor. Without friction the discs get faster as long as a run lasts, so that the
    # beginning of a run says nothing of the whole.
    events = rows[0]["events"]
    found = {mu: scattered([math.log10(row["smallest"] * events / EVENTS)
                            for row in tables.select(rows, mu=mu) if row["smallest"] > 0],
                           least=SCATTER_OF_SMALLEST)
             for mu in SMALLEST}
    spread = math.log10(TIMES_AROUND)
    agree = [within(found[mu], math.log10(said) - spread, math.log10(said) + spread)
             if mu > 0 or events >= EVENTS else Part(UNDECIDED) for mu, said in SMALLEST.items()]

    def told(mu):
        v = found[mu]
        return (f"{10 ** v.mean:.1g} (times or divided by {10 ** v.error:.1f})" if v.known
                else "not known")
    counted = "" if events == EVENTS else (
        f", estimated from runs of {events:,.0f} events by the 1/n that the smallest of n times falls with "
        "(not so without friction, where discs get faster all the time)")
    return parts(*agree), (
        f"The smallest time between two collisions of a run of a million events at N = {LARGE_N}"
        f"{counted}, is {told(1.0)} with friction, {told(0.0)} without (around: within a factor of "
        f"{TIMES_AROUND:.0f}).")


def blow_up(folder):
    rows = folder.table("energy")

    def series(sides):
        return sorted(tables.select(rows, sides=float(sides)), key=lambda row: row["swirl"])

    def growth(sides):
        """From the second tenth to the last, after the discs have been set in motion."""
        energy = [row["energy"] for row in series(sides)]
        edges = [len(energy) * k // TENTHS for k in range(TENTHS + 1)]
        return trend([sum(energy[a:b]) / (b - a) for a, b in zip(edges[1:], edges[2:])])

    run = series(SIDES)
    crashed = not all(math.isfinite(row["energy"]) for row in run)
    return parts(above(growth(SIDES), GROWTH), true(crashed)), (
        f"In {run[-1]['swirl']:.0f} swirls at N = {run[0]['discs']:.0f}, from the second tenth to the "
        f"last, the energy grows by {number(growth(SIDES))} of its mean on {SIDES} sides, by "
        f"{number(growth(6))} on 6 and by {number(growth(0))} on the true circle (it blows up: more "
        f"than {GROWTH}); this program does {'' if crashed else 'not '}crash.")


def ball(folder):
    rows = folder.table("ball")
    rolling = [value(row, "gamma") for row in tables.select(rows, mu=1.0, restitution=0.5)]
    slipping = [value(row, "gamma") for row in tables.select(rows, mu=0.0)]
    shares = [row["slip"] for row in tables.select(rows, mu=1.0, restitution=0.5)]
    return parts(every([above(g, 1) for g in rolling]), every([below(g, 1) for g in slipping])), (
        f"γ of one large disc with μ = 1 that stays at the wall (e = 0.5): "
        f"{min(g.mean for g in rolling):.3f} to {max(g.mean for g in rolling):.3f}, "
        f"{min(shares):.3f} to {max(shares):.3f} of γ_c: it counterrotates. Without friction "
        f"nothing turns it: γ = {slipping[0].mean:.3f}, so that it neither rotates nor "
        "counterrotates; the paper has γ = 0 there.")


def elastic(folder):
    found = [folder.crossing("restitution", e) for e in ("1", "0.99", "0.9")]
    text = "; ".join(f"e = {e}: {c.text}" for e, c in zip((1, 0.99, 0.9), found))
    return found[0].crosses, text + "."


def untestable(why):
    return lambda folder: (Part(UNTESTABLE), why)


def near_36(folder):
    c = folder.crossing("5b", "high")
    return Part(UNTESTABLE), (
        f"The friction of the real spheres is not known. The simulation with μ = 1, I = 10 has "
        f"{c.text}.")


# --- spheres that roll: the experiment itself -------------------------------------------------

def spheres_at(folder, figure, curve, discs):
    rows = [row for row in folder.table(figure)
            if str(row["curve"]) == curve and row["discs"] == discs]
    return value(rows[0], "by_time")


def for_some_friction(folder, figure, judge):
    """A statement on spheres is true if it is for one of the frictions, as that of the experiment's
    is not known. `judge` takes the rows of one friction and returns its verdict and words."""
    judged = [(mu, *judge(folder.curve(figure, most=math.inf, mu=mu)))
              for mu in sorted({row["mu"] for row in folder.table(figure)})]
    found = [part for _, part, _ in judged]
    told = "; ".join(f"μ = {mu:g}: {words}" for mu, _, words in judged)
    return either(found), f"{told}. It holds for {count(found)} of {len(found)} frictions"


def at(rows, discs):
    return [row for row in rows if row["discs"] == discs][0]


def spheres_transition(folder):
    def judge(rows):
        dense = [at(rows, n) for n in DENSE_SPHERES]
        return (every([above(value(rows[0], "by_time"), 0)] +
                      [below(v, 0) for v in values(dense, "by_time")]),
                ", ".join(f"{number(value(row, 'by_time'))} at N = {row['discs']:.0f}"
                          for row in [rows[0], *dense]))

    part, told = for_some_friction(folder, "spheres", judge)
    return part, f"ϖ/Ω with their real moment of inertia: {told}."


def last_changes(folder):
    """Of each friction the last change to counterrotation: from there on all counterrotate."""
    rows = tables.select(folder.table("spheres_sense"), sense="counterrotation")
    points = folder.table("spheres")
    found = {}
    for row in rows:
        near = {p["point"] for p in points
                if p["mu"] == row["mu"] and row["before"] <= p["discs"] <= row["after"]}
        found[row["mu"]] = Value(row["crossing"], row["crossing_error"], near)
    return found


def listed(changes):
    return "; ".join(f"μ = {mu:g}: {number(at)}" for mu, at in sorted(changes.items()))


def spheres_change_near(discs):
    """For some friction, as that of the experiment's spheres is not known: one of those that were
    run, or one between two of them, where the N of the change passes this one."""
    def judge(folder):
        changes = sorted(last_changes(folder).items())
        near = [within(at, discs - ROUGHLY, discs + ROUGHLY) for _, at in changes]
        steps = list(zip(changes, changes[1:]))
        passed = [every([above(rarer, discs), below(sooner, discs)])
                  for (_, rarer), (_, sooner) in steps]
        between = "".join(
            f"; it passes {discs} between μ = {low:g} and {high:g}"
            for ((low, _), (high, _)), part in zip(steps, passed) if part.verdict == HOLDS)
        return either(near + passed), (
            f"N of the last change to counterrotation, {listed(dict(changes))}{between} "
            f"(roughly: within {ROUGHLY:.0f} of {discs}; the friction of the spheres is not "
            "known).")
    return judge


def spheres_friction_order(folder):
    changes = sorted(last_changes(folder).items())
    steps = [below(b, a) for (_, a), (_, b) in zip(changes, changes[1:])]
    return every(steps), f"N of the last change to counterrotation, {listed(dict(changes))}."


def spheres_minimum(folder):
    def judge(rows):
        lowest, last, rise = after_minimum(rows, "by_time")
        return (every([below(value(lowest, "by_time"), 0), above(rise, 0)]),
                f"lowest before the end {number(value(lowest, 'by_time'))} at N = "
                f"{lowest['discs']:.0f}, at the end {number(value(last, 'by_time'))} at N = "
                f"{last['discs']:.0f}")

    part, told = for_some_friction(folder, "spheres", judge)
    return part, f"ϖ/Ω: {told}."


def frustrated(folder, name, full, ending):
    """At one friction: do dense spheres counterrotate, and is ϖ higher without vertical friction?"""
    pairs = [[spheres_at(folder, name, curve, n) for n in DENSE_SPHERES]
             for curve in (full, *(f"no-vertical{where}{ending}" for where in ("", "-disc", "-wall")))]
    told = "; ".join(
        f"{words}: " + ", ".join(f"{number(v)} at N = {n}" for v, n in zip(found, DENSE_SPHERES))
        for words, found in zip(("all ingredients", "without vertical friction",
                                 "without it between spheres alone", "without it at the wall alone"),
                                pairs))
    alone = every([above(v, 0) for v in pairs[1]]).verdict
    said = {HOLDS: "certainly rotate", FAILS: "do not all rotate"}.get(alone, "perhaps rotate")
    return parts(every([below(v, 0) for v in pairs[0]]),
                 every([above(without, v) for v, without in zip(pairs[0], pairs[1])])), (
        f"ϖ/Ω with {told}; without vertical friction they {said}")


def spheres_frustration(folder):
    """For some friction, as all that is said of spheres."""
    found = [(f"{PLASTIC:g}", *frustrated(folder, "spheres_ingredients", f"{PLASTIC:g}", ""))]
    try:
        found.append((f"{ROUGHER:g}", *frustrated(folder, "spheres_ingredients_rough",
                                                  f"{ROUGHER:g}", "-rough")))
    except FileNotFoundError:
        pass  # it was not asked for
    told = ". ".join(f"μ = {mu}: {words}" for mu, _, words in found)
    return either([part for _, part, _ in found]), (
        f"{told}. That they rotate without it is no claim of the paper's.")


def spheres_elastic(folder):
    found = [spheres_at(folder, "spheres_ingredients", "no-damping", n) for n in DENSE_SPHERES]
    return every([below(v, 0) for v in found]), (
        "With e = 1, but the floor as it is: ϖ/Ω = " + ", ".join(
            f"{number(v)} at N = {n}" for v, n in zip(found, DENSE_SPHERES)) + ".")


def of_spheres(judge_rows):
    """What one friction's rows say of the pinned."""
    def judge(folder):
        part, told = for_some_friction(folder, "spheres_pinned", judge_rows)
        return part, f"Spheres, {told}."
    return judge


def spin_falls(rows):
    rows = [row for row in rows if row["stay_spin"] == row["stay_spin"]]
    part, but = rising(rows, "stay_spin", falling=True)
    return part, (f"|ω_z|/Ω of those on a stay at the wall {ends(rows, 'stay_spin')}{but}, of those "
                  f"pinned there by the SI's criterion {ends(rows, 'pinned_wall_spin')}")


def slip_from_a_half(rows):
    part, but = rising(rows, "slip_stays")
    half = [within(value(row, "slip_stays"), 0.5 - ABOUT_A_HALF, 0.5 + ABOUT_A_HALF)
            for row in rows if abs(row["discs"] - 25) <= ROUGHLY]
    return parts(part, either(half), above(value(rows[-1], "slip_stays"), NEARLY_ONE)), (
        f"{ends(rows, 'slip_stays')}{but}, of all pinned by the SI's criterion "
        f"{ends(rows, 'pinned_region')}")


def spheres_slip(folder):
    part, told = for_some_friction(folder, "spheres_pinned", slip_from_a_half)
    return part, (f"s of those on a stay at the wall, {told} (approximately 0.5: within "
                  f"{ABOUT_A_HALF}; nearly 1: above {NEARLY_ONE}).")


def spheres_slip_rough(folder):
    frictions = sorted({row["mu"] for row in folder.table("spheres_pinned")})
    smooth, rough = (folder.curve("spheres_pinned", most=math.inf, mu=mu)
                     for mu in (frictions[0], frictions[-1]))
    part, found = closer_to_one(rough, smooth)
    return part, (f"s of those on a stay at the wall is closer to 1 for μ = {frictions[-1]:g} than "
                  f"for μ = {frictions[0]:g}, {found}.")


def spheres_kept_from_rolling(folder):
    def judge(rows):
        wall, every_one = (value(rows[-1], name) for name in ("wall_rolling_share", "rolling_share"))
        return below(wall, every_one), (
            f"{number(wall)} at the wall, {number(every_one)} of all at N = {rows[-1]['discs']:.0f}")

    part, told = for_some_friction(folder, "spheres_pinned", judge)
    return part, f"Share of the spheres that roll: {told}."


CLAIMS = [
    Claim("main text, Fig. 5b", "With friction at the wall and between the discs the cluster "
          "rotates with the swirl at low N and counterrotates at high N.", "5b", transition),
    Claim("main text, Fig. 1b", "Beyond the crossing ϖ reaches a minimum and then rises slightly "
          "for the largest N.", "5b", minimum),
    Claim("main text, Fig. 5b", "The less friction, the higher the N at which the sense changes.",
          "5b", friction_order),
    Claim("main text, Fig. 5b", "Without wall friction the cluster turns with the swirl's own "
          "frequency at every N.", "5b", no_wall_at_omega),
    Claim("main text, Fig. 5b", "Without wall friction there is never a transition.", "5b",
          never_crosses("no-wall")),
    Claim("main text, Fig. 5b", "Without disc friction ϖ remains close to Ω.", "5b",
          no_disc_close),
    Claim("main text, Fig. 5b", "Without disc friction ϖ drops slightly at very high N.", "5b",
          no_disc_drop),
    Claim("main text, Fig. 5b", "Without disc friction there is never a transition.", "5b",
          never_crosses("no-disc")),
    Claim("main text, Fig. 2", "In the M-frame the discs are in a statistical steady state.", "5b",
          steady),
    Claim("main text, Figs 2 and 3", "In the M-frame all discs circulate clockwise.", "3a",
          clockwise),
    Claim("main text, Fig. 1b", "With growing N the cluster behaves more and more like a pancake "
          "that rolls on the wall.", "1b", pancake),
    Claim("main text, Fig. 3b", "Pinned discs lag behind the wall at low N and move with it at "
          "high N.", "3b", pinned_reach_wall),
    Claim("main text, Fig. 3a", "In the pinned region |ϖ_M| rises with N.", "3a", pinned_faster),
    Claim("main text, Fig. 3a", "In the loose region ϖ_M rises and falls in a similar way at all "
          "N; only the place of the peak differs.", "3a", loose_peak),
    Claim("main text, Fig. 3", "With N discs enter the pinned region earlier in their cycle.",
          "3a", pinned_earlier),
    Claim("main text, Fig. 2c", "The pinned region grows with N.", "3a", pinned_grows),
    Claim("main text, Fig. 3", "Discs leave the pinned region at the same place for all N.", "3a",
          free_fixed),
    Claim("main text, Fig. 4a", "The slip parameter of the pinned discs rises with N to nearly 1.",
          "4a", slip_rises),
    Claim("main text, Fig. 4a", "It is closer to 1 for rough discs than for smooth ones.", "4a",
          slip_rough),
    Claim("main text, Fig. 4b", "The spin of the discs along the wall in the pinned region falls "
          "with N.", "4b", wall_spin),
    Claim("main text", "The interaction between the spins of discs in strong contact is "
          "antiferromagnetic-like: their senses are opposed.", "4b", gears),
    Claim("main text", "At high N six-fold packing is often seen in the pinned region.", "4b",
          six_fold),
    Claim("main text", "The more discs, the more collisions has each of them.", "4b",
          more_collisions),
    Claim("main text, Fig. 2", "The Coriolis force makes the discs tend to the left of M.", "1b",
          left_of_M),
    Claim("main text", "The centrifugal force on a disc goes up to 460 cm/s², the Coriolis force to "
          "200.", "1b", forces),
    Claim("main text, Fig. 3a", "|ϖ_M| falls in the transition regions because the cluster is oblong: "
          "discs are farther from its centre there, and as fast.", "3a", oblong),
    Claim("main text", "Without wall friction the discs have very little internal movement in the "
          "M-frame.", "states", rim),
    Claim("main text", "Without disc friction the cluster is loose and gas-like.", "states", gas),
    Claim("SI", "The smallest time between collisions is around 10⁻¹¹ with friction and 10⁻⁹ "
          "without.", "times", smallest_times),
    Claim("main text, Fig. 4c", "Rough discs change the sense at a lower N than smooth ones.",
          "4c", rough_earlier),
    Claim("main text", "Damping of the normal motion is not needed for the transition.",
          "restitution", elastic),
    Claim("main text", "A single ball counterrotates if it rolls on the wall and rotates if it "
          "slips freely.", "ball", ball),
    Claim("SI", "With both frictions zero the energy blows up and the program crashes.", "energy",
          blow_up),
    Claim("main text, Fig. 1b", "In the experiment the sense changes at roughly N = 36.", "5b",
          near_36),
    Claim("main text, Fig. 4", "Roughened plastic spheres cross at N = 28, smooth ones at 36.",
          "", untestable("It depends on the surfaces of the real spheres, whose friction "
                         "coefficients the paper does not give.")),
    Claim("main text", "Discs at the wall are kept from rolling on the ground.", "spheres_pinned",
          spheres_kept_from_rolling),
    Claim("experiment, Fig. 1b", "Few spheres rotate with the swirl, many counterrotate.", "spheres",
          spheres_transition),
    Claim("experiment, Fig. 1b", "Spheres of smooth plastic change their sense at roughly N = 36.",
          "spheres_sense", spheres_change_near(36)),
    Claim("experiment, Fig. 4", "Roughened spheres change it at N = 28.", "spheres_sense",
          spheres_change_near(28)),
    Claim("experiment, Fig. 4c", "The rougher the spheres, the lower the N at which the sense "
          "changes.", "spheres_sense", spheres_friction_order),
    Claim("experiment, Fig. 1b", "Beyond the crossing ϖ of spheres reaches a minimum and then rises "
          "slightly for the largest N.", "spheres", spheres_minimum),
    Claim("title", "Geometric frustration induces counterrotation: spheres counterrotate, and without "
          "what frustrates their rolling, vertical friction, ϖ is higher.", "spheres_ingredients",
          spheres_frustration),
    Claim("main text", "Damping is not needed for spheres to counterrotate.", "spheres_ingredients",
          spheres_elastic),
    Claim("experiment, Fig. 4a", "The slip parameter of pinned spheres rises with N, from "
          "approximately 0.5 at N = 25 to nearly 1.", "spheres_pinned", spheres_slip),
    Claim("experiment, Fig. 4a", "It is closer to 1 for roughened spheres than for smooth ones.",
          "spheres_pinned", spheres_slip_rough),
    Claim("experiment, Fig. 4b", "The spin of pinned spheres at the wall falls with N.",
          "spheres_pinned", of_spheres(spin_falls)),
    Claim("experiment, Fig. 3", "With N spheres enter the pinned region earlier in their cycle.",
          "spheres_pinned", of_spheres(earlier)),
    Claim("experiment, Fig. 3", "Spheres leave the pinned region at the same place for all N.",
          "spheres_pinned", of_spheres(same_place)),
    Claim("experiment, Fig. 2c", "The pinned region of spheres grows with N.", "spheres_pinned",
          of_spheres(grows)),
]


def all_verdicts(folder):
    """What `swirl paper` reads: every verdict, and the points to spend more seeds on."""
    judged = [(claim, *claim.judged(folder)) for claim in CLAIMS]
    return {"verdicts": [{"says": claim.says, "verdict": part.verdict, "found": found,
                          "points": sorted(part.points)} for claim, part, found in judged],
            "points_to_decide": sorted(set().union(*(part.points for _, part, _ in judged)))}


def main():
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print(f"usage: /usr/bin/python3 {sys.argv[0]} FOLDER\n"
              "judges the tables that `swirl paper --out FOLDER` left there; writes verdicts.json",
              file=sys.stderr)
        sys.exit(0 if sys.argv[1:] in (["-h"], ["--help"]) else 2)
    file = os.path.join(sys.argv[1], "verdicts.json")
    try:
        whole_file.write(file, json.dumps(all_verdicts(sys.argv[1]), indent=1, ensure_ascii=False) + "\n")
    except OSError as error:
        sys.exit(f"'{file}' could not be written: {error.strerror}.")


if __name__ == "__main__":
    main()
