"""What makes a cluster reverse? The experiment that stops the spins: rotation against N of
particles that can spin and of particles that cannot (--cannot-spin), with friction in all contacts,
none between particles, and none at the wall; N_c against the share of particles that cannot spin,
and against the moment of inertia.

Other explanations are tested with the same runs: how well do the load of the neighbours, the length
of a stay at the wall, sticking and the spin at the wall predict the sign and the size of the
rotation? The sign is predicted by the best threshold of a quantity, and "sign" is the mean share of
right predictions for both signs: 1 if the quantity decides, ½ if it knows nothing. "size" is the
rank correlation with ϖ. Points whose sign is not certain do not count for the sign. Limits: the
slip parameter of the whole cluster is ϖ itself in other units, so it explains nothing; that of the
residents is nearly ϖ."""

import dataclasses
import math

import numpy as np
import scipy.stats

from paper import style
from paper.combine import at, means, number
from paper.crossing_law import law_rows
from paper.curves import CERTAIN, measured_cells, rows_of, with_error
from paper.engine import swirl
from paper.figure import Figure
from paper.jackknife import jackknife
from paper.runs import lengths, text
from paper.searches import search_cells, search_point
from paper.study import Point

BODIES = {"discs": {}, "spheres": {"preset": "experiment"}}
SPINS = {"free": 0, "stopped": 1}
# Which contacts have no friction, and the parameters that say so. The next two are for discs only;
# without any friction discs are a gas, and spheres still have their floor.
CONTACTS = {
    "all contacts": {},
    "none between particles": {"mu_disc": 0},
    "none at the wall": {"mu_wall": 0},
    "none between two at the wall": {"frictionless": "boundary"},
    "none between others": {"frictionless": "bulk"},
    "none at all": {"mu_disc": 0, "mu_wall": 0},
}
SHOWN = tuple(CONTACTS)[:3]
OF_BODY = {"discs": tuple(CONTACTS)[:5], "spheres": (*SHOWN, "none at all")}
NUMBERS, QUICK_NUMBERS = (8, 16, 24, 32, 40, 48), (8, 24, 48)
MEASURED = (
    "slip.cluster=slip",
    "slip.resident=resident_slip",
    "frustration.wall_spin",
    "frustration.wall_sticking",
    "frustration.disc_sticking",
    "residence.length=stay",
)


def are_bearings(spins, contacts):
    """Free particles without friction between them become bearings, after 40 to 90 periods (discs).
    As spheres they collide twenty times as often as others."""
    return spins == "free" and contacts == "none between particles" or contacts == "none at all"


def length(settings, body, spins, contacts):
    bearings = are_bearings(spins, contacts)
    if body == "spheres":
        return lengths(settings, (20 if bearings else 30, 1), (15 if bearings else 60, 3))
    return lengths(settings, (300 if bearings else 100, 1), (150 if bearings else 400, 3))


# Fewer than eight seeds, where particles collide many times more often.
FEW_SEEDS = {
    ("discs", "free", "none at the wall"): 5,
    ("spheres", "free", "none between particles"): 3,
    ("spheres", "free", "none at the wall"): 3,
    ("spheres", "stopped", "none at the wall"): 3,
    ("spheres", "stopped", "none at all"): 3,
}


def seeds_of(settings, body, spins, contacts, discs):
    """Spheres at a smooth wall have eight at the largest N, where their sign counts."""
    few = FEW_SEEDS.get((body, spins, contacts), 8)
    return min(
        settings.chapter_seeds,
        8 if body == "spheres" and contacts == "none at the wall" and discs == NUMBERS[-1] else few,
    )


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
                few = (
                    settings.quick
                    or contacts not in SHOWN
                    or body == "spheres"
                    and are_bearings(spins, contacts)
                )
                for discs in QUICK_NUMBERS if few else numbers:
                    yield body, spins, contacts, discs


# --- Loads
# ------------------------------------------------------------------------------------------


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
            return {
                "load": sums["neighbours"] / sums["wall"],
                "friction_over_load": sums["neighbours_friction"] / sums["neighbours"],
            }


# --- The floor
# --------------------------------------------------------------------------------------

# Spheres at a smooth wall, and what may drive them there: parameters.
AT_SMOOTH_WALL = (
    {},
    {"floor": "none"},
    {"vertical_disc": 0},
    {"floor_friction": 0.05},
    {"floor_friction": 1},
)
# Snapshots of a seed: a prime, so that they are in all phases of a path segment, because spheres
# slide after a vertex. The distance of a centre from the wall.
SNAPSHOTS, NEAR_WALL = 97, 1.25
TORQUES = ("torque_at_wall", "torque_inside")


def floor_torques(parameters):
    """Torque of the floor's sliding friction about the centre of mass, in μ_f m g r: on the spheres
    at the wall, and on the others."""
    run = dict(parameters)
    periods, warmup = run.pop("periods"), run.pop("warmup")
    simulation = swirl.Simulation(**run)
    simulation.advance(periods=warmup)
    found = []
    for _ in range(SNAPSHOTS):
        simulation.advance(periods=(periods - warmup) / SNAPSHOTS)
        now = simulation.snapshot()
        place = now.position - now.container_centre
        roll = now.rolling_spin
        slip = (
            now.velocity
            - np.asarray(now.container_velocity)
            + np.stack((-roll[:, 1], roll[:, 0]), axis=1)
        )
        speed = np.hypot(*slip.T)
        force = -slip / np.where(speed > 1e-9, speed, math.inf)[:, None]
        arm = place - place.mean(axis=0)
        torque = arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]
        at_wall = np.hypot(*place.T) > now.container_radius - NEAR_WALL
        found.append((torque[at_wall].sum(), torque[~at_wall].sum()))
    return dict(zip(TORQUES, np.mean(found, axis=0).tolist()))


def floor_points(settings):
    made = []
    for case in AT_SMOOTH_WALL[:2] if settings.quick else AT_SMOOTH_WALL:
        run = {"preset": "experiment", "discs": 48, "mu_wall": 0, **case} | lengths(
            settings, (30, 1), (60, 3)
        )
        name = "_".join(
            f"{key}{value if isinstance(value, str) else text(value)}"
            for key, value in case.items()
        )
        cells = {
            "floor_friction": 0 if "floor" in case else case.get("floor_friction", 0.33),
            "vertical_disc": case.get("vertical_disc", 1),
        }
        few = (
            settings.chapter_seeds if cells["vertical_disc"] else min(settings.chapter_seeds, 5)
        )  # those are bearings
        made.append(
            Point(settings, f"cause_floor_{name}", few, run, cells={"at smooth wall": cells})
        )
        if cells["floor_friction"] and cells["vertical_disc"]:
            made.append(
                Point(
                    settings,
                    f"cause_floor_torque_{name}",
                    settings.chapter_seeds,
                    run,
                    work=floor_torques,
                    cells={"torque of": cells},
                )
            )
    return made


def floor_rows(points):
    """The torques in m g r."""
    torques = [
        (p.cells["torque of"], means(p.runs, TORQUES))
        for p in points
        if "torque of" in p.cells and p.runs
    ]
    rows = []
    for point in points:
        if "at smooth wall" not in point.cells:
            continue
        cells, row = point.cells["at smooth wall"], rows_of([point])[0]
        found = next((found for case, found in torques if case == cells), {})
        rows.append(
            {
                **cells,
                **{
                    name: row[name]
                    for name in ("mean_by_time", "mean_by_time_error", "steady_state")
                },
                **{
                    f"{name}{end}": cells["floor_friction"] * found.get(f"{name}{end}", math.nan)
                    for name in TORQUES
                    for end in ("", "_error")
                },
            }
        )
    return rows


# --- Repetitions
# ------------------------------------------------------------------------------------

# What was measured before, by an independent program and by this one with --inertia 1e9: the
# quantity, the parameters, the value and its error (n/a: one seed). Two sets of seeds repeat it.
STOPPED = {"mu_disc": 0, "mu_wall": 1, "cannot_spin": 1}
SPHERES = {"preset": "experiment"}
BEFORE = (
    ("N_c", {"mu_disc": 1, "mu_wall": 1, "cannot_spin": 0}, 38.5, 0.1),
    ("N_c", {"mu_disc": 1, "mu_wall": 1, "cannot_spin": 1}, 28.5, 0.1),
    ("N_c", STOPPED, 42.6, 0.2),
    ("N_c", STOPPED | {"mu_wall": 0.3}, 45.4, 0.3),
    ("N_c", {"mu_disc": 0.5, "mu_wall": 0.5, "cannot_spin": 1}, 39.7, 0.2),
    ("N_c", SPHERES | {"cannot_spin": 0}, 36, math.nan),
    ("N_c", SPHERES | {"cannot_spin": 1}, 29, math.nan),
    ("N_c", SPHERES | {"cannot_spin": 1, "mu_disc": 0}, 44, math.nan),
    ("wall_spin", {"discs": 48} | STOPPED | {"cannot_spin": 0}, 7.591, 0.004),
    ("mean_by_time", {"discs": 48} | STOPPED | {"cannot_spin": 0}, 1.0003, 0.0005),
    ("mean_by_time", {"discs": 30} | STOPPED, 0.0075, 0.0013),
    ("mean_by_time", {"discs": 46} | STOPPED, -0.0053, 0.0004),
    ("mean_by_time", {"discs": 48} | STOPPED, -0.0063, 0.0003),
    ("mean_by_time", {"discs": 50} | STOPPED, -0.0075, 0.0003),
    ("mean_by_time", {"discs": 48} | STOPPED | {"mu_wall": 0.3}, -0.0049, 0.0004),
    ("mean_by_time", {"discs": 40} | STOPPED | {"mu_wall": 0.1}, math.nan, math.nan),
    ("mean_by_time", {"discs": 48} | STOPPED | {"mu_wall": 0.1}, 0.0071, 0.0005),
    ("mean_by_time", {"discs": 54} | STOPPED | {"mu_wall": 0.1}, math.nan, math.nan),
    ("mean_by_time", {"discs": 48, "mu_disc": 1, "mu_wall": 1, "cannot_spin": 1}, -0.0434, 0.0005),
    ("mean_by_time", {"discs": 48, "mu_disc": 1, "mu_wall": 1, "cannot_spin": 0}, -0.036, math.nan),
)
QUICK_BEFORE = (1, 12)
SETS = {"first": 0, "second": 1000}  # added to the seeds


def repeated_points(settings):
    made = []
    for k, (quantity, run, *_) in enumerate(BEFORE):
        if settings.quick and k not in QUICK_BEFORE:
            continue
        for name, shift in SETS.items():
            own = dataclasses.replace(settings, seed=settings.seed + shift)
            cells = {"repeated": k, "set": name}
            if quantity == "N_c":
                made.append(crossing_point(own, run, cells))
            else:
                lasts = length(
                    settings,
                    "discs",
                    "stopped" if run["cannot_spin"] else "free",
                    "all contacts" if run["mu_disc"] else "none between particles",
                )
                made.append(
                    Point(
                        own,
                        f"cause_repeated_{k}_{name}",
                        settings.chapter_seeds,
                        run | lasts,
                        ["slip", "frustration", "residence"],
                        cells=cells,
                    )
                )
    return made


def found_in(point, quantity):
    """Value and error of a repetition."""
    if quantity == "N_c":
        row = crossing_row(point)
        return row["crossing"], row["crossing_error"]
    average = (
        at(point.result, "measured", "frustration", quantity)
        if quantity == "wall_spin"
        else at(point.result, "rotation", quantity)
    )
    return number(at(average, "mean")), number(at(average, "error"))


def apart(a, a_error, b, b_error):
    """In errors of the difference."""
    return (a - b) / math.hypot(a_error, b_error)


def repeated_rows(points):
    rows = []
    for k, (quantity, run, before, before_error) in enumerate(BEFORE):
        here = {
            p.cells["set"]: found_in(p, quantity) for p in points if p.cells.get("repeated") == k
        }
        if not here:
            continue
        first, second = (here[name] for name in SETS)
        friction = 0.33 if "preset" in run else math.nan
        rows.append(
            {
                "quantity": quantity,
                "body": "spheres" if "preset" in run else "discs",
                "discs": run.get("discs", math.nan),
                "mu_disc": run.get("mu_disc", friction),
                "mu_wall": run.get("mu_wall", friction),
                "cannot_spin": run["cannot_spin"],
                "first": first[0],
                "first_error": first[1],
                "second": second[0],
                "second_error": second[1],
                "before": before,
                "before_error": before_error,
                "first_from_before": apart(*first, before, before_error),
                "second_from_before": apart(*second, before, before_error),
                "first_from_second": apart(*first, *second),
            }
        )
    return rows


# --- Points
# -----------------------------------------------------------------------------------------

# Friction of the searches against share and inertia, and the searches for single settings.
FRICTIONS = (1, 0.5, 0.3)
SHARES, INERTIAS = (0.25, 0.5, 0.75), (0.5, 1, 3, 100, 1e4)
SEARCHES = [
    ("discs", {"mu_disc": mu_disc, "mu_wall": mu_wall, "cannot_spin": 1})
    for mu_disc, mu_wall in ((0, 1), (0.1, 1), (0.3, 1), (0, 0.3))
] + [
    ("spheres", {"preset": "experiment", "cannot_spin": 0}),
    ("spheres", {"preset": "experiment", "cannot_spin": 1}),
    ("spheres", {"preset": "experiment", "cannot_spin": 1, "mu_disc": 0}),
]


def searches(settings):
    """[(body, parameters)] of all searches, each once."""
    found = SEARCHES[:1] if settings.quick else list(SEARCHES)
    for mu in FRICTIONS[:1] if settings.quick else FRICTIONS:
        friction = {"mu_disc": mu, "mu_wall": mu}
        found += [
            ("discs", {**friction, "cannot_spin": share})
            for share in ((0, 1) if settings.quick else (0, *SHARES, 1))
        ]
        if not settings.quick:
            found += [
                ("discs", {**friction, "inertia": inertia, "cannot_spin": 0})
                for inertia in INERTIAS
            ]
    return found


def points(settings):
    made = []
    for body, spins, contacts, discs in cases(settings, NUMBERS):
        run = given(body, spins, contacts, discs) | length(settings, body, spins, contacts)
        made.append(
            Point(
                settings,
                f"cause_{body}_{spins}_{contacts.replace(' ', '-')}_N{discs}",
                seeds_of(settings, body, spins, contacts, discs),
                run,
                ["slip", "frustration", "residence"],
                cells={"body": body, "spins": spins, "contacts": contacts, "discs": discs},
            )
        )
    for body, spins, contacts, discs in cases(settings, NUMBERS):
        every_number = (spins, contacts) == ("free", "all contacts")
        if contacts not in SHOWN[:2] or not every_number and discs not in QUICK_NUMBERS:
            continue
        bearings = are_bearings(spins, contacts)
        run = given(body, spins, contacts, discs) | (
            lengths(settings, (20, 1), (10, 2))
            if body == "spheres"
            else lengths(settings, (150 if bearings else 30, 1), (30, 2))
        )
        made.append(
            Point(
                settings,
                f"cause_load_{body}_{spins}_{contacts.replace(' ', '-')}_N{discs}",
                settings.chapter_seeds,
                run,
                work=loads,
                cells={"load of": (body, spins, contacts, discs)},
            )
        )
    made += [
        crossing_point(settings, run, {"search": body, **run}) for body, run in searches(settings)
    ]
    return made + floor_points(settings) + repeated_points(settings)


def crossing_point(settings, run, cells):
    """Searches with discs that are repeated have smaller errors."""
    precise = "preset" not in run and any(
        run == repeated for quantity, repeated, *_ in BEFORE if quantity == "N_c"
    )
    tolerance, periods = (0.2, 100) if precise else (0.3, 60)
    name = "_".join(f"{key}{text(value) if key != 'preset' else ''}" for key, value in run.items())
    return search_point(settings, f"cause_crossing_{name}", run, 12, 54, cells, tolerance, periods)


# --- Tables
# -----------------------------------------------------------------------------------------


def load_cells(points):
    """{case: columns} of the loads, with errors over the seeds."""
    return {
        p.cells["load of"]: means(p.runs, ("load", "friction_over_load"))
        for p in points
        if "load of" in p.cells and p.runs
    }


def table(points, settings):
    curves = [p for p in points if "contacts" in p.cells]
    loaded, rows = load_cells(points), []
    for point, row in zip(curves, rows_of(curves, MEASURED)):
        case = tuple(point.cells.values())
        none = dict.fromkeys(
            ("load", "load_error", "friction_over_load", "friction_over_load_error"), math.nan
        )
        rows.append({**row, **loaded.get(case, none)})
    crossings = [{**described(p.cells), **crossing_row(p)} for p in points if "search" in p.cells]
    ranks = predictors(rows)
    return {
        "": rows,
        "_crossings": crossings,
        "_predictors": ranks,
        "_floor": floor_rows(points),
        "_law": law_rows(crossings, settings.out),
        "_repeated": repeated_rows(points),
    }, findings(rows, crossings, ranks)


def described(c):
    return {
        "body": c["search"],
        "mu_disc": c.get("mu_disc", 0.33),
        "mu_wall": c.get("mu_wall", 0.33),
        "inertia": c.get("inertia", 0.4 if c["search"] == "spheres" else 10),
        "cannot_spin": c["cannot_spin"],
    }


def crossing_row(point):
    found = search_cells(at(point.result, "runs")[0]) if at(point.result, "runs") else {}
    return {
        name: found.get(name, math.nan)
        for name in (
            "crosses",
            "crossing",
            "crossing_error",
            "lower",
            "upper",
            "runs",
            "runs_not_steady",
        )
    }


# Quantities, in words.
PREDICTORS = {
    "wall_spin": "spin at the wall",
    "wall_sticking": "share of sticking wall contacts",
    "load": "load of the neighbours, relative to the wall",
    "stay": "length of a stay at the wall",
    "resident_slip": "slip parameter of the residents",
}


def sign_score(values, negative):
    """Best threshold: mean of the shares of right predictions for both signs, whichever side is
    negative."""
    best = 0.5
    for level in np.unique(values):
        above = values >= level
        right = 0.5 * (above[negative].mean() + (~above)[~negative].mean())
        best = max(best, right, 1 - right)
    return best


def groups_of(rows):
    return [
        ("discs and spheres", rows),
        *((body, [row for row in rows if row["body"] == body]) for body in BODIES),
    ]


def predictors(rows):
    found = []
    for group, here in groups_of([row for row in rows if not math.isnan(row["load"])]):
        rotation = np.array([row["mean_by_time"] for row in here])
        certain = np.abs(rotation) > CERTAIN * np.array([row["mean_by_time_error"] for row in here])
        for name in PREDICTORS:
            values = np.array([row[name] for row in here])
            known = np.isfinite(values) & np.isfinite(rotation)
            x, y, sure = values[known], rotation[known], certain[known]
            size, size_error = jackknife(
                len(x), lambda k: scipy.stats.spearmanr(x[k], y[k]).statistic
            )
            found.append(
                {
                    "group": group,
                    "predictor": name,
                    "points": len(x),
                    "negative": int((y[sure] < 0).sum()),
                    "sign": sign_score(x[sure], y[sure] < 0) if (y[sure] < 0).any() else math.nan,
                    "size": size,
                    "size_error": size_error,
                }
            )
    return found


def rotation_words(rows, **case):
    here = [row for row in rows if all(row[name] == value for name, value in case.items())]
    return ", ".join(
        f"{with_error(row['mean_by_time'], row['mean_by_time_error'])} at N = {row['discs']}"
        for row in here[-2:]
    )


def findings(rows, crossings, ranks):
    def n_c(**case):
        return next(
            (
                with_error(row["crossing"], row["crossing_error"])
                for row in crossings
                if all(row[name] == value for name, value in case.items()) and row["crosses"] == 1
            ),
            "none found",
        )

    words = []
    for body, mu in (("discs", 1), ("spheres", 0.33)):
        inertia = 10 if body == "discs" else 0.4
        both = dict(body=body, mu_disc=mu, mu_wall=mu, inertia=inertia)
        words.append(
            f"N_c of {body} is {n_c(**both, cannot_spin=0)} if they spin, "
            f"{n_c(**both, cannot_spin=1)} if they cannot, and "
            f"{n_c(**both | {'mu_disc': 0}, cannot_spin=1)} if they cannot and have no friction "
            f"between them. If they can spin and have no friction between them, ϖ/Ω = "
            f"{rotation_words(rows, body=body, spins='free', contacts='none between particles')}. "
            "If they cannot spin and the wall is smooth, ϖ/Ω = "
            f"{rotation_words(rows, body=body, spins='stopped', contacts='none at the wall')}."
        )
    best = [row for row in ranks if row["group"] == "discs and spheres"]
    words.append(
        "Over all runs, sign and size are predicted by: "
        + "; ".join(
            f"{PREDICTORS[row['predictor']]} {row['sign']:.2f} and "
            f"{with_error(row['size'], row['size_error'])}"
            for row in best
        )
        + "."
    )
    return words


# --- Drawing
# ----------------------------------------------------------------------------------------

LOOK = {
    "all contacts": (style.BLACK, "o"),
    "none between particles": (style.BLUE, "s"),
    "none at the wall": (style.RED, "^"),
}
QUANTITIES = (
    ("wall_spin", r"spin at the wall, $\Omega$"),
    ("load", "load of neighbours / wall"),
    ("wall_sticking", "sticking wall contacts"),
    ("stay", "stay at the wall, periods"),
)


def draw(table_file):
    # Open symbols are particles that can spin, so the caption says where the steady state is found.
    rows = [{**row, "steady_state": "steady"} for row in style.read(table_file)]
    crossings = style.read(table_file.replace(".csv", "_crossings.csv"))
    drawing, axes = style.figure(style.PAGE, 6.6, nrows=3, ncols=4)
    big = [drawing.add_subplot(axes[0, 0].get_gridspec()[0, 2 * k : 2 * k + 2]) for k in range(2)]
    for panel in axes[0]:
        panel.remove()
    for discs, spheres in zip(axes[1], axes[2]):
        spheres.sharey(discs)
    for body, panel, row in zip(BODIES, big, (1, 2)):
        style.zero_line(panel)
        for contacts in SHOWN:
            color, marker = LOOK[contacts]
            for spins in SPINS:
                here = style.select(rows, body=body, spins=spins, contacts=contacts)
                look = {
                    "color": color,
                    "marker": marker,
                    "linestyle": "-" if spins == "stopped" else ":",
                    "markerfacecolor": color if spins == "stopped" else "white",
                }
                style.curve(
                    panel,
                    here,
                    "discs",
                    "mean_by_time",
                    **look,
                    label=f"friction: {contacts}" if spins == "stopped" else "_",
                )
                for small, (name, words) in zip(axes[row], QUANTITIES):
                    known = [r for r in here if r[name] == r[name]]
                    if known:
                        style.curve(small, known, "discs", name, linewidth=0.8, **look)
                    small.set(xlabel=f"number of {body} $N$", ylabel=words, xlim=(5, 51))
        panel.set(
            xlabel=f"number of {body} $N$",
            ylabel=r"rotation $\varpi/\Omega$",
            xlim=(5, 51),
            ylim=(-0.12, 1.2),
        )
        style.fine_near_zero(panel, [r["mean_by_time"] for r in rows])
        axes[row][QUANTITIES.index(("stay", QUANTITIES[-1][1]))].set_yscale("log")
    style.legend_of_all(drawing, big[0], ncol=3)
    style.note(drawing, "full symbols, lines: cannot spin; open, dotted: free")
    style.save(drawing, table_file)
    draw_crossings(table_file, crossings)


def draw_crossings(table_file, crossings):
    drawing, axes = style.figure(style.PAGE, 2.7, ncols=2, sharey=True)
    discs = [
        row
        for row in crossings
        if row["body"] == "discs" and row["mu_disc"] == row["mu_wall"] and row["crosses"] == 1
    ]
    for k, mu in enumerate(FRICTIONS):
        here = [row for row in discs if row["mu_disc"] == mu]
        shares = sorted(
            (row for row in here if row["inertia"] == 10), key=lambda row: row["cannot_spin"]
        )
        heavy = sorted(
            (row for row in here if row["cannot_spin"] == 0), key=lambda row: row["inertia"]
        )
        look = style.look_of(k)
        if shares:
            style.curve(
                axes[0], shares, "cannot_spin", "crossing", label=rf"$\mu = {mu:g}$", **look
            )
        if heavy:
            style.curve(axes[1], heavy, "inertia", "crossing", label=rf"$\mu = {mu:g}$", **look)
        for row in here:
            if row["cannot_spin"] == 1:
                axes[1].axhline(row["crossing"], color=look["color"], linestyle="--", linewidth=0.7)
    axes[0].set(xlabel="share of discs that cannot spin", ylabel="$N_c$")
    axes[1].set(xlabel=r"moment of inertia $I/mr^2$", xscale="log")
    style.legend(axes[0], ncol=3)
    style.note(drawing, "dashed: discs that cannot spin")
    style.save(drawing, table_file.replace(".csv", "_crossings.csv"))


FIGURES = [
    Figure(
        "cause",
        "chapters",
        "chapter: what makes the cluster reverse? Spins that are stopped",
        points,
        table,
        draw,
        caption="Rotation and four quantities against the number of discs and of spheres "
        "(experiment's preset), for "
        "particles that can spin (open symbols, dotted) and that cannot (full). Colours: which "
        "contacts have "
        "friction. The load is the normal impulse that neighbours exchange, divided by that of the "
        "wall. Eight "
        "seeds; three to five where particles collide many times more often, in dishes of bearings "
        "and at smooth walls. The table has their number, and the verdict on each steady state.",
    )
]
