"""The paper's claims, and what the tables say of each.

A claim has a function that reads the tables and returns a verdict with the numbers it rests on. No
verdict is written by hand: where a number decides, the threshold stands beside it. Z = 3 standard
errors is what counts as certain.

Source of all claims: L. Lee, J. P. Ryan, Y. Lahini, M. Holmes-Cerfon, S. M. Rubinstein, Physical
Review E 100, 012903 (2019), main text and Supplementary Information (SI).
"""

import math
import os

import tables

HOLDS, IN_PART, FAILS = "holds", "holds in part", "does not hold"
UNTESTABLE, MISSING = "not testable by simulation", "not made"
Z = 3.0


class Claim:
    def __init__(self, where, says, figure, judge):
        self.where, self.says, self.figure, self.judge = where, says, figure, judge

    @property
    def command(self):
        return f"swirl paper --figure {self.figure}" if self.figure else ""

    def verdict(self, folder):
        """(verdict, what was found)"""
        try:
            return self.judge(Folder(folder))
        except FileNotFoundError as missing:
            return MISSING, f"The table {os.path.basename(missing.filename)} is not there."
        except (IndexError, ValueError, ZeroDivisionError):
            return MISSING, "The table has too few runs in it."


class Folder:
    def __init__(self, path):
        self.path = path

    def table(self, name):
        return tables.read(os.path.join(self.path, f"figure_{name}.csv"))

    def crossing(self, name, curve):
        # A curve named by a number is read back as one.
        known = [row for row in self.table(f"{name}_crossings")
                 if curve == (f"{row['curve']:g}" if isinstance(row["curve"], float)
                              else row["curve"])]
        return known[0]

    def curve(self, name, **wanted):
        rows = [row for row in tables.select(self.table(name), **wanted)
                if row.get("steady_state") != "failed"]
        return sorted(rows, key=lambda row: row["discs"])


# --- words and numbers ------------------------------------------------------------------------

def number(value, error=float("nan")):
    """1.234 ± 0.012, with as many digits as the error supports."""
    if value != value:
        return "not known"
    if not error > 0:
        return f"{value:.3g}".replace("-", "−")
    digits = max(0, -math.floor(math.log10(error)) + (1 if error / 10 ** math.floor(
        math.log10(error)) < 1.95 else 0))
    return f"{value:.{digits}f} ± {error:.{digits}f}".replace("-", "−")


def crossing_text(c):
    if c["verdict"] == "crosses":
        return f"N_c = {number(c['crossing'], c['crossing_error'])}"
    return (f"no crossing ({c['verdict']}; lowest ϖ/Ω = "
            f"{number(c['lowest'], c['lowest_error'])} at N = {c['lowest_discs']:.0f})")


def all_or_some(flags):
    """Holds if everywhere, in part if in more than half of the places, else not."""
    flags = list(flags)
    if not flags:
        return FAILS
    if all(flags):
        return HOLDS
    return IN_PART if sum(flags) > len(flags) / 2 else FAILS


def rises(rows, name, sign=1):
    """Does it rise (or fall) from the lowest to the highest N, certainly and at most steps?"""
    values = [(row[name], row[name + "_error"]) for row in rows if row[name] == row[name]]
    if len(values) < 3:
        return FAILS
    (first, e1), (last, e2) = values[0], values[-1]
    overall = sign * (last - first) > Z * math.hypot(e1, e2)
    # A step counts as wrong only if it is certainly in the other direction.
    wrong = sum(sign * (b - a) < -Z * math.hypot(ea, eb)
                for (a, ea), (b, eb) in zip(values, values[1:]))
    if not overall:
        return FAILS
    return HOLDS if wrong <= len(values) / 10 else IN_PART


def ends(rows, name):
    known = [row for row in rows if row[name] == row[name]]
    a, b = known[0], known[-1]
    return (f"{number(a[name], a[name + '_error'])} at N = {a['discs']:.0f}, "
            f"{number(b[name], b[name + '_error'])} at N = {b['discs']:.0f}")


# --- the judges -------------------------------------------------------------------------------

def transition(folder):
    c = folder.crossing("5b", "high")
    rows = folder.curve("5b", setting="high")
    low, high = rows[0], rows[-1]
    rotates = low["by_event"] > Z * low["by_event_error"]
    counter = high["by_event"] < -Z * high["by_event_error"]
    verdict = all_or_some([c["verdict"] == "crosses", rotates, counter])
    return verdict, (f"{crossing_text(c)}; ϖ/Ω = {ends(rows, 'by_event')} (μ = 1).")


def near_36(folder):
    c = folder.crossing("5b", "high")
    if c["verdict"] != "crosses":
        return FAILS, f"{crossing_text(c)} at μ = 1."
    # "Roughly 36" is taken as 36 ± 2, since the paper gives no error.
    off = abs(c["crossing"] - 36)
    verdict = HOLDS if off <= 2 else IN_PART if off <= 6 else FAILS
    return verdict, (f"{crossing_text(c)} in the simulation with μ = 1, I = 10. The friction of "
                     "the real spheres is not known, so this is no test of the experiment.")


def minimum(folder):
    rows = folder.curve("5b", setting="high")
    lowest = min(rows, key=lambda row: row["by_event"])
    last = rows[-1]
    rise = last["by_event"] - lowest["by_event"]
    error = math.hypot(last["by_event_error"], lowest["by_event_error"])
    if lowest is last:
        return FAILS, f"ϖ falls to the end: {ends(rows, 'by_event')}."
    verdict = HOLDS if rise > Z * error else IN_PART if rise > error else FAILS
    return verdict, (f"Lowest at N = {lowest['discs']:.0f}, "
                     f"{number(lowest['by_event'], lowest['by_event_error'])}; at N = "
                     f"{last['discs']:.0f} it is {number(last['by_event'], last['by_event_error'])}"
                     f", higher by {number(rise, error)}.")


def friction_order(folder):
    found = [folder.crossing("5b", name) for name in ("high", "medium", "low")]
    text = "; ".join(f"μ = {mu}: {crossing_text(c)}" for mu, c in zip((1, 0.5, 0.1), found)) + "."
    if any(c["verdict"] != "crosses" for c in found):
        some = found[0]["verdict"] == "crosses"
        return (IN_PART if some else FAILS), text
    certain = [b["crossing"] - a["crossing"] > Z * math.hypot(a["crossing_error"],
                                                              b["crossing_error"])
               for a, b in zip(found, found[1:])]
    return all_or_some(certain), text


def close_to_omega(rows, share, where):
    """Holds where ϖ is nearer to Ω than this share of it at every N, in part at most N."""
    off = [row for row in rows if abs(row["by_event"] - 1) > share]
    worst = max(rows, key=lambda row: abs(row["by_event"] - 1))
    verdict = HOLDS if not off else IN_PART if len(off) < len(rows) / 2 else FAILS
    return verdict, (f"{where}ithin {100 * share:.0f} % of Ω at {len(rows) - len(off)} of "
                     f"{len(rows)} N; farthest is "
                     f"{number(worst['by_event'], worst['by_event_error'])} at N = "
                     f"{worst['discs']:.0f}.")


def no_wall_at_omega(name):
    return lambda folder: close_to_omega(folder.curve(name, setting="no-wall"), 0.05, "W")


def never_crosses(setting):
    def judge(folder):
        c = folder.crossing("5b", setting)
        text = crossing_text(c)
        verdict = HOLDS if c["verdict"] == "always rotates" else FAILS
        if c["verdict"] == "undecided":
            verdict = IN_PART
        return verdict, text[0].upper() + text[1:] + "."
    return judge


def no_disc_close(folder):
    rows = [row for row in folder.curve("5b", setting="no-disc") if row["discs"] <= 40]
    return close_to_omega(rows, 0.1, "Up to N = 40 w")


def no_disc_drop(name):
    def judge(folder):
        rows = folder.curve(name, setting="no-disc")
        before = [row for row in rows if 30 <= row["discs"] <= 40]
        level = sum(row["by_event"] for row in before) / len(before)
        last = rows[-1]
        drop, error = level - last["by_event"], last["by_event_error"]
        # Half a per cent is a drop; what is neither certain nor excluded holds in part.
        certain, excluded = drop > max(Z * error, 0.005), drop + Z * error < 0.005
        verdict = HOLDS if certain else FAILS if excluded else IN_PART
        doubt = "" if certain or excluded else " The drop is not certain."
        return verdict, (f"Mean of N = 30 … 40: {level:.4f}; at N = {last['discs']:.0f}: "
                         f"{number(last['by_event'], last['by_event_error'])}.{doubt}")
    return judge


def frames(folder):
    profile, rotation = folder.table("3a"), folder.table("1b")
    worst = 0.0
    for row in rotation:
        slices = [r for r in tables.select(profile, discs=row["discs"]) if r["visits"] > 0]
        total = sum(r["visits"] for r in slices)
        mean = sum(r["visits"] * r["varpi_m"] for r in slices) / total
        worst = max(worst, abs(mean + 1 - row["by_time"]) / row["by_time_error"])
    # Both means are of the same run, looked at 511 and 64 times a period.
    verdict = HOLDS if worst < Z else FAILS
    return verdict, ("⟨ϖ_M⟩ + Ω from the profiles and ϖ from the run agree within "
                     f"{worst:.2f} standard errors at every N (it is an identity).")


def steady(folder):
    rows = [row for row in folder.table("5b") if row["setting"] in ("high", "medium", "low")]
    known = [row for row in rows if row["steady_state"] != "too short to tell"]
    good = [row for row in known if row["steady_state"] == "steady"]
    if not known:
        return IN_PART, "All runs are too short to tell."
    share = len(good) / len(known)
    verdict = HOLDS if share > 0.9 else IN_PART if share > 0.5 else FAILS
    return verdict, (f"{len(good)} of {len(known)} runs with both frictions pass the test for a "
                     "steady state after 20 swirls (9 of 10 are asked for, since a test of many "
                     "runs fails now and then by chance).")


def clockwise(folder):
    rows = [row for row in folder.table("3a") if row["visits"] > 200]
    wrong = [row for row in rows if row["varpi_m"] > Z * row["varpi_m_error"]]
    verdict = HOLDS if not wrong else IN_PART if len(wrong) < 0.1 * len(rows) else FAILS
    fastest = max(row["varpi_m"] for row in rows)
    return verdict, (f"⟨ϖ_M⟩ is certainly positive in {len(wrong)} of {len(rows)} slices of θ and "
                     f"N; the highest is {number(fastest)} Ω.")


def pancake(folder):
    rows = folder.curve("1b", setting="high")
    gap = [(abs(row["by_time"] - row["pancake"]),
            math.hypot(row["by_time_error"], row["pancake_error"])) for row in rows]
    smaller = gap[0][0] - gap[-1][0] > Z * math.hypot(gap[0][1], gap[-1][1])
    close = gap[-1][0] < 0.05
    return all_or_some([smaller, close]), (
        f"Distance from the pancake's line: {number(*gap[0])} Ω at N = {rows[0]['discs']:.0f}, "
        f"{number(*gap[-1])} Ω at N = {rows[-1]['discs']:.0f}.")


def pinned_slices(rows):
    """Slices between becoming pinned and becoming free, going clockwise (θ falling)."""
    start, end = rows[0]["becoming_pinned"], rows[0]["becoming_free"]
    arc = (start - end) % 360
    return [row for row in rows if (start - row["theta"]) % 360 <= arc and row["visits"] > 0]


def pinned_means(folder, table, name):
    profile, result = folder.table(table), []
    for discs in sorted({row["discs"] for row in profile}):
        here = pinned_slices(tables.select(profile, discs=discs))
        total = sum(row["visits"] for row in here)
        if not total:
            continue
        mean = sum(row["visits"] * row[name] for row in here) / total
        error = math.sqrt(sum((row["visits"] * row[name + "_error"]) ** 2 for row in here)) / total
        result.append({"discs": discs, "mean": mean, "mean_error": error})
    return result


def pinned_reach_wall(folder):
    rows = pinned_means(folder, "3b", "normalised")
    first, last = rows[0], rows[-1]
    below = first["mean"] < 1 - Z * first["mean_error"]
    closer = abs(last["mean"] - 1) < abs(first["mean"] - 1)
    near = abs(last["mean"] - 1) < 0.05
    return all_or_some([below, closer, near]), (
        f"Normalised angular velocity in the pinned region: {ends(rows, 'mean')}.")


def pinned_faster(folder):
    rows = pinned_means(folder, "3a", "varpi_m")
    return rises(rows, "mean", sign=-1), f"⟨ϖ_M⟩/Ω in the pinned region: {ends(rows, 'mean')}."


def loose_peak(folder):
    peaks = []
    profile = folder.table("3a")
    for discs in sorted({row["discs"] for row in profile}):
        here = [row for row in tables.select(profile, discs=discs) if row["visits"] > 200]
        peaks.append((discs, max(here, key=lambda row: -row["varpi_m"])))
    heights = [-row["varpi_m"] for _, row in peaks]
    mean = sum(heights) / len(heights)
    scatter = max(abs(h - mean) for h in heights) / mean
    # "Quantitatively similar" is taken as within 15 % of the mean.
    verdict = HOLDS if scatter < 0.15 else IN_PART if scatter < 0.4 else FAILS
    return verdict, (f"Highest |⟨ϖ_M⟩|: {heights[0]:.2f} Ω at θ = {peaks[0][1]['theta']:.0f}° for "
                     f"N = {peaks[0][0]:.0f}, {heights[-1]:.2f} Ω at "
                     f"{peaks[-1][1]['theta']:.0f}° for N = {peaks[-1][0]:.0f}; within "
                     f"{100 * scatter:.0f} % of their mean at all N.")


def slip_rises(folder):
    rows = folder.curve("4a", setting="high")
    first, last = rows[0], rows[-1]
    rising = rises(rows, "pinned_region") != FAILS
    half = abs(first["pinned_region"] - 0.5) < 0.1
    one = last["pinned_region"] > 0.9
    return all_or_some([rising, half, one]), (
        f"s of the pinned discs: {ends(rows, 'pinned_region')} (asked: about 0.5 ± 0.1, rising to "
        "above 0.9).")


def slip_rough(folder):
    rough = {row["discs"]: row for row in folder.curve("4a", setting="high")}
    smooth = {row["discs"]: row for row in folder.curve("4a", setting="low")}
    pairs = [(rough[n], smooth[n]) for n in sorted(rough) if n in smooth]
    closer = [abs(1 - a["pinned_region"]) < abs(1 - b["pinned_region"]) for a, b in pairs]
    return all_or_some(closer), (
        f"s is closer to 1 for μ = 1 than for μ = 0.1 at {sum(closer)} of {len(closer)} N; "
        f"smooth: {ends([b for _, b in pairs], 'pinned_region')}.")


def wall_spin(folder):
    rows = folder.curve("4b", setting="high")
    return rises(rows, "pinned_wall_spin", sign=-1), (
        f"⟨|ω|⟩/Ω of the pinned discs at the wall: {ends(rows, 'pinned_wall_spin')}.")


def gears(folder):
    rows = folder.curve("4b", setting="high")
    negative = [row["spin_correlation"] < -Z * row["spin_correlation_error"] for row in rows]
    strong = [row["spin_correlation"] < -0.1 for row in rows]
    verdict = all_or_some(a and b for a, b in zip(negative, strong))
    if verdict == FAILS and sum(negative) > len(negative) / 2:
        verdict = IN_PART
    return verdict, (f"Correlation of the spins of touching neighbours: "
                     f"{ends(rows, 'spin_correlation')}; strongest "
                     f"{min(row['spin_correlation'] for row in rows):.3f}; certainly negative at "
                     f"{sum(negative)} of {len(rows)} N (gears would have −1; asked: below −0.1).".replace("-0.", "−0."))


def triangles(folder):
    rows = folder.curve("4b", setting="high")
    return rises(rows, "triangles"), (
        f"Share of the contacts that belong to a triangle: {ends(rows, 'triangles')}.")


def rough_earlier(folder):
    rough, smooth = folder.crossing("4c", "high"), folder.crossing("4c", "low")
    text = f"μ = 1: {crossing_text(rough)}; μ = 0.1: {crossing_text(smooth)}."
    if rough["verdict"] != "crosses":
        return FAILS, text
    if smooth["verdict"] != "crosses":
        return HOLDS if smooth["verdict"] == "always rotates" else IN_PART, text
    gap = smooth["crossing"] - rough["crossing"]
    error = math.hypot(smooth["crossing_error"], rough["crossing_error"])
    return (HOLDS if gap > Z * error else IN_PART if gap > 0 else FAILS), text


def angles(folder):
    rows = folder.curve("3a")
    seen = {row["discs"]: row for row in rows}
    return [seen[n] for n in sorted(seen)]


def unwrapped(values):
    """Angles in degrees without jumps of a whole turn."""
    result = []
    for value in values:
        if result:
            value += 360 * round((result[-1] - value) / 360)
        result.append(value)
    return result


def pinned_grows(folder):
    rows = angles(folder)
    return rises(rows, "share"), f"Share of the discs that is pinned: {ends(rows, 'share')}."


def pinned_earlier(folder):
    rows = [row for row in angles(folder) if row["becoming_pinned"] == row["becoming_pinned"]]
    path = unwrapped([row["becoming_pinned"] for row in rows])
    shift = path[-1] - path[0]
    # Discs run clockwise, so earlier is at a larger θ.
    verdict = HOLDS if shift > 10 else FAILS
    return verdict, (f"Becoming pinned at θ = {ends(rows, 'becoming_pinned')} (degrees); the place "
                     f"moves upstream by {shift:.0f}°. By the collisions: "
                     f"{ends(rows, 'becoming_pinned_by_collisions')}.".replace("-", "−"))


def free_fixed(folder):
    rows = [row for row in angles(folder) if row["becoming_free"] == row["becoming_free"]]
    path = unwrapped([row["becoming_free"] for row in rows])
    span = max(path) - min(path)
    # "The same location" is taken as within 20° over all N.
    verdict = HOLDS if span <= 20 else IN_PART if span <= 40 else FAILS
    return verdict, (f"Becoming free at θ = {ends(rows, 'becoming_free')} (degrees): over all N "
                     f"the place moves by {span:.0f}°. By the collisions: "
                     f"{ends(rows, 'becoming_free_by_collisions')}.")


def blow_up(folder):
    rows = folder.table("energy")

    def growth(sides):
        """The last tenth against the second: after the discs have been set in motion."""
        series = sorted(tables.select(rows, sides=float(sides)), key=lambda row: row["swirl"])
        tenth = max(len(series) // 10, 1)
        early, late = series[tenth:2 * tenth], series[-tenth:]
        return sum(r["energy"] for r in late) / sum(r["energy"] for r in early), series

    polygon, series = growth(30)
    circle, _ = growth(0)
    coarse, _ = growth(6)
    text = (f"In {series[-1]['swirl']:.0f} swirls at N = {series[0]['discs']:.0f}, from the second "
            f"tenth to the last, the energy grows {coarse:.3g}-fold on 6 sides, {polygon:.3g}-fold "
            f"on 30 and {circle:.3g}-fold on the true circle; no crash.")
    # It grows without end, but nothing crashes, and on the circle it need not grow.
    return (IN_PART if polygon > 1.2 or coarse > 2 else FAILS), text


def ball(folder):
    rows = folder.table("ball")
    rolling = [row["gamma"] for row in rows if row["slip"] == 1]
    slipping = [row["gamma"] for row in rows if row["slip"] == 0]
    verdict = HOLDS if min(rolling) > 1 and max(slipping) < 1 else FAILS
    return verdict, (f"γ = s R_container/R_ball: {min(rolling):.2f} to {max(rolling):.2f} when it "
                     f"rolls (s = 1), {max(slipping):.0f} when it slips.")


def elastic(folder):
    c = folder.crossing("restitution", "1")
    lossy = [folder.crossing("restitution", e) for e in ("0.99", "0.9")]
    text = "; ".join(f"e = {e}: {crossing_text(x)}" for e, x in zip((1, 0.99, 0.9), [c] + lossy))
    return (HOLDS if c["verdict"] == "crosses" else FAILS), text + "."


def untestable(why):
    return lambda folder: (UNTESTABLE, why)


CLAIMS = [
    Claim("main text, Fig. 5b", "With friction at the wall and between the discs the cluster "
          "rotates with the swirl at low N and counterrotates at high N.", "5b", transition),
    Claim("main text, Fig. 1b", "In the experiment the sense changes at roughly N = 36.", "5b",
          near_36),
    Claim("main text, Fig. 1b", "Beyond the crossing ϖ reaches a minimum and then rises slightly "
          "for the largest N.", "5b", minimum),
    Claim("main text, Fig. 5b", "The less friction, the higher the N at which the sense changes.",
          "5b", friction_order),
    Claim("main text, Fig. 5b", "Without wall friction the cluster turns with the swirl's own "
          "frequency at every N.", "5b", no_wall_at_omega("5b")),
    Claim("main text, Fig. 5b", "Without wall friction there is never a transition.", "5b",
          never_crosses("no-wall")),
    Claim("main text, Fig. 5b", "Without disc friction ϖ remains close to Ω.", "5b",
          no_disc_close),
    Claim("main text, Fig. 5b", "Without disc friction ϖ drops slightly at very high N.", "5b",
          no_disc_drop("5b")),
    Claim("main text, Fig. 5b", "The same drop, asked of the steady state after a long warm-up.",
          "5b-steady", no_disc_drop("5b-steady")),
    Claim("main text, Fig. 5b", "Without disc friction there is never a transition.", "5b",
          never_crosses("no-disc")),
    Claim("main text, Eq. 1", "Seen from the M-frame the cluster turns at ϖ − Ω.", "3a", frames),
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
    Claim("main text, Fig. 4a", "The slip parameter of the pinned discs rises from about 0.5 at "
          "N = 25 to nearly 1.", "4a", slip_rises),
    Claim("main text, Fig. 4a", "It is closer to 1 for rough discs than for smooth ones.", "4a",
          slip_rough),
    Claim("main text, Fig. 4b", "The spin of the discs along the wall in the pinned region falls "
          "with N.", "4b", wall_spin),
    Claim("main text", "Touching discs spin in opposite senses, like gears.", "4b", gears),
    Claim("main text", "With N more of the contacts are geometrically frustrated.", "4b",
          triangles),
    Claim("main text, Fig. 4c", "Rough discs change the sense at a lower N than smooth ones.",
          "4c", rough_earlier),
    Claim("main text", "Damping of the normal motion is not needed for the transition.",
          "restitution", elastic),
    Claim("main text", "A single ball counterrotates if it rolls on the wall and rotates if it "
          "slips freely.", "ball", ball),
    Claim("SI", "With both frictions zero the energy blows up and the program crashes.", "energy",
          blow_up),
    Claim("main text, Fig. 4", "Roughened plastic spheres cross at N = 28, smooth ones at 36.",
          "", untestable("It depends on the surfaces of the real spheres, whose friction "
                         "coefficients the paper does not give.")),
    Claim("main text", "Discs at the wall are kept from rolling on the ground.", "",
          untestable("The discs of the simulation have no floor and no third dimension.")),
]
