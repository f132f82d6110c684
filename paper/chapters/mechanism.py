"""Which contacts turn the cluster? The torque budget against N; whether opposite spins of touching
discs ("gears") or the slip at the wall predict the rotation; and whether the direction still
changes if one kind of contact has no friction."""

import numpy as np
import scipy.stats

from paper import style, tables
from paper.coarse_zero import last_zero, measured_curve, rise_through
from paper.combine import at, number
from paper.curves import curves_by, lowest_of, rows_of, with_error
from paper.figure import Figure
from paper.jackknife import jackknife
from paper.runs import Friction, length_of, lengths, paper_run, text, with_periods
from paper.study import Point


def mechanism_run(settings, discs, mu):
    """Discs with the paper's parameters except for μ."""
    return with_periods(
        paper_run(settings, Friction("", "", mu, mu), discs), lengths(settings, (20, 2), (80, 4))
    )


def mechanism_point(settings, name, run, cells, measure=()):
    return Point(
        settings, f"{name}_{length_of(run)}", settings.chapter_seeds, run, measure, cells=cells
    )


# --- Torques --------------------------------------------------------------------------------------

TORQUES = (
    "wall_normal",
    "wall_tangential",
    "transfer",
    "wall_on_spins",
    "discs_on_spins",
    "wall_about_centre",
    "container_torque",
    "wall_sticking",
    "wall_sliding",
    "transfer_sticking",
    "transfer_sliding",
    "wall_normal_pinned",
    "wall_normal_loose",
    "wall_tangential_pinned",
    "wall_tangential_loose",
    "transfer_pinned",
    "transfer_mixed",
    "transfer_loose",
)
SUMS = (
    ("wall_normal", "wall, normal"),
    ("wall_tangential", "wall, friction"),
    ("transfer", "between discs"),
)
ZONES = (
    ("transfer_pinned", "two pinned"),
    ("transfer_mixed", "pinned and loose"),
    ("transfer_loose", "two loose"),
)


def torque_points(settings):
    numbers = (
        (20, 32, 40, 48)
        if settings.quick
        else (8, 12, 16, 20, 24, 28, 32, 34, 36, 38, 40, 42, 45, 48, 52)
    )
    return [
        mechanism_point(
            settings,
            f"torque_N{n}",
            mechanism_run(settings, n, 1),
            {"curve": "", "mu": 1, "discs": n},
            ["torque"],
        )
        for n in numbers
    ]


def torque_table(points, settings):
    measured = [f"torque.{name}" for name in (*TORQUES, "orbital", "spins", "unaccounted_share")]
    words = []
    for name in TORQUES:
        zero, falls = last_zero(measured_curve(points, f"torque.{name}"))
        if zero:
            words.append(f"{name} at {zero} ({'to negative' if falls else 'to positive'})")
    zero, _ = last_zero(curves_by(points, "curve")[0].points)
    return {"": rows_without_curve(points, measured)}, [
        f"The rotation changes sign at {zero or 'no certain N'}. {len(words)} of {len(TORQUES)} "
        f"torques change sign with N: {'; '.join(words) or 'none'}."
    ]


def rows_without_curve(points, measured=()):
    return [
        {name: value for name, value in row.items() if name != "curve"}
        for row in rows_of(points, measured)
    ]


def draw_torque(table):
    rows = sorted(style.read(table), key=lambda row: row["discs"])
    drawing, both = style.figure(style.PAGE, 2.8, ncols=2)
    # The last change to counterrotation.
    zero = rise_through(*(style.column(rows, name)[::-1] for name in ("discs", "mean_by_time")), 0)
    for axes, terms, letter in zip(both, (SUMS, ZONES), "ab"):
        style.zero_line(axes)
        if zero == zero:
            axes.axvline(zero, color=style.GREY, linewidth=0.7, linestyle="--")
        for k, (name, words) in enumerate(terms):
            style.curve(axes, rows, "discs", name, label=words, **style.look_of(k))
        axes.set(xlabel="number of discs $N$", ylabel=r"torque on the orbital motion, $m v^2$")
        axes.text(0.02, 0.95, f"({letter})", transform=axes.transAxes)
        style.legend(axes, ncol=3)
    both[1].set_ylim(np.array(both[1].get_ylim()) * 1.05)
    style.save(drawing, table)


# --- Gears or slip --------------------------------------------------------------------------------

PREDICTORS = {
    "frustration.correlation_by_impulse": "spins of strong contacts",
    "frustration.spin_correlation": "spins of touching discs",
    "slip.resident": "slip parameter of the resident discs",
    "frustration.wall_sticking": "share of sticking contacts at the wall",
    "frustration.resident_spin": "spin of the resident discs",
}
PANELS = (
    ("correlation_by_impulse", "spin correlation, weighted with impulse"),
    ("spin_correlation", "spin correlation of touching discs"),
    ("resident", "slip parameter, resident discs"),
    ("wall_sticking", "share of sticking wall contacts"),
)


def gears_points(settings):
    return [
        mechanism_point(
            settings,
            f"gears_mu{text(mu)}_N{n}",
            mechanism_run(settings, n, mu),
            {"curve": f"μ = {text(mu)}", "mu": mu, "discs": n},
            ["slip", "frustration"],
        )
        for mu in ((0.1, 1) if settings.quick else (0.05, 0.1, 0.3, 1, 3))
        for n in ((22, 34, 46) if settings.quick else (16, 22, 28, 34, 40, 46))
    ]


def gears_table(points, settings):
    rows = np.array(
        [
            [number(at(p.result, "rotation", "mean_by_time", "mean"))]
            + [number(at(p.result, "measured", *name.split("."), "mean")) for name in PREDICTORS]
            for p in points
        ]
    )
    rows = rows[np.isfinite(rows).all(axis=1)]
    rotation, predictors = rows[:, 0], rows[:, 1:].T

    def rank(p):
        return lambda k: scipy.stats.spearmanr(predictors[p][k], rotation[k]).statistic

    table, words = [], []
    for p, (name, meaning) in enumerate(PREDICTORS.items()):
        rho, rho_error = jackknife(len(rows), rank(p))
        square, square_error = jackknife(
            len(rows), lambda k: scipy.stats.pearsonr(predictors[p][k], rotation[k])[0] ** 2
        )
        table.append(
            {
                "predictor": name,
                "points": len(rows),
                "rank_correlation": rho,
                "rank_correlation_error": rho_error,
                "r_squared": square,
                "r_squared_error": square_error,
            }
        )
        words.append(f"{meaning} {with_error(rho, rho_error)}")
    better, error = jackknife(len(rows), lambda k: abs(rank(0)(k)) - abs(rank(2)(k)))
    how = (
        "better than"
        if better > 2 * error
        else "worse than"
        if better < -2 * error
        else "about as well as"
    )
    return {"": rows_without_curve(points, PREDICTORS), "_ranks": table}, [
        f"Rank correlation with ϖ over {len(rows)} points (N, μ): {'; '.join(words)}.",
        f"Spins of strong contacts predict ϖ {how} the slip parameter: |ρ| differs by "
        f"{with_error(better, error)}.",
    ]


def draw_gears(table):
    rows = style.read(table)
    ranks = {row["predictor"].split(".")[1]: row for row in tables.companion(table, "_ranks")}
    drawing, panels = style.figure(style.PAGE, 4.6, ncols=2, nrows=2)
    for axes, (name, words) in zip(panels.flat, PANELS):
        style.zero_line(axes)
        for mu, here, look in style.groups(rows, "mu"):
            style.curve(
                axes, here, name, "mean_by_time", linestyle="none", label=rf"$\mu = {mu:g}$", **look
            )
        rank = ranks[name]
        axes.text(
            0.98,
            0.55,
            rf"$\rho$ = {rank['rank_correlation']:.2f} ± {rank['rank_correlation_error']:.2f}".replace(
                "-", "−"
            ),
            transform=axes.transAxes,
            ha="right",
        )
        axes.set(xlabel=words, ylabel=r"rotation $\varpi/\Omega$")
    style.legend(panels[0, 0], ncol=5)
    style.save(drawing, table)


# --- One kind of contact without friction ---------------------------------------------------------

SMOOTH_CONTACTS = {
    "none": ("friction everywhere", "friction everywhere"),
    "wall": ("no friction with the wall", "none with the wall"),
    "boundary": ("no friction between discs at the wall", "none between discs at the wall"),
    "bulk": ("no friction between other discs", "none between other discs"),
}


def contacts_points(settings):
    numbers = (20, 36, 48) if settings.quick else (12, 20, 28, 32, 36, 40, 44, 48, 52)
    points = []
    for kind in SMOOTH_CONTACTS:
        for n in numbers:
            run = mechanism_run(settings, n, 1) | ({} if kind == "none" else {"frictionless": kind})
            if kind == "wall":
                run["mu_wall"] = 0
            points.append(
                mechanism_point(
                    settings, f"contacts_{kind}_N{n}", run, {"frictionless": kind, "discs": n}
                )
            )
    return points


def contacts_table(points, settings):
    findings = []
    for curve in curves_by(points, "frictionless"):
        zero, _ = last_zero(curve.points)
        lowest = lowest_of(curve.points)
        findings.append(
            f"{SMOOTH_CONTACTS[curve.name][0]}: "
            f"{f'the direction changes at {zero}' if zero else 'no certain change of direction'}; "
            "lowest ϖ/Ω = "
            f"{f'{with_error(*lowest[1:])} at N = {lowest[0]}' if lowest else 'n/a at N = n/a'}."
        )
    return {"": rows_of(points)}, findings


def draw_contacts(table):
    rows = style.read(table)
    drawing, axes = style.figure(1.4 * style.COLUMN, 2.9)
    style.zero_line(axes)
    for k, (kind, (_, words)) in enumerate(SMOOTH_CONTACTS.items()):
        style.curve(
            axes,
            style.select(rows, frictionless=kind),
            "discs",
            "mean_by_time",
            label=words,
            color=style.CYCLE[k],
            marker=style.MARKERS[k],
        )
    style.rotation_axes(axes)
    style.fine_near_zero(axes, style.column(rows, "mean_by_time"))
    style.legend(axes, ncol=2)
    style.save(drawing, table)


FIGURES = [
    Figure(
        "torque",
        "chapters",
        "chapter: the torques on the cluster against N",
        torque_points,
        torque_table,
        draw_torque,
    ),
    Figure(
        "gears",
        "chapters",
        "chapter: do gears or slip predict the rotation?",
        gears_points,
        gears_table,
        draw_gears,
    ),
    Figure(
        "contacts",
        "chapters",
        "chapter: one kind of contact without friction",
        contacts_points,
        contacts_table,
        draw_contacts,
    ),
]
