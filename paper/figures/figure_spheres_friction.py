"""Spheres that roll: N_c against the friction coefficient of all contacts, for the experiment's
values and with one assumption changed at a time. Dashed: N_c of the experiment's smooth and
roughened spheres."""

import math

from paper import style
from paper.curves import with_error
from paper.figure import Figure
from paper.paper_parameters import ROUGH_CHANGE_N, SMOOTH_CHANGE_N
from paper.runs import text
from paper.searches import SEARCH_COLUMNS, search_cells, search_point

PANELS = (
    ("amplitude $A$", "A", "{amplitude_mm:g} mm"),
    ("restitution $e$", "e", "{restitution:g}"),
    ("floor, rolling", "fr", None),
)
# One assumption that the paper does not settle, and its value: name, words, changes. The friction
# coefficient is that of all contacts, unless the floor has its own.
EXPERIMENT = {
    "amplitude_mm": 11.5,
    "restitution": 0.9,
    "floor_friction": 0.0,
    "rolling_resistance": 0.0,
}
ASSUMPTIONS = (
    ("experiment", "A = 11.5 mm, e = 0.9", {}),
    ("A5.75", "A = 5.75 mm", {"amplitude_mm": 5.75}),
    ("A7.5", "A = 7.5 mm", {"amplitude_mm": 7.5}),
    ("A9.5", "A = 9.5 mm", {"amplitude_mm": 9.5}),
    ("e0.8", "e = 0.8", {"restitution": 0.8}),
    ("e1", "e = 1", {"restitution": 1.0}),
    ("f0.15", "floor 0.15", {"floor_friction": 0.15}),
    ("f0.6", "floor 0.6", {"floor_friction": 0.6}),
    ("r0.01", "rolling resistance 0.01", {"rolling_resistance": 0.01}),
)


def points(settings):
    made = []
    for name, _, changes in ASSUMPTIONS[:2] if settings.quick else ASSUMPTIONS:
        for mu in [0.3, 0.4, 0.6, 0.7] if settings.quick else [0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8]:
            assumed = EXPERIMENT | changes
            assumed["floor_friction"] = assumed["floor_friction"] or mu
            run = {
                "preset": "experiment",
                "mu": mu,
                "events": int(settings.events or 50_000),
                **assumed,
            }
            mm = run.pop("amplitude_mm")
            amplitude = mm / 3  # in radii of 3 mm
            run |= {
                "amplitude": amplitude,
                "period": 2 * math.pi * amplitude,
                "gravity": 6.382 * (5.75 / mm) * (5.75 / mm),
            }
            made.append(
                search_point(
                    settings,
                    f"N_c_spheres_{name}_mu{text(mu)}",
                    run,
                    24,
                    48,
                    {"curve": name, **assumed, "mu": mu},
                    tolerance=0.3,
                    min_periods=60,
                )
            )
    return made


def friction_with(discs, found):
    """The friction coefficient with this N_c, between two neighbouring ones (μ, N_c, error): on the
    straight line through both, as N_c falls smoothly. Its error follows from those of both N_c."""
    for (mu, crossing, error), (mu_b, crossing_b, error_b) in zip(found, found[1:]):
        f = (crossing - discs) / (crossing - crossing_b)
        if 0 <= f <= 1:
            return mu + f * (mu_b - mu), (
                math.hypot((1 - f) * error, f * error_b) * (mu_b - mu) / abs(crossing - crossing_b)
            )
    return None


def table(points, settings):
    rows, calibration, findings = [], [], []
    for name, words, _ in ASSUMPTIONS:
        here = [point for point in points if point.cells["curve"] == name]
        rows_here = [{**point.cells, **search_cells(point.runs[0])} for point in here if point.runs]
        found = [
            (row["mu"], row["crossing"], row["crossing_error"])
            for row in rows_here
            if row["crosses"]
        ]
        reached = [(n, friction_with(n, found)) for n in (SMOOTH_CHANGE_N, ROUGH_CHANGE_N)]
        reached = [(n, *mu) for n, mu in reached if mu]
        rows += rows_here
        calibration += [
            dict(zip(("curve", "discs", "mu", "mu_error"), (name, *mu))) for mu in reached
        ]
        if here:
            found = ", ".join(f"N_c = {n} for μ = {with_error(*mu)}" for n, *mu in reached)
            findings.append(f"{words}: {found or 'neither 36 nor 28 is reached'}.")
    return {
        "": (rows, ["curve", *EXPERIMENT, "mu", *SEARCH_COLUMNS]),
        "_calibration": (calibration, ["curve", "discs", "mu", "mu_error"]),
    }, findings


def label_of(row, words):
    if row["curve"] == "experiment":
        return "as the contacts" if words is None else words.format(**row)
    if words is None:
        return (
            f"floor {row['floor_friction']:g}"
            if row["curve"][0] == "f"
            else f"resistance {row['rolling_resistance']:g}"
        )
    return words.format(**row)


def draw(table):
    rows = style.read(table)
    drawing, panels = style.figure(width=style.PAGE, height=3.0, ncols=3, sharex=True, sharey=True)
    for axes, (title, letters, words) in zip(panels, PANELS):
        names = ["experiment"] + [
            name
            for name in dict.fromkeys(row["curve"] for row in rows)
            if name[0] in letters and name != "experiment"
        ]
        for k, name in enumerate(names):
            here, color = (
                style.select(rows, curve=name),
                style.BLACK if k == 0 else style.CYCLE[k - 1],
            )
            style.curve(
                axes,
                style.select(here, crosses=1.0) or here,
                "mu",
                "crossing",
                color=color,
                marker=style.MARKERS[k],
                label=label_of(here[0], words),
            )
            style.without_crossing(axes, here, "mu", color)
        for n in (SMOOTH_CHANGE_N, ROUGH_CHANGE_N):
            axes.axhline(n, color=style.GREY, linewidth=0.6, linestyle="--", zorder=0)
        axes.set_xlabel(r"friction coefficient $\mu$")
        style.legend(axes, ncol=2)
        axes.set_title(title, pad=44)
    panels[0].set_ylabel("$N_c$")
    panels[0].margins(y=0.15)  # the arrows are below every crossing
    style.save(drawing, table)


FIGURES = [
    Figure(
        "spheres_friction",
        "rolling",
        "spheres that roll: N_c against the friction coefficient",
        points,
        table,
        draw,
    )
]
