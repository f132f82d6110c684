"""The paper's claims, and what the tables say of each.

A claim has a function that reads the tables and returns a verdict with the numbers it rests on. No
verdict is written by hand: all come from the rules of verdicts.py, with three standard errors as
the one threshold; every other number is a constant with a name, below. A sign is not enough: each
claim has a size that would matter, with a reason from the paper's words, from what its figures can show,
or from physics.

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
import atomic_file
from verdicts import (FAILS, HOLDS, IN_PART, MISSING, UNDECIDED, UNTESTABLE, Part, Value,  # noqa: F401
                      above, agreed, below, either, every, falls, largest_reversal, mean_of,
                      measured, parts, rises, scattered, trend, true, within)

# The sizes that matter.
#
# Less than a turn in 200 periods is no rotation: the paper's run of 10^6 events at N = 48 is not much
# longer (SI: 10^6 events; here 3400 a period). In units of Ω.
TURNS = 0.005
# "Transitions to counterrotation at a lower N", "occurs at higher N": N is a whole number.
ONE_DISC = 1.0
# "Quantitatively similar": within this share of the mean.
SIMILAR = 0.15
# "Increases", "decreases", "fewer", "hotter", "quickly", "accelerates": by more than what is still
# similar, of what it was at first or of what it is compared with.
MATTERS = SIMILAR
# "Dictating antiferromagnetic-like interactions for spinning ... for six-fold packing": half of the
# correlation that neighbours have in the ground state of the antiferromagnet (Ising) on the triangular
# lattice, −1/3, where of the three pairs of every triangle two are opposed.
ANTIFERROMAGNETIC = -1 / 6
# "Prohibiting any", "often", "the major contributor": more than a half, or less.
MOST = 0.5
# The slip parameter "increases from approximately 0.5 at N = 25 to nearly 1": a fifth of that 0.5. Two
# values of s that are closer than a symbol of Figure 4a is high are the same.
SLIP_RISES, SLIP_APART = 0.1, 0.02
# "Resulting in the beads tending to the left": more than 55 % of the discs, and the centre of mass a
# tenth of a disc's radius.
LEFT_SHARE, LEFT_SHIFT = 0.55, 0.1
# "Near the bottom-left of the container (near M)": in degrees, within an eighth of a turn of M, and left of
# it by the width of a slice of θ.
NEAR_M, LEFT_OF_M = 45.0, 5.0
# "Induced by frustration": this share of the counterrotation is gone without it.
INDUCED = 0.5

# What the paper leaves open.
NEAR_OMEGA = 0.05          # of Ω: "remains at that of the container"
CLOSE_TO_OMEGA = 0.1       # of Ω: "remains close to the container velocity"
HIGH_N = 41                # from here on N is "very high": above, a curve may drop
SLIGHT_DROP = TURNS        # of Ω: the least that is a drop, or a rise after a minimum
NEAR_PANCAKE = 0.05        # of Ω: "increasingly similarly to a model particle with no slip"
SAME_PLACE = 20.0          # degrees: "at the same location"
EARLIER = 10.0             # degrees: the least that is "earlier in its cycle"
NEARLY_ONE = 0.9           # "nearly 1", of the slip parameter
ALMOST_ALL = 0.9           # of the spheres: "they form a line that rolls along the container wall"
FEW = 8                    # "only a few marbles"
# Of the gap between a disc's centre and the wall, in radii: the first and the second layer of a packing
# against the wall (rows are √3 to 2 apart), and what lies between them.
FIRST_LAYER, BETWEEN_LAYERS, SECOND_LAYER = (1.0, 1.4), (1.6, 2.4), (2.6, 3.2)
# Of Voronoi cells of points thrown at random (Brakke 1986: 0.2947).
SIX_BY_CHANCE = 0.29
ABOUT_A_HALF = 0.1         # either way: "approximately 0.5", of the slip parameter
AT_THE_WALL = 0.05         # "approaches 1", of the normalised angular velocity
CHANCE_OF_DRIFT = 0.05     # share of the runs that may drift in a steady state
PERIOD, RADIUS, AMPLITUDE = 11.866071, 8.6, 1.892  # of the swirl, of the dish (SI)
# Of the experiment: 11.81 rad/s and discs of 3 mm radius. One r Ω² in cm/s².
EXPERIMENTS_R_OMEGA_SQUARE = 0.3 * 11.81 ** 2
GROWTH = 0.2               # of its mean: an energy that grows more "blows up"
IDENTICAL = 0.01           # of Ω: two means of the same runs, taken at different times
LITTLE_MOTION = 0.1        # of ΩR, in the M-frame: "very little internal movement"
TENS = 10.0                # cm/s²: the digits of "0–460" and "0–200"
TIMES_AROUND = 10.0        # factor either way: "around" a time
LEAST_VISITS = 200         # of a slice of θ that is looked at
ROUGHLY = 2.0              # spheres either way: "at roughly N = 36"
JUMP = 2 * ROUGHLY         # between neighbouring frictions: more is no continuous change
PLASTIC, ROUGHER = 0.2, 0.3  # frictions of the spheres of plastic, where one or two are chosen
DENSE_SPHERES = (44, 48)   # where all agree that they counterrotate

# What the paper says.
MOST_DISCS = 48            # "for each N between 5 and 48" (SI)
EXPERIMENTS_N = (24, 48)   # "N (ranging from 24 to 48)"
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
        near = self.rows_near(name, curve, row, named)
        runs = [r["averaged_runs"] for r in near if "averaged_runs" in r]
        return Crossing(row, {r["point"] for r in near if "point" in r},
                        min(runs) - 1 if runs else math.inf)

    def rows_near(self, name, curve, crossing, named):
        """Rows of this curve at the numbers of discs that its crossing, or its lowest point, rests on."""
        try:
            rows = self.table(name)
        except FileNotFoundError:
            return []
        at = (crossing_value(crossing).mean if crossing["verdict"] == "crosses"
              else crossing["lowest_discs"])
        return [row for row in rows
                if any(key in row and named(row, key) for key in ("setting", "curve"))
                and abs(row["discs"] - at) <= NEAR_CROSSING]

    def curve(self, name, most=MOST_DISCS, **wanted):
        """Rows in order of N, up to the paper's last."""
        rows = [row for row in tables.select(self.table(name), **wanted)
                if row.get("steady_state") != "failed" and row["discs"] <= most]
        return sorted(rows, key=lambda row: row["discs"])


def crossing_value(row, points=(), freedom=math.inf):
    """N_c of a row; `freedom` is that of the points' errors. For a bracket: its middle, with the
    standard deviation of an even distribution, which is exact."""
    at, error = row["crossing"], row["crossing_error"]
    if at != at and "lower" in row:
        lower, upper = row["lower"], row["upper"]
        return Value((lower + upper) / 2, (upper - lower) / math.sqrt(12), points)
    return Value(at, error, points, freedom)


def crossing_words(row):
    if row["crossing"] != row["crossing"] and "lower" in row:
        return f"between {row['lower']:g} and {row['upper']:g}"
    return number(Value(row["crossing"], row["crossing_error"]))


def crossing_sentence(words):
    """N_c, for a sentence: "N_c = 38.2 ± 0.1" or "N_c between 36 and 40"."""
    return f"N_c {words}" if words.startswith("between") else f"N_c = {words}"


class Crossing:
    def __init__(self, row, points, freedom=math.inf):
        self.verdict, self.points = row["verdict"], points
        self.at, self.words = crossing_value(row, points, freedom), crossing_words(row)
        self.lowest = Value(row["lowest"], row["lowest_error"], points, freedom)
        self.lowest_discs = row["lowest_discs"]

    @property
    def crosses(self):
        if self.verdict == "undecided":
            return Part(UNDECIDED, self.points)
        return true(self.verdict == "crosses")

    @property
    def text(self):
        if self.verdict == "crosses":
            return crossing_sentence(self.words)
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


def rising(rows, name, falling=False, least=None):
    """The verdict on a curve that should rise (or fall) with N by `least` (or MATTERS of its first
    value), and where it goes back farthest, in words."""
    rows = [row for row in rows if row[name] == row[name]]
    found = values(rows, name)
    sought = [-v for v in found] if falling else found
    if least is None:
        least = MATTERS * abs(found[0].mean)
    part, back = rises(sought, least), largest_reversal(sought)
    if back is None or part.verdict == HOLDS:
        return part, ""
    a, b = (rows[k] for k in back)
    return part, (
        f", but it {'rises' if falling else 'falls'} from {number(value(a, name))} at N = "
        f"{a['discs']:.0f} to {number(value(b, name))} at N = {b['discs']:.0f}")


def count(statements, verdict=HOLDS):
    return sum(s.verdict == verdict for s in statements)


# --- the judges -------------------------------------------------------------------------------

def transition(folder):
    c = folder.crossing("5b", "high")
    rows = folder.curve("5b", setting="high")
    return (parts(above(value(rows[0], "by_event"), TURNS), c.crosses,
                  below(value(rows[-1], "by_event"), -TURNS)),
            f"{c.text}; ϖ/Ω = {ends(rows, 'by_event')} (μ = 1; rotation: more than {TURNS} Ω).")


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
    return above(rise, SLIGHT_DROP), f"{text} (A rise is more than {SLIGHT_DROP} Ω.)"


def friction_order(folder):
    found = [folder.crossing("5b", name) for name in ("high", "medium", "low")]
    text = "; ".join(f"μ = {mu}: {c.text}" for mu, c in zip((1, 0.5, 0.1), found)) + "."
    steps = []
    for a, b in zip(found, found[1:]):
        if b.verdict == "crosses":
            steps.append(above(b.at - a.at, ONE_DISC))
        else:
            # A curve that rotates at every N crosses later than one that crosses, if at all.
            steps.append(every([a.crosses, true(b.verdict == "always rotates")
                                if b.verdict != "undecided" else Part(UNDECIDED, b.points)]))
    return every(steps), text


# Columns that count the runs of a point that are not steady, and what such runs do.
CHANGES = {"drifting_runs": "drift", "jumping_runs": "jump",
           "switching_runs": "switch between two states"}


def changing(row):
    """How many runs are not steady; 0 in a table without these columns."""
    return sum(row.get(kind, 0) for kind in CHANGES)


def drifts(row):
    """Whether most runs are not steady: their average is not that of one state."""
    return "seeds" in row and changing(row) > MOSTLY * row["seeds"]


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
    """Beyond the paper's N = 48, too, where it was run: a scan that stops says nothing of what follows."""
    def judge(folder):
        rows = [row for row in folder.curve("5b", most=math.inf, setting=setting)
                if row["by_event"] == row["by_event"]]
        lowest = min(rows, key=lambda row: row["by_event"])
        still = [above(v, -TURNS) for v in values(rows, "by_event")]
        return every(still), (
            f"ϖ/Ω is certainly not below −{TURNS} at {count(still)} of {len(rows)} N from "
            f"{rows[0]['discs']:.0f} to {rows[-1]['discs']:.0f}; lowest is "
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
    judged = [row for row in rows if row["steady_runs"] + changing(row) > 0]
    open_ones = [row for row in rows if row["steady_runs"] < row["seeds"]] or rows
    points = {row["point"] for row in open_ones if isinstance(row.get("point"), str)}
    if not judged:
        return Part(UNDECIDED, points), "All runs are too short to tell."
    runs = [row["steady_runs"] + changing(row) for row in judged]
    # Every point counts once, however many seeds were spent on it: they are spent where runs change.
    share = sum(changing(row) / n for row, n in zip(judged, runs)) / len(judged)
    # The error of a point as if one more of its runs had been seen, that changes as often as all do;
    # of no changing run among n one knows only that the share is below about 1/n.
    seen = [(changing(row) + share) / (n + 1) for row, n in zip(judged, runs)]
    error = math.sqrt(sum(p * (1 - p) / n for p, n in zip(seen, runs))) / len(judged)
    found = Value(share, max(error, 1 / sum(runs)), points)
    # A point most of whose runs change has no steady state, however steady the others are.
    exceptions = [row for row in judged if changing(row) > MOSTLY * row["seeds"]]
    overall = below(found, CHANCE_OF_DRIFT)
    part = parts(overall, true(False)) if exceptions else overall
    kinds_found = [f"{sum(row.get(kind, 0) for row in judged):.0f} {word}"
                   for kind, word in CHANGES.items()]
    return part, (
        f"Of {sum(runs):.0f} runs with both frictions after 20 periods, {', '.join(kinds_found)} "
        f"({sum(row['seeds'] for row in rows) - sum(runs):.0f} more are too short to tell). This is "
        f"a share of {number(found)} if every N and friction counts alike; "
        f"{100 * CHANCE_OF_DRIFT:.0f} % are allowed for chance and slow states." +
        (" Most runs change at "
         f"{', '.join(str(row.get('point', row['discs'])) for row in exceptions)}, so these have "
         "no steady state within the paper's run." if exceptions else ""))


def clockwise(folder):
    rows = [row for row in folder.table("3a") if row["visits"] > LEAST_VISITS]
    negative = [below(v, -TURNS) for v in values(rows, "varpi_m")]
    fastest = max(rows, key=lambda row: row["varpi_m"])
    return every(negative), (
        f"⟨ϖ_M⟩ is certainly negative in {count(negative)} of {len(rows)} slices of θ and N, "
        f"certainly positive in {count(negative, FAILS)}; the highest is "
        f"{number(value(fastest, 'varpi_m'))} Ω.{identity(folder)}")


def pancake(folder):
    rows = folder.curve("1b", setting="high")
    gap = [abs(value(row, "by_time") - value(row, "pancake")) for row in rows]
    return parts(below(gap[-1] - gap[0], -MATTERS * gap[0].mean), below(gap[-1], NEAR_PANCAKE)), (
        f"Distance from the pancake's line: {number(gap[0])} Ω at N = {rows[0]['discs']:.0f}, "
        f"{number(gap[-1])} Ω at N = {rows[-1]['discs']:.0f}.")


def pinned_slices(rows):
    """Slices between the beginning and the end of a residence at the wall, clockwise (θ falling)."""
    start, end = rows[0]["residence_begin"], rows[0]["residence_end"]
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
    return parts(below(first, 1 - AT_THE_WALL), within(last, 1 - AT_THE_WALL, 1 + AT_THE_WALL)), (
        f"Normalised angular velocity in the pinned region: {ends(rows, 'mean')} (slower than the "
        f"wall, or as fast: by {AT_THE_WALL}).")


def pinned_faster(folder):
    rows = pinned_means(folder, "3a", "varpi_m")
    part, but = rising(rows, "mean", falling=True, least=NEAR_OMEGA)
    return part, (f"⟨ϖ_M⟩/Ω in the pinned region: {ends(rows, 'mean')}{but} (asked: a change of more "
                  f"than {NEAR_OMEGA}).")


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


def pinned_contribution(folder):
    """ϖ_M = p P + (1 − p) L: the share p of the visits to the pinned region, and ⟨ϖ_M⟩ there and in the
    loose one. From few discs to many each of the three changes, and the changes add up exactly if each
    counts with the mean of the other factor at both ends."""
    profile, found = folder.table("3a"), []
    numbers = sorted({row["discs"] for row in profile})
    for discs in (numbers[0], numbers[-1]):
        here = [row for row in tables.select(profile, discs=discs) if row["visits"] > 0]
        pinned = pinned_slices(here)
        loose = [row for row in here if row not in pinned]
        means = []
        for rows in (pinned, loose):
            visits = [row["visits"] for row in rows]
            mean = mean_of(values(rows, "varpi_m"), visits)
            # Slices of one run are not independent of each other: their errors add up.
            error = sum(w * row["varpi_m_error"] for w, row in zip(visits, rows)) / sum(visits)
            means.append(Value(mean.mean, error, mean.points))
        share = sum(row["visits"] for row in pinned) / sum(row["visits"] for row in here)
        found.append((share, *means))
    (few, pinned_few, loose_few), (many, pinned_many, loose_many) = found
    share = (few + many) / 2
    by_pinned = (pinned_many - pinned_few) * share
    by_loose = (loose_many - loose_few) * (1 - share)
    by_share = ((pinned_few.mean + pinned_many.mean) - (loose_few.mean + loose_many.mean)) / 2 * (many - few)
    return numbers, by_pinned, by_loose, by_share


def pinned_decides(folder):
    numbers, pinned, loose, share = pinned_contribution(folder)
    total = pinned.mean + loose.mean + share
    # More than half of the whole: more than all the rest of it, with the sign of the whole.
    sign = -1 if total < 0 else 1
    lead = (pinned - loose - share) * sign
    return above(lead, (2 * MOST - 1) * abs(total)), (
        f"From N = {numbers[0]:.0f} to {numbers[-1]:.0f} ⟨ϖ_M⟩/Ω changes by {number(Value(total))}: by "
        f"{number(pinned)} as the pinned discs are faster, by {number(loose)} as the loose ones are, and by "
        f"{number(Value(share))} as more are pinned (the major contributor: more than {MOST:.0%}).")


def loose_accelerate(folder):
    profile, gains, told = folder.table("3a"), [], []
    for discs in sorted({row["discs"] for row in profile}):
        here = [row for row in tables.select(profile, discs=discs) if row["visits"] > LEAST_VISITS]
        pinned = pinned_slices(here)
        loose = [row for row in here if row not in pinned]
        free = value(nearest_slice(here, here[0]["residence_end"]), "speed")
        fastest = max(loose, key=lambda row: row["speed"])
        gains.append(above(value(fastest, "speed") - free, MATTERS * free.mean))
        told.append(f"{number(free)} where they become free and {number(value(fastest, 'speed'))} at θ = "
                    f"{fastest['theta']:.0f}° for N = {discs:.0f}")
    return every(gains), (
        "Speed about the centre of mass in the M-frame, in units of the container's speed: "
        f"{told[0]}; {told[-1]}. Faster by more than {MATTERS:.0%} for certain at {count(gains)} of "
        f"{len(gains)} N.")


def in_degrees(row):
    return math.degrees(math.atan2(row["y"], row["x"])) % 360


def layers(folder):
    """The number density in the pinned region against the gap to the wall."""
    discs = tables.select(folder.table("3a"), discs=LARGE_N)
    begin, end = discs[0]["residence_begin"], discs[0]["residence_end"]
    cells = [row for row in folder.table("2c") if row["map"] == "density" and row["density_error"] >= 0
             and (begin - in_degrees(row)) % 360 <= (begin - end) % 360]

    def density(span):
        here = [row for row in cells if span[0] <= RADIUS - math.hypot(row["x"], row["y"]) < span[1]]
        # Cells of one run are not independent of each other.
        return Value(sum(row["density"] for row in here) / len(here),
                     sum(row["density_error"] for row in here) / len(here), [discs[0].get("point", "")])
    first, between, second = (density(span) for span in (FIRST_LAYER, BETWEEN_LAYERS, SECOND_LAYER))
    return every([above(layer - between * (1 + MATTERS), 0) for layer in (first, second)]), (
        f"Number density of the centres in the pinned region at N = {LARGE_N}, per r²: {number(first)} at a "
        f"gap of {FIRST_LAYER[0]:g} to {FIRST_LAYER[1]:g} radii to the wall, {number(between)} at "
        f"{BETWEEN_LAYERS[0]:g} to {BETWEEN_LAYERS[1]:g}, {number(second)} at {SECOND_LAYER[0]:g} to "
        f"{SECOND_LAYER[1]:g} (layers: denser by {MATTERS:.0%}).")


def top_left(folder):
    """The middle of the pinned region, in the quadrant of 90° to 180°, for the discs of Figures 2b and 2c."""
    middles = []
    for row in [row for row in angles(folder) if row["discs"] in (LOW_N, LARGE_N)]:
        begin, end = value(row, "residence_begin"), value(row, "residence_end")
        ahead = Value((begin.mean - end.mean) % 360, math.hypot(begin.error, end.error), end.points)
        middles.append(Value(end.mean, 0.0, begin.points) - ahead * -0.5)
    if len(middles) < 2:
        raise ValueError("One of the two numbers was not run.")
    return parts(*(within(middle, 90.0, 180.0) for middle in middles)), (
        "The middle between where residences at the wall begin and end is at θ = " + " and ".join(
            f"{number(middle)}° for N = {n}" for middle, n in zip(middles, (LOW_N, LARGE_N))) +
        f" (top left: 90° to 180°; 180° is left, {M_AT:.0f}° is M).")


def one_passage(found):
    """From rotation to counterrotation once: there is a number of discs below which none counterrotates
    and from which on none rotates."""
    return either(every([above(v, -TURNS) for v in found[:k]] + [below(v, TURNS) for v in found[k:]])
                  for k in range(1, len(found)))


def passage(folder):
    rows = [row for row in folder.curve("5b", most=math.inf, setting="high")
            if row["by_event"] == row["by_event"]]
    turning = [row for row in rows if above(value(row, "by_event"), TURNS).verdict == HOLDS]
    against = [row for row in rows if below(value(row, "by_event"), -TURNS).verdict == HOLDS]
    return one_passage(values(rows, "by_event")), (
        f"μ = 1: certainly above {TURNS} Ω at {len(turning)} N, the last of them "
        f"{turning[-1]['discs']:.0f}, and certainly below −{TURNS} Ω at {len(against)}, the first of them "
        f"{against[0]['discs']:.0f}.")


def slip_rises(folder):
    rows = folder.curve("4a", setting="high")
    part, but = rising(rows, "slip_resident", least=SLIP_RISES)
    return parts(part, above(value(rows[-1], "slip_resident"), NEARLY_ONE)), (
        f"s of the discs resident at the wall: {ends(rows, 'slip_resident')}{but} (nearly 1: "
        f"above {NEARLY_ONE}); of all pinned by the SI's criterion: {ends(rows, 'pinned_region')}. "
        "The 0.5 at N = 25 is of the experiment, whose friction is not known.")


def closer_to_one(rough, smooth):
    """Of rows of two frictions: is s "consistently closer to 1" for the rougher? On average over the N
    that both have by SLIP_APART, and at none farther from it by as much."""
    smooth = {row["discs"]: row for row in smooth}
    pairs = [(row, smooth[row["discs"]]) for row in rough if row["discs"] in smooth]
    gains = [abs(value(b, "slip_resident") - 1) - abs(value(a, "slip_resident") - 1) for a, b in pairs]
    mean = mean_of(gains)
    return every([above(mean, SLIP_APART)] + [above(gain, -SLIP_APART) for gain in gains]), (
        f"on average over N by {number(mean)} (asked: {SLIP_APART}); closer for certain at "
        f"{count([above(gain, 0) for gain in gains])} of {len(gains)} N, farther for certain at "
        f"{count([below(gain, 0) for gain in gains])}")


def slip_rough(folder):
    low = folder.curve("4a", setting="low")
    part, found = closer_to_one(folder.curve("4a", setting="high"), low)
    return part, (
        f"s of the discs resident at the wall is closer to 1 for μ = 1 than for μ = 0.1, {found}; "
        f"for μ = 0.1: {ends(low, 'slip_resident')}, of all pinned by the SI's criterion "
        f"{ends(low, 'pinned_region')}.")


def wall_spin(folder):
    rows = folder.curve("4b", setting="high")
    part, but = rising(rows, "resident_spin", falling=True)
    return part, (
        f"⟨|ω|⟩/Ω of the discs resident at the wall: {ends(rows, 'resident_spin')}{but}; of those at the "
        f"wall that are pinned by the SI's criterion: {ends(rows, 'pinned_wall_spin')}. What the "
        "paper calls the reason, frustration, can be counted (no claim of the paper's): the share of "
        f"the contacts that belong to a triangle is {ends(rows, 'triangles')}.")


def lowest_to_highest(rows, name):
    known = sorted(values([row for row in rows if row[name] == row[name]], name),
                   key=lambda v: v.mean)
    return f"{number(known[0])} to {number(known[-1])}"


def gears(folder):
    """In each of the kinds of contact that could be strong, and at every N. Means over N say nothing
    where what is averaged differs between N by many errors."""
    rows = folder.curve("4b", setting="high")

    def opposed(name):
        return every([below(v, ANTIFERROMAGNETIC) for v in values(rows, name)])
    return parts(*(opposed(name) for name in
                   ("correlation_by_impulse", "resident_correlation", "along_wall"))), (
        "Correlation of the spins (gears have −1, independent spins 0; like an antiferromagnet: below "
        f"{number(ANTIFERROMAGNETIC)}) over all N: in disc–disc collisions, each counted with its impulse, "
        f"{lowest_to_highest(rows, 'correlation_by_impulse')}; of a disc resident at the wall and any "
        f"that it touches {lowest_to_highest(rows, 'resident_correlation')}; of neighbours along the wall, "
        f"{lowest_to_highest(rows, 'along_wall')}. Of pairs that are pinned by the SI's criterion: "
        f"{ends(rows, 'pinned_correlation')}; of all touching pairs: {ends(rows, 'spin_correlation')}.")


def rough_earlier(folder):
    rough, smooth = folder.crossing("4c", "high"), folder.crossing("4c", "low")
    text = f"μ = 1: {rough.text}; μ = 0.1: {smooth.text}."
    if smooth.verdict == "crosses":
        return above(smooth.at - rough.at, ONE_DISC), text
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
    """Places and shares of the residences for every choice of the wall's layer and of the least length
    of a residence: (layer in disc radii, length in swirls): rows in order of N."""
    points = {row["discs"]: row.get("point") for row in folder.table("3a")}
    choices = {}
    for row in folder.curve("3a_sensitivity"):
        # The layer is computed from the dish's radius, and its last digit differs between N.
        choice = (round(row["layer"], 6), round(row["min_length"], 6))
        choices.setdefault(choice, []).append(row | {"point": points.get(row["discs"])})
    return choices


def from_to(choices, found):
    """Of numbers found for each choice the lowest and the highest, and what was chosen."""
    found = [v.mean for v in found if v.known]
    layers, lengths = sorted({c[0] for c in choices}), sorted({c[1] for c in choices})
    return (f"{min(found):.0f} to {max(found):.0f}" if found else "not known"), (
        f"{len(choices)} choices of the layer ({layers[0]:g} to {layers[-1]:g} radii from the wall) "
        f"and of the least length of a residence ({lengths[0]:.2f} to {lengths[-1]:.2f} swirls)")


def pinned_grows(folder):
    rows, choices = angles(folder), by_choice(folder)
    found = [rising(c, "share")[0] for c in choices.values()]
    return agreed(found), (
        f"Share of the discs that is resident at the wall: {ends(rows, 'residence_share')}; it rises for "
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
        f"Residences at the wall begin at θ = {ends(rows, 'residence_begin')} (degrees); the place moves "
        f"upstream by {number(upstream(rows, 'residence_begin'))}° (earlier: more than {EARLIER:.0f}°), and "
        f"by {span}° with the {choice}. By the SI's sharp turns: {ends(rows, 'becoming_pinned')}.")


def resultants(rows, name):
    return f"{rows[0][name]:.2f} and {rows[-1][name]:.2f}"


def free_fixed(folder):
    rows, choices = angles(folder), by_choice(folder)
    spreads = [spread(c, "becoming_free") for c in choices.values()]
    same = [below(s, SAME_PLACE) for s in spreads]
    span, choice = from_to(choices, spreads)
    return agreed(same), (
        f"Residences at the wall end at θ = {ends(rows, 'residence_end')} (degrees; resultant length "
        f"{resultants(rows, 'residence_end_resultant')}): over all N the place moves by "
        f"{number(spread(rows, 'residence_end'))}°, and by {span}° with the {choice}. The same place "
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
    part, but = rising(rows, "residence_share")
    return part, f"share that is resident at the wall: {ends(rows, 'residence_share')}{but}"


def earlier(rows):
    shift = upstream(rows, "residence_begin")
    return above(shift, EARLIER), (
        f"residences at the wall begin at θ = {ends(rows, 'residence_begin')} (degrees): the place moves "
        f"upstream by {number(shift)}° (earlier: more than {EARLIER:.0f}°)")


def same_place(rows):
    apart = spread(rows, "residence_end")
    return below(apart, SAME_PLACE), (
        f"residences at the wall end at θ = {ends(rows, 'residence_end')} (degrees): over all N the place "
        f"moves by {number(apart)}° (the same place: within {SAME_PLACE:.0f}°)")


def left_of_M(folder):
    rows = folder.curve("1b", setting="high")
    lag = [M_AT - row["centre_theta"] for row in rows]
    return parts(every([above(v, LEFT_SHARE) for v in values(rows, "left")]),
                 every([below(v, -LEFT_SHIFT) for v in values(rows, "centre_x")])), (
        f"Share of the discs left of the line from C to M: {ends(rows, 'left')}; x of the centre "
        f"of mass, in disc radii: {ends(rows, 'centre_x')} (to the left: more than {LEFT_SHARE} of the "
        f"discs, and by {LEFT_SHIFT} radii). It lags behind the swirl by "
        f"{lag[0]:.0f}° at N = {rows[0]['discs']:.0f} and {lag[-1]:.0f}° at N = "
        f"{rows[-1]['discs']:.0f}.")


def more_collisions(folder):
    rows = folder.curve("4b", setting="high")
    # The two kinds of one run are not independent: their errors add up.
    found = [Value(PERIOD * (row["disc_disc_rate"] + row["disc_wall_rate"]),
                   PERIOD * (row["disc_disc_rate_error"] + row["disc_wall_rate_error"]),
                   [row["point"]] if "point" in row else ()) for row in rows]
    return rises(found, MATTERS * found[0].mean), (
        f"Collisions of a disc in a swirl: {number(found[0])} at N = {rows[0]['discs']:.0f}, "
        f"{number(found[-1])} at N = {rows[-1]['discs']:.0f}.")


def six_fold(folder):
    """Of discs that can have six neighbours: those at the wall cannot."""
    rows = folder.curve("4b", setting="high")
    return above(value(rows[-1], "six_pinned"), MOST), (
        "Share of the discs pinned by the SI's criterion, those at the wall left out, that have six "
        f"neighbours: {ends(rows, 'six_pinned')} (often: more than {MOST}; points without any order have "
        f"{SIX_BY_CHANCE}, a crystal 1); of all discs away from the wall: {ends(rows, 'six')}. Hexatic "
        f"order ψ6 of the pinned, those at the wall included: {ends(rows, 'psi6_pinned')}.")


def nearest_slice(rows, theta):
    if theta != theta:
        raise ValueError("The place is not known.")
    return min(rows, key=lambda row: abs((row["theta"] - theta + 180) % 360 - 180))


def oblong(folder):
    """In the slices where discs become pinned and free, which the table names."""
    profile = folder.table("3a")
    farther, as_fast, slower, told = [], [], [], []
    for discs in sorted({row["discs"] for row in profile}):
        here = [row for row in tables.select(profile, discs=discs) if row["visits"] > LEAST_VISITS]
        weights = [row["visits"] for row in here]
        distance, speed, rate = (mean_of(values(here, name), weights).mean
                                 for name in ("distance", "speed", "varpi_m"))
        words = []
        for name, event in (("residence_begin", "become pinned"), ("residence_end", "become free")):
            there = nearest_slice(here, here[0][name])
            away, fast = (value(there, column) for column in ("distance", "speed"))
            slower.append(above(value(there, "varpi_m"), rate))
            farther.append(above(away, distance))
            as_fast.append(within(fast, (1 - SIMILAR) * speed, (1 + SIMILAR) * speed))
            words.append(f"where they {event} (θ = {there['theta']:.0f}°) {away.mean / distance:.2f} "
                         f"times as far and {fast.mean / speed:.2f} times as fast")
        told.append(f"at N = {discs:.0f}, {' and '.join(words)}")
    return parts(every(slower), every(farther), every(as_fast)), (
        f"Discs relative to the centre of mass, as against the average over θ: {told[0]}; {told[-1]}. At "
        f"both places and all N ({len(farther)} cases): |⟨ϖ_M⟩| below average for certain in "
        f"{count(slower)}, farther in {count(farther)}, as fast within {100 * SIMILAR:.0f} % in "
        f"{count(as_fast)}.")


def forces(folder):
    rows = folder.curve("1b", setting="high")
    # In units of r Ω², then of the experiment.
    per_unit = EXPERIMENTS_R_OMEGA_SQUARE / (2 * math.pi / PERIOD) ** 2
    points = [row["point"] for row in rows if isinstance(row.get("point"), str)]
    # A highest force has no error of its own; those at different N are independent.
    found = {name: scattered([row[f"max_{name}"] * per_unit for row in rows], points)
             for name in MOST_FORCES}
    mean = mean_of(values(rows, "coriolis")) * per_unit
    wall = 2 * RADIUS * EXPERIMENTS_R_OMEGA_SQUARE
    # No disc is farther from S than one that touches the wall at M.
    farthest = (RADIUS - 1 + AMPLITUDE) * EXPERIMENTS_R_OMEGA_SQUARE
    as_amplitude = (RADIUS - 1 + 2 * AMPLITUDE) * EXPERIMENTS_R_OMEGA_SQUARE
    most = MOST_FORCES["coriolis"]
    return parts(true(farthest > MOST_FORCES["centrifugal"] - TENS),
                 within(found["coriolis"], most - TENS, most + TENS)), (
        f"The centrifugal force is greatest on a disc that touches the wall at M, (R − r + A)Ω² = "
        f"{farthest:.1f} cm/s² in the experiment's units with its A = 5.75 mm: "
        f"{MOST_FORCES['centrifugal']:.0f} cannot occur ({as_amplitude:.0f} would, with A = 1.15 cm). "
        f"The highest in the runs is {number(found['centrifugal'])}, on average over N. The Coriolis "
        f"force goes up to {number(found['coriolis'])} (asked: {most:.0f} within {TENS:.0f}); on average "
        f"it is {number(mean)}, and about {wall:.0f} on a disc that moves with the wall, so 200 can only "
        "hold for slow ones.")


def rim(folder):
    rows = [row for row in folder.table("states") if row["discs"] == LARGE_N]
    by_setting = {row["setting"]: row for row in rows}
    omega = 2 * math.pi / PERIOD
    speed = {name: value(row, "coriolis") * (1 / (2 * omega ** 2 * RADIUS))
             for name, row in by_setting.items()}
    return below(speed["no-wall"], LITTLE_MOTION), (
        f"Mean speed in the M-frame at N = {LARGE_N}, in ΩR: {number(speed['no-wall'])} without "
        f"wall friction, {number(speed['high'])} with both (little: below {LITTLE_MOTION}).")


def told_of(rows, numbers=(LOW_N, LARGE_N)):
    """Pairs of values, without disc friction and with both, at two numbers of discs."""
    return ", ".join(f"{number(a)} for {number(b)} with both frictions at N = {n}"
                     for n, (a, b) in zip(numbers, rows))


def known(row, name):
    """A value for comparison, which is not what makes a claim undecided: no seeds are asked for it."""
    return Value(row[name], row[f"{name}_error"])


def gas(phase):
    """`phase`: "before", from the start until the cluster condenses, or "after" it has. Loose is what
    has fewer contacts than with both frictions, gas-like what is hotter."""
    def judge(folder):
        rows = [(tables.select(folder.table("condensation"), discs=n)[0],
                 tables.select(folder.table("states"), discs=n, setting="high")[0])
                for n in (LOW_N, LARGE_N)]
        contacts, heat = ([(value(loose, f"{phase}_{name}"), known(both, name)) for loose, both in rows]
                          for name in ("coordination", "granular"))
        return parts(every([below(a - b, -MATTERS * b.mean) for a, b in contacts]),
                     every([above(a - b, MATTERS * b.mean) for a, b in heat])), (
            f"Contacts of a disc: {told_of(contacts)} (loose: fewer by {MATTERS:.0%}); granular "
            f"temperature in m v²: {told_of(heat)} (gas-like: higher by {MATTERS:.0%}). " +
            "; ".join(waiting_sentence(loose) for loose, _ in rows) + ".")
    return judge


def waiting_sentence(row):
    """When the cluster condenses, and how much of the paper's run that is."""
    late = row["seeds"] - row["condensed"]
    if not row["condensed"]:
        return f"N = {row['discs']:.0f}: none of {row['seeds']:.0f} runs condenses"
    return (f"N = {row['discs']:.0f}: it condenses after {number(value(row, 'waiting'))} periods "
            f"({row['events']:,.0f} events, where the paper's run has {EVENTS:,.0f})" +
            (f", {late:.0f} of {row['seeds']:.0f} runs not within {row['longest']:.0f}" if late else ""))


def outer_spins(folder):
    rows = [(tables.select(folder.table("condensation"), discs=n)[0],
             tables.select(folder.table("4b"), discs=n, setting="high")[0])
            for n in (LOW_N, LARGE_N)]
    spins = [(value(loose, "before_wall_spin"), known(both, "wall_spin")) for loose, both in rows]
    coherence = [value(loose, "before_spin_correlation") for loose, _ in rows]
    return parts(every([above(a - b, MATTERS * b.mean) for a, b in spins]),
                 every([within(c, ANTIFERROMAGNETIC, -ANTIFERROMAGNETIC) for c in coherence])), (
        f"Before the cluster condenses, ⟨|ω|⟩/Ω of the discs at the wall: {told_of(spins)} (quickly: more "
        f"by {MATTERS:.0%}); correlation of the spins of discs that touch: " + ", ".join(
            f"{number(c)} at N = {n}" for n, c in zip((LOW_N, LARGE_N), coherence)) +
        f" (no coherence: within ±{-ANTIFERROMAGNETIC:.3f}). All discs are turned by the same wall, so "
        "they spin in one direction.")


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
        """The energies of each seed in order of time."""
        here = tables.select(rows, sides=float(sides))
        return [[row["energy"] for row in sorted(tables.select(here, seed=seed),
                                                 key=lambda row: row["swirl"])]
                for seed in sorted({row["seed"] for row in here})]

    def growth(sides):
        """From the second tenth to the last, after the discs have been set in motion, in units of the mean;
        the error is that between seeds."""
        found = []
        for energy in series(sides):
            edges = [len(energy) * k // TENTHS for k in range(TENTHS + 1)]
            found.append(trend([sum(energy[a:b]) / (b - a)
                                for a, b in zip(edges[1:], edges[2:])]).mean)
        return scattered(found)

    runs = series(SIDES)
    crashed = not all(math.isfinite(energy) for run in runs for energy in run)
    return parts(above(growth(SIDES), GROWTH), true(crashed)), (
        f"In {len(runs[0]) - 1} periods at N = {rows[0]['discs']:.0f} ({len(runs)} seeds), from the second "
        f"tenth to the last, the energy grows by {number(growth(SIDES))} of its mean on {SIDES} sides, by "
        f"{number(growth(6))} on 6 and by {number(growth(0))} on the true circle (it blows up: more "
        f"than {GROWTH}); this program does {'' if crashed else 'not '}crash.")


def ball(folder):
    rows = folder.table("ball")
    rolling = [value(row, "gamma") for row in tables.select(rows, mu=1.0, restitution=0.5)]
    slipping = [value(row, "gamma") for row in tables.select(rows, mu=0.0)]
    shares = [row["slip"] for row in tables.select(rows, mu=1.0, restitution=0.5)]
    return parts(every([above(g, 1 + TURNS) for g in rolling]),
                 every([below(g, 1 - TURNS) for g in slipping])), (
        f"γ of one large disc with μ = 1 that stays at the wall (e = 0.5): "
        f"{min(g.mean for g in rolling):.3f} to {max(g.mean for g in rolling):.3f}, "
        f"{min(shares):.3f} to {max(shares):.3f} of γ_c: it counterrotates. Without friction "
        f"nothing turns it: γ = {slipping[0].mean:.3f}, so that it neither rotates nor "
        "counterrotates; the paper has γ = 0 there.")


def ball_near_m(folder):
    rows = tables.select(folder.table("ball"), mu=1.0, restitution=0.5)
    places = [value(row, "theta") for row in rows]
    return parts(every([within(v, M_AT - NEAR_M, M_AT + NEAR_M) for v in places]),
                 every([below(v, M_AT - LEFT_OF_M) for v in places])), (
        "Direction of a ball that rolls on the wall (μ = 1, e = 0.5): θ = " + ", ".join(
            f"{number(v)}° for a radius of {row['ball_radius']:g}" for v, row in zip(places, rows)) +
        f"; M is at {M_AT:.0f}° (near: within {NEAR_M:.0f}°; to the left: by more than {LEFT_OF_M:.0f}°). "
        "A ball that turns uniformly has no torque, hence no friction, and only at M does the normal force "
        "alone balance the centrifugal force.")


def elastic(folder):
    """All runs of Figure 5b are elastic; what damping changes has fewer seeds and is told."""
    found = folder.crossing("5b", "high")
    text = f"e = 1: {found.text}"
    try:
        damped = [(e, folder.crossing("restitution", e)) for e in ("0.99", "0.9")]
        text += "".join(f"; e = {e}: {c.text}" for e, c in damped)
    except (FileNotFoundError, IndexError):
        pass
    return found.crosses, text + "."


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
        return (every([above(value(rows[0], "by_time"), TURNS)] +
                      [below(v, -TURNS) for v in values(dense, "by_time")]),
                ", ".join(f"{number(value(row, 'by_time'))} at N = {row['discs']:.0f}"
                          for row in [rows[0], *dense]))

    part, told = for_some_friction(folder, "spheres", judge)
    return part, f"ϖ/Ω with their real moment of inertia: {told}."


def last_changes(folder):
    """Of each friction the last change to counterrotation: from there on all counterrotate. If signs beyond
    it are undetermined, the last change may lie anywhere up to the last of them."""
    table, points = folder.table("spheres_sense"), folder.table("spheres")
    found = {}
    for row in tables.select(table, sense="counterrotation"):
        beyond = [other["after"] for other in tables.select(table, sense="undetermined", mu=row["mu"])
                  if other["before"] >= row["after"]]
        if beyond:
            row = {**row, "crossing": math.nan, "lower": row["before"], "upper": max(beyond)}
        near = {p["point"] for p in points
                if p["mu"] == row["mu"] and row["before"] <= p["discs"] <= row["after"]}
        found[row["mu"]] = crossing_value(row, near)
        found[row["mu"]].words = crossing_words(row)
    return found


def listed(changes):
    return "; ".join(f"μ = {mu:g}: {at.words}" for mu, at in sorted(changes.items()))


def frictions_that_change_at(changes, discs):
    """[(friction, verdict)] of those that were run and of what lies between two of them. Between two
    whose N differ by more than JUMP nothing is known: N of the last change jumps with the friction."""
    runs = [(mu, within(at, discs - ROUGHLY, discs + ROUGHLY)) for mu, at in changes]
    between = [((low + high) / 2, every([above(rarer, discs), below(sooner, discs)]))
               for (low, rarer), (high, sooner) in zip(changes, changes[1:])
               if abs(rarer.mean - sooner.mean) <= JUMP]
    return sorted(runs + between, key=lambda found: found[0])


def jumps(changes):
    return "".join(
        f"; between μ = {low:g} and {high:g} it jumps from {number(a)} to {number(b)}, which says nothing "
        "about the N between" for (low, a), (high, b) in zip(changes, changes[1:])
        if abs(a.mean - b.mean) > JUMP)


def spheres_change_near(discs):
    """For some friction, as that of the experiment's spheres is not known."""
    def judge(folder):
        changes = sorted(last_changes(folder).items())
        return either(part for _, part in frictions_that_change_at(changes, discs)), (
            f"N of the last change to counterrotation, {listed(dict(changes))}{jumps(changes)} "
            f"(roughly: within {ROUGHLY:.0f} of {discs}; the friction of the spheres is not known).")
    return judge


def spheres_roughened(folder):
    """Both at once: one friction for the smooth spheres, and a higher one for the same spheres after the
    sandpaper."""
    changes = sorted(last_changes(folder).items())
    smooth, rough = (frictions_that_change_at(changes, discs) for discs in (36, 28))
    pairs = [every([a, b]) for low, a in smooth for high, b in rough if high > low]
    at_36, at_28 = ([f"{mu:g}" for mu, part in found if part.verdict == HOLDS]
                    for found in (smooth, rough))
    return either(pairs), (
        f"N of the last change to counterrotation, {listed(dict(changes))}{jumps(changes)}. Smooth, 36: "
        f"{'μ = ' + ' or '.join(at_36) if at_36 else 'no friction for certain'}; rough, 28: "
        f"{'μ = ' + ' or '.join(at_28) if at_28 else 'no friction for certain'} (within "
        f"{ROUGHLY:.0f}).")


def spheres_friction_order(folder):
    changes = sorted(last_changes(folder).items())
    return falls([at for _, at in changes], ONE_DISC), (
        f"N of the last change to counterrotation, {listed(dict(changes))}.")


def spheres_minimum(folder):
    def judge(rows):
        lowest, last, rise = after_minimum(rows, "by_time")
        return (every([below(value(lowest, "by_time"), -TURNS), above(rise, SLIGHT_DROP)]),
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
    alone = every([above(v, TURNS) for v in pairs[1]]).verdict
    said = {HOLDS: "certainly rotate", FAILS: "do not all rotate"}.get(alone, "perhaps rotate")
    return parts(every([below(v, -TURNS) for v in pairs[0]]),
                 every([above(without - v * (1 - INDUCED), 0)
                        for v, without in zip(pairs[0], pairs[1])])), (
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
        f"{told} (induced by it: more than {INDUCED:.0%} of the counterrotation is gone). That they rotate "
        "without it is no claim of the paper's. Of discs, which have no such friction, the moment of "
        f"inertia decides{inertia_sentence(folder)}.")


def inertia_sentence(folder):
    """Where discs of several moments of inertia change their direction, if it was run."""
    try:
        rows = folder.table("inertia_crossings")
    except FileNotFoundError:
        return ""
    names = [f"{row['curve']:g}" for row in rows]
    return ": " + "; ".join(f"I = {name}: {folder.crossing('inertia', name).text}" for name in names)


def spheres_elastic(folder):
    found = [spheres_at(folder, "spheres_ingredients", "no-damping", n) for n in DENSE_SPHERES]
    return every([below(v, -TURNS) for v in found]), (
        "With e = 1, but the floor as it is: ϖ/Ω = " + ", ".join(
            f"{number(v)} at N = {n}" for v, n in zip(found, DENSE_SPHERES)) + ".")


def substrate(folder):
    """Each ingredient is critical if spheres counterrotate with it and, taken away alone, do not."""
    curves = {"all ingredients": f"{PLASTIC:g}", "no floor": "no-floor",
              "no friction of rolling (vertical)": "no-vertical", "no damping": "no-damping"}
    found = {words: [spheres_at(folder, "spheres_ingredients", curve, n) for n in DENSE_SPHERES]
             for words, curve in curves.items()}
    still = {words: every([below(v, -TURNS) for v in turns]) for words, turns in found.items()}
    return parts(*(every([still["all ingredients"], part])
                   for words, part in still.items() if words != "all ingredients")), (
        "Spheres with their own moment of inertia, ϖ/Ω: " + "; ".join(
            f"{words}: " + ", ".join(f"{number(v)} at N = {n}" for v, n in zip(turns, DENSE_SPHERES))
            for words, turns in found.items()) +
        ". Not critical is what they counterrotate without. The paper's discs do so without a floor, but with "
        "I = 10 m r², which no disc or sphere has.")


def snake(folder):
    """The middle of the text's first page; the experiment has 24 spheres or more."""
    rows = [row for row in folder.table("spheres_few") if row["discs"] <= FEW]
    found = [every([within(value(row, "by_time"), 1 - NEAR_OMEGA, 1 + NEAR_OMEGA),
                    above(value(row, "residence_share"), ALMOST_ALL)]) for row in rows]
    return either(found), (
        f"After a long warm-up, ϖ/Ω and the share of the spheres resident at the wall: " + "; ".join(
            f"{number(value(row, 'by_time'))} and {number(value(row, 'residence_share'))} at N = "
            f"{row['discs']:.0f}" for row in rows) +
        f" (μ = {PLASTIC:g}; a line that rolls with the swirl: within {NEAR_OMEGA} of 1, and more than "
        f"{ALMOST_ALL}).")


def spheres_passage(folder):
    def judge(rows):
        rows = [row for row in rows if EXPERIMENTS_N[0] <= row["discs"] <= EXPERIMENTS_N[1]]
        found = values(rows, "by_time")
        return one_passage(found), (
            f"certainly rotating at {count([above(v, TURNS) for v in found])}, certainly counterrotating "
            f"at {count([below(v, -TURNS) for v in found])} of {len(rows)} N")

    part, told = for_some_friction(folder, "spheres", judge)
    return part, f"N = {EXPERIMENTS_N[0]} to {EXPERIMENTS_N[1]}, {told}."


def of_spheres(judge_rows):
    """What one friction's rows say of the pinned."""
    def judge(folder):
        part, told = for_some_friction(folder, "spheres_pinned", judge_rows)
        return part, f"Spheres, {told}."
    return judge


def spin_falls(rows):
    rows = [row for row in rows if row["resident_spin"] == row["resident_spin"]]
    part, but = rising(rows, "resident_spin", falling=True)
    return part, (f"|ω_z|/Ω of those resident at the wall {ends(rows, 'resident_spin')}{but}, of those "
                  f"pinned there by the SI's criterion {ends(rows, 'pinned_wall_spin')}")


def slip_from_a_half(rows):
    part, but = rising(rows, "slip_resident", least=SLIP_RISES)
    half = [within(value(row, "slip_resident"), 0.5 - ABOUT_A_HALF, 0.5 + ABOUT_A_HALF)
            for row in rows if abs(row["discs"] - 25) <= ROUGHLY]
    return parts(part, either(half), above(value(rows[-1], "slip_resident"), NEARLY_ONE)), (
        f"{ends(rows, 'slip_resident')}{but}, of all pinned by the SI's criterion "
        f"{ends(rows, 'pinned_region')}")


def spheres_slip(folder):
    part, told = for_some_friction(folder, "spheres_pinned", slip_from_a_half)
    return part, (f"s of those resident at the wall, {told} (approximately 0.5: within "
                  f"{ABOUT_A_HALF}; nearly 1: above {NEARLY_ONE}).")


def spheres_slip_rough(folder):
    frictions = sorted({row["mu"] for row in folder.table("spheres_pinned")})
    smooth, rough = (folder.curve("spheres_pinned", most=math.inf, mu=mu)
                     for mu in (frictions[0], frictions[-1]))
    part, found = closer_to_one(rough, smooth)
    return part, (f"s of those resident at the wall is closer to 1 for μ = {frictions[-1]:g} than "
                  f"for μ = {frictions[0]:g}, {found}.")


def spheres_kept_from_rolling(folder):
    """At high N, of those at the wall: do less than a half of them roll? That fewer roll there than
    elsewhere is no answer, if most do."""
    def judge(rows):
        wall = {row["discs"]: value(row, "wall_rolling_share") for row in rows}
        lack = {row["discs"]: value(row, "rolling_share") - wall[row["discs"]] for row in rows}
        few, many = rows[0]["discs"], rows[-1]["discs"]
        return every([below(share, MOST) for discs, share in wall.items() if discs >= HIGH_N]), (
            ", ".join(f"{number(share)} at N = {discs:.0f}" for discs, share in wall.items()) +
            f"; of all spheres more roll, by {number(lack[few])} at N = {few:.0f} and "
            f"{number(lack[many])} at {many:.0f}")

    part, told = for_some_friction(folder, "spheres_pinned", judge)
    return part, f"Share of the spheres at the wall that roll (kept from it: below {MOST}): {told}."


CLAIMS = [
    Claim("main text, Fig. 5b", "With friction at the wall and between the discs the cluster "
          "rotates with the swirl at low N and counterrotates at high N.", "5b", transition),
    Claim("main text, Fig. 1b", "Beyond the crossing ϖ reaches a minimum and then rises slightly "
          "for the largest N.", "5b", minimum),
    # "As N increases the cluster transitions from rotation to stalling to counterrotation."
    Claim("main text, Fig. 1b", "As N increases the cluster goes from rotation to stalling to "
          "counterrotation, once.", "5b", passage),
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
    # "Therefore, the pinned region is the major contributor to the different behaviors seen across varying
    # N's."
    Claim("main text", "The pinned region is the major contributor to what differs between N.", "3a",
          pinned_decides),
    # "Once loose, a particle experiences centrifugal ... and Coriolis ... forces and accelerates as it
    # traverses the loose region."
    Claim("main text", "Loose discs accelerate as they cross the loose region.", "3a", loose_accelerate),
    # "In the pinned region, the particles are packed in layers against the moving wall and move as a rigid
    # structure ..."
    Claim("main text", "In the pinned region discs are packed in layers against the wall.", "2c", layers),
    # "The coherent pinned region (top left on the container) grows in size with increasing N ..."
    Claim("main text, Fig. 2", "The pinned region is at the top left of the container.", "3a", top_left),
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
    # "With no disc-disc friction ... The cluster of discs is loose and gas-like, unlike the rigid body
    # appearance of the cluster when all friction is present (SI video)."
    Claim("main text", "Without disc friction the cluster is loose and gas-like: in the paper's 10^6 "
          "events, from the start until it condenses.", "condensation", gas("before")),
    Claim("main text", "Without disc friction the cluster is loose and gas-like: in the steady state, "
          "after that.", "condensation", gas("after")),
    # "The outer discs are accelerated by frictional collisions with the wall and spin about their own axes
    # quickly. ... individual discs spin with no coherence."
    Claim("main text", "Without disc friction the outer discs spin quickly, and without coherence.",
          "condensation", outer_spins),
    Claim("SI", "The smallest time between collisions is around 10⁻¹¹ with friction and 10⁻⁹ "
          "without.", "times", smallest_times),
    Claim("main text, Fig. 4c", "Rough discs change the sense at a lower N than smooth ones.",
          "4c", rough_earlier),
    Claim("main text", "Damping of the normal motion is not needed for the transition.", "5b",
          elastic),
    Claim("main text", "A single ball counterrotates if it rolls on the wall and rotates if it "
          "slips freely.", "ball", ball),
    # "A steady-state for the ball in the M-frame occurs when it is near the bottom-left of the container
    # (near M) ..."
    Claim("main text", "The ball of the minimal model stays near the bottom left of the container, near M.",
          "ball", ball_near_m),
    Claim("SI", "With both frictions zero the energy blows up and the program crashes.", "energy",
          blow_up),
    Claim("main text, Fig. 1b", "In the experiment the sense changes at roughly N = 36.", "5b",
          near_36),
    Claim("main text", "At high N spheres at the wall are kept from rolling on the ground.", "spheres_pinned",
          spheres_kept_from_rolling),
    Claim("experiment, Fig. 1b", "Few spheres rotate with the swirl, many counterrotate.", "spheres",
          spheres_transition),
    Claim("experiment, Fig. 1b", "As N increases spheres go from rotation to stalling to counterrotation, "
          "once.", "spheres", spheres_passage),
    # "When there are only a few marbles in the container, they form a line that rolls along the container
    # wall at the frequency of the circular translations ("snake" mode)."
    Claim("main text", "Only a few spheres form a line that rolls along the wall at the frequency of the "
          "swirl.", "spheres_few", snake),
    Claim("experiment, Fig. 1b", "Spheres of smooth plastic change their sense at roughly N = 36.",
          "spheres_sense", spheres_change_near(36)),
    Claim("experiment, Fig. 4", "Roughened spheres change it at N = 28, smooth ones at N = 36: "
          "sandpaper takes them from one friction to a higher one.", "spheres_sense",
          spheres_roughened),
    Claim("experiment, Fig. 4c", "The rougher the spheres, the lower the N at which the sense "
          "changes.", "spheres_sense", spheres_friction_order),
    Claim("experiment, Fig. 1b", "Beyond the crossing ϖ of spheres reaches a minimum and then rises "
          "slightly for the largest N.", "spheres", spheres_minimum),
    Claim("title", "Geometric frustration induces counterrotation: spheres counterrotate, and without "
          "what frustrates their rolling, vertical friction, ϖ is higher.", "spheres_ingredients",
          spheres_frustration),
    Claim("main text", "Damping is not needed for spheres to counterrotate.", "spheres_ingredients",
          spheres_elastic),
    # "... there is no friction with the substrate, no three-dimensional rolling effects, and no normal
    # damping during collisions ... Therefore, these additional factors cannot be critical for observing the
    # transition."
    Claim("main text", "Friction with the substrate, rolling in three dimensions and damping cannot be "
          "critical for the transition.", "spheres_ingredients", substrate),
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
        atomic_file.write(file, json.dumps(all_verdicts(sys.argv[1]), indent=1, ensure_ascii=False) + "\n")
    except OSError as error:
        sys.exit(f"'{file}' could not be written: {error.strerror}.")


if __name__ == "__main__":
    main()
