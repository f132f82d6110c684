"""What makes a cluster reverse? The experiment that stops the spins: rotation against N of particles that can spin and of
particles that cannot (--cannot-spin), with friction in all contacts, none between particles, and none at the wall; N_c
against the share of particles that cannot spin, and against the moment of inertia.

Other explanations are tested with the same runs: how well do the load of the neighbours, the length of a stay at the wall,
sticking and the spin at the wall predict the sign and the size of the rotation? The sign is predicted by the best threshold of a
quantity, and "sign" is the mean share of right predictions for both signs: 1 if the quantity decides, ½ if it knows
nothing. "size" is the rank correlation with ϖ. Points whose sign is not certain do not count for the sign. Limits: the
slip parameter of the whole cluster is ϖ itself in other units, so it explains nothing; that of the residents is nearly ϖ."""

import math

import numpy as np
import scipy.stats

import style
from combine import at, means, number
from curves import CERTAIN, measured_cells, rows_of, with_error
from engine import swirl
from figure import Figure
from jackknife import jackknife
from runs import lengths, text
from searches import search_cells, search_point
from study import Point

BODIES = {"discs": {}, "spheres": {"preset": "experiment"}}
SPINS = {"free": 0, "stopped": 1}
# Which contacts have no friction, and the parameters that say so. The next two are for discs only; without any friction
# discs are a gas, and spheres still have their floor.
CONTACTS = {"all contacts": {}, "none between particles": {"mu_disc": 0}, "none at the wall": {"mu_wall": 0},
            "none between two at the wall": {"frictionless": "boundary"}, "none between others": {"frictionless": "bulk"},
            "none at all": {"mu_disc": 0, "mu_wall": 0}}
SHOWN = tuple(CONTACTS)[:3]
OF_BODY = {"discs": tuple(CONTACTS)[:5], "spheres": (*SHOWN, "none at all")}
NUMBERS, QUICK_NUMBERS = (8, 16, 24, 32, 40, 48), (8, 24, 48)
MEASURED = ("slip.cluster=slip", "slip.resident=resident_slip", "frustration.wall_spin", "frustration.wall_sticking",
            "frustration.disc_sticking", "residence.length=stay")


def are_bearings(spins, contacts):
    """Free particles without friction between them become bearings, after 40 to 90 periods (discs). As spheres they
    collide twenty times as often as others."""
    return spins == "free" and contacts == "none between particles" or contacts == "none at all"


def length(settings, body, spins, contacts):
    bearings = are_bearings(spins, contacts)
    if body == "spheres":
        return lengths(settings, (20 if bearings else 30, 1), (15 if bearings else 60, 3))
    return lengths(settings, (300 if bearings else 100, 1), (150 if bearings else 400, 3))


def seeds_of(settings, body):
    """Spheres cost ten times as much as discs."""
    return min(settings.chapter_seeds, 3 if body == "spheres" else 5)


def given(body, spins, contacts, discs):
    friction = dict(CONTACTS[contacts])
    if body == "discs" and "frictionless" not in friction:
        friction = {"mu_disc": 1, "mu_wall": 1} | friction
    return {"discs": discs, **BODIES[body], **friction, "cannot_spin": SPINS[spins]}


def cases(settings, numbers):
    for body in BODIES:
        for spins in SPINS:
            for contacts in OF_BODY[body]:
                if contacts == "none at all" and spins == "free":
                    continue  # without friction no spin changes
                few = settings.quick or contacts not in SHOWN or body == "spheres" and are_bearings(spins, contacts)
                for discs in QUICK_NUMBERS if few else numbers:
                    yield body, spins, contacts, discs


# --- Loads ------------------------------------------------------------------------------------------

def loads(parameters):
    """Sums of the impulses of neighbours and of the wall, over the periods after the warm-up."""
    run = dict(parameters)
    periods, warmup = run.pop("periods"), run.pop("warmup")
    simulation = swirl.Simulation(**run)
    simulation.advance(periods=warmup)
    sums = dict.fromkeys(("neighbours", "wall", "neighbours_friction", "wall_friction"), 0.0)
    while True:
        events = simulation.step(20000)
        events = events[events["whole_periods"] < periods]
        for kind, name in ((0, "neighbours"), (1, "wall")):
            here = events[events["kind"] == kind]
            sums[name] += float(here["normal_impulse"].sum())
            sums[f"{name}_friction"] += float(np.abs(here["tangential_impulse"]).sum())
        if len(events) < 20000:
            return {"load": sums["neighbours"] / sums["wall"],
                    "friction_over_load": sums["neighbours_friction"] / sums["neighbours"]}


# --- Points -----------------------------------------------------------------------------------------

# Friction of the searches against share and inertia, and the searches for single settings.
FRICTIONS = (1, 0.5, 0.3)
SHARES, INERTIAS = (0.25, 0.5, 0.75), (0.5, 1, 3, 100, 1e4)
FEWER_SHARES, FEWER_INERTIAS = (0.5,), (0.5, 3, 100)  # with less friction
SEARCHES = [("discs", {"mu_disc": mu_disc, "mu_wall": mu_wall, "cannot_spin": 1})
            for mu_disc, mu_wall in ((0, 1), (0.1, 1), (0.3, 1), (0, 0.3))] + [
    ("spheres", {"preset": "experiment", "cannot_spin": 0}), ("spheres", {"preset": "experiment", "cannot_spin": 1}),
    ("spheres", {"preset": "experiment", "cannot_spin": 1, "mu_disc": 0})]


def searches(settings):
    """[(body, parameters)] of all searches, each once."""
    found = list(SEARCHES)
    for mu in FRICTIONS[:1] if settings.quick else FRICTIONS:
        friction = {"mu_disc": mu, "mu_wall": mu}
        shares, inertias = (SHARES, INERTIAS) if mu == 1 else (FEWER_SHARES, FEWER_INERTIAS)
        found += [("discs", {**friction, "cannot_spin": share}) for share in ((0, 1) if settings.quick else (0, *shares, 1))]
        if not settings.quick:
            found += [("discs", {**friction, "inertia": inertia, "cannot_spin": 0}) for inertia in inertias]
    return found


def points(settings):
    made = []
    for body, spins, contacts, discs in cases(settings, NUMBERS):
        run = given(body, spins, contacts, discs) | length(settings, body, spins, contacts)
        made.append(Point(settings, f"cause_{body}_{spins}_{contacts.replace(' ', '-')}_N{discs}", seeds_of(settings, body), run,
                          ["slip", "frustration", "residence"],
                          cells={"body": body, "spins": spins, "contacts": contacts, "discs": discs}))
    for body, spins, contacts, discs in cases(settings, NUMBERS):
        every_number = (spins, contacts) == ("free", "all contacts")
        if contacts not in SHOWN[:2] or not every_number and discs not in QUICK_NUMBERS:
            continue
        bearings = are_bearings(spins, contacts)
        run = given(body, spins, contacts, discs) | (
            lengths(settings, (20, 1), (10, 2)) if body == "spheres" else lengths(settings, (150 if bearings else 30, 1), (30, 2)))
        made.append(Point(settings, f"cause_load_{body}_{spins}_{contacts.replace(' ', '-')}_N{discs}", 2, run, work=loads,
                          cells={"load of": (body, spins, contacts, discs)}))
    for body, run in searches(settings):
        name = "_".join(f"{key}{text(value) if key != 'preset' else ''}" for key, value in run.items())
        made.append(search_point(settings, f"cause_crossing_{name}", run, 12, 54, {"search": body, **run}, tolerance=0.3,
                                 min_periods=60))
    return made


# --- Tables -----------------------------------------------------------------------------------------

def load_cells(points):
    """{case: columns} of the loads, with errors over the seeds."""
    return {p.cells["load of"]: means(p.runs, ("load", "friction_over_load")) for p in points if "load of" in p.cells and p.runs}


def table(points, settings):
    curves = [p for p in points if "contacts" in p.cells]
    loaded, rows = load_cells(points), []
    for point, row in zip(curves, rows_of(curves, MEASURED)):
        case = tuple(point.cells.values())
        none = dict.fromkeys(("load", "load_error", "friction_over_load", "friction_over_load_error"), math.nan)
        rows.append({**row, **loaded.get(case, none)})
    crossings = [crossing_row(p) for p in points if "search" in p.cells]
    ranks = predictors(rows)
    return {"": rows, "_crossings": crossings, "_predictors": ranks}, findings(rows, crossings, ranks)


def crossing_row(point):
    c = point.cells
    found = search_cells(at(point.result, "runs")[0]) if at(point.result, "runs") else {}
    return {"body": c["search"], "mu_disc": c.get("mu_disc", 0.33), "mu_wall": c.get("mu_wall", 0.33),
            "inertia": c.get("inertia", 0.4 if c["search"] == "spheres" else 10), "cannot_spin": c["cannot_spin"],
            **{name: found.get(name, math.nan) for name in ("crosses", "crossing", "crossing_error", "lower", "upper", "runs",
                                                           "runs_not_steady")}}


# Quantities, in words.
PREDICTORS = {"wall_spin": "spin at the wall", "wall_sticking": "share of sticking wall contacts",
          "load": "load of the neighbours, relative to the wall", "stay": "length of a stay at the wall",
          "resident_slip": "slip parameter of the residents"}


def sign_score(values, negative):
    """Best threshold: mean of the shares of right predictions for both signs, whichever side is negative."""
    best = 0.5
    for level in np.unique(values):
        above = values >= level
        right = 0.5 * (above[negative].mean() + (~above)[~negative].mean())
        best = max(best, right, 1 - right)
    return best


def groups_of(rows):
    return [("discs and spheres", rows), *((body, [row for row in rows if row["body"] == body]) for body in BODIES)]


def predictors(rows):
    found = []
    for group, here in groups_of([row for row in rows if not math.isnan(row["load"])]):
        rotation = np.array([row["mean_by_time"] for row in here])
        certain = np.abs(rotation) > CERTAIN * np.array([row["mean_by_time_error"] for row in here])
        for name in PREDICTORS:
            values = np.array([row[name] for row in here])
            known = np.isfinite(values) & np.isfinite(rotation)
            x, y, sure = values[known], rotation[known], certain[known]
            size, size_error = jackknife(len(x), lambda k: scipy.stats.spearmanr(x[k], y[k]).statistic)
            found.append({"group": group, "predictor": name, "points": len(x), "negative": int((y[sure] < 0).sum()),
                          "sign": sign_score(x[sure], y[sure] < 0) if (y[sure] < 0).any() else math.nan,
                          "size": size, "size_error": size_error})
    return found


def rotation_words(rows, **case):
    here = [row for row in rows if all(row[name] == value for name, value in case.items())]
    return ", ".join(f"{with_error(row['mean_by_time'], row['mean_by_time_error'])} at N = {row['discs']}" for row in here[-2:])


def findings(rows, crossings, ranks):
    def n_c(**case):
        return next((with_error(row["crossing"], row["crossing_error"]) for row in crossings
                     if all(row[name] == value for name, value in case.items()) and row["crosses"] == 1), "none found")
    words = []
    for body, mu in (("discs", 1), ("spheres", 0.33)):
        inertia = 10 if body == "discs" else 0.4
        both = dict(body=body, mu_disc=mu, mu_wall=mu, inertia=inertia)
        words.append(
            f"N_c of {body} is {n_c(**both, cannot_spin=0)} if they spin, {n_c(**both, cannot_spin=1)} if they cannot, and "
            f"{n_c(**both | {'mu_disc': 0}, cannot_spin=1)} if they cannot and have no friction between them. If they can "
            f"spin and have no friction between them, ϖ/Ω = "
            f"{rotation_words(rows, body=body, spins='free', contacts='none between particles')}. If they cannot spin and "
            f"the wall is smooth, ϖ/Ω = {rotation_words(rows, body=body, spins='stopped', contacts='none at the wall')}.")
    best = [row for row in ranks if row["group"] == "discs and spheres"]
    words.append("Over all runs, sign and size are predicted by: " + "; ".join(
        f"{PREDICTORS[row['predictor']]} {row['sign']:.2f} and {with_error(row['size'], row['size_error'])}" for row in best) + ".")
    return words


# --- Drawing ----------------------------------------------------------------------------------------

LOOK = {"all contacts": (style.BLACK, "o"), "none between particles": (style.BLUE, "s"), "none at the wall": (style.RED, "^")}
QUANTITIES = (("wall_spin", r"spin at the wall, $\Omega$"), ("load", "load of neighbours / wall"),
              ("wall_sticking", "sticking wall contacts"), ("stay", "stay at the wall, periods"))


def draw(table_file):
    # Open symbols are particles that can spin, so the caption says where the steady state is found.
    rows = [{**row, "steady_state": "steady"} for row in style.read(table_file)]
    crossings = style.read(table_file.replace(".csv", "_crossings.csv"))
    drawing, axes = style.figure(style.PAGE, 6.6, nrows=3, ncols=4)
    big = [drawing.add_subplot(axes[0, 0].get_gridspec()[0, 2 * k:2 * k + 2]) for k in range(2)]
    for panel in axes[0]:
        panel.remove()
    for body, panel, row in zip(BODIES, big, (1, 2)):
        style.zero_line(panel)
        for contacts in SHOWN:
            color, marker = LOOK[contacts]
            for spins in SPINS:
                here = style.select(rows, body=body, spins=spins, contacts=contacts)
                look = {"color": color, "marker": marker, "linestyle": "-" if spins == "stopped" else ":",
                        "markerfacecolor": color if spins == "stopped" else "white"}
                style.curve(panel, here, "discs", "mean_by_time", **look,
                            label=f"friction: {contacts}" if spins == "stopped" else "_")
                for small, (name, words) in zip(axes[row], QUANTITIES):
                    known = [r for r in here if r[name] == r[name]]
                    if known:
                        style.curve(small, known, "discs", name, linewidth=0.8, **look)
                    small.set(xlabel=f"number of {body} $N$", ylabel=words)
        panel.set(xlabel=f"number of {body} $N$", ylabel=r"rotation $\varpi/\Omega$", ylim=(-0.12, 1.2))
        style.fine_near_zero(panel, [r["mean_by_time"] for r in rows])
        axes[row][QUANTITIES.index(("stay", QUANTITIES[-1][1]))].set_yscale("log")
    style.legend_of_all(drawing, big[0], ncol=3)
    style.note(drawing, "full symbols, lines: cannot spin; open, dotted: free")
    style.save(drawing, table_file)
    draw_crossings(table_file, crossings)


def draw_crossings(table_file, crossings):
    drawing, axes = style.figure(style.PAGE, 2.7, ncols=2)
    discs = [row for row in crossings if row["body"] == "discs" and row["mu_disc"] == row["mu_wall"] and row["crosses"] == 1]
    for k, mu in enumerate(FRICTIONS):
        here = [row for row in discs if row["mu_disc"] == mu]
        shares = sorted((row for row in here if row["inertia"] == 10), key=lambda row: row["cannot_spin"])
        heavy = sorted((row for row in here if row["cannot_spin"] == 0), key=lambda row: row["inertia"])
        look = style.look_of(k)
        if shares:
            style.curve(axes[0], shares, "cannot_spin", "crossing", label=rf"$\mu = {mu:g}$", **look)
        if heavy:
            style.curve(axes[1], heavy, "inertia", "crossing", label=rf"$\mu = {mu:g}$", **look)
        for row in here:
            if row["cannot_spin"] == 1:
                axes[1].axhline(row["crossing"], color=look["color"], linestyle="--", linewidth=0.7)
    axes[0].set(xlabel="share of discs that cannot spin", ylabel="$N_c$")
    axes[1].set(xlabel=r"moment of inertia $I/mr^2$", ylabel="$N_c$", xscale="log")
    style.legend(axes[0], ncol=3)
    style.note(drawing, "dashed: discs that cannot spin")
    style.save(drawing, table_file.replace(".csv", "_crossings.csv"))


FIGURES = [Figure("cause", "chapters", "chapter: what makes the cluster reverse? Spins that are stopped", points, table, draw,
                  caption="Rotation and four quantities against the number of discs and of spheres (experiment's preset), for "
                  "particles that can spin (open symbols, dotted) and that cannot (full). Colours: which contacts have "
                  "friction. The load is the normal impulse that neighbours exchange, divided by that of the wall. The table "
                  "has the verdict on each steady state.")]
