"""Against published experiments with spheres in a swirled dish.

Scherer, Kötter, Markus, Goles and Rehberg (Phys. Rev. E 61, 4069, 2000) report that the sign of
dE/dN, with E the mean kinetic energy of a particle, distinguishes rotation (zero), reptation, which
is counterrotation (positive), and the appearance of concentric rings (negative), and that particles
of a large cluster follow hypocycloids."""

import math

import numpy as np

from paper import style, tables
from paper.combine import means
from paper.curves import CERTAIN, listed
from paper.standard_runs import resolved
from paper.figure import Figure
from paper.runs import length_of, lengths
from paper.study import Point
from paper.swirled_state import RINGS_PER_RADIUS, swirled_run

# Name, words, parameters.
SETTINGS = (
    ("experiment", "spheres, A/R = 0.451, μ = 0.33", {"preset": "experiment"}),
    ("discs", "discs, A/R = 0.22, μ = 1", {}),
)
QUANTITIES = ("energy", "spin_energy", "rotation", "path_rotation", "path_distance")


def points(settings):
    made = []
    for name, words, parameters in SETTINGS:
        for n in (
            (8, 20, 32, 44, 52)
            if settings.quick
            else (5, 8, 11, 14, 20, 26, 32, 38, 44, 48, 52, 54)
        ):
            run = {**parameters, "discs": n, **lengths(settings, (20, 2), (60, 8))}
            known = resolved(run)
            made.append(
                Point(
                    settings,
                    f"scherer_{name}_N{n}_{length_of(run)}",
                    settings.chapter_seeds,
                    run,
                    work=swirled_run,
                    cells={
                        "setting": name,
                        "words": words,
                        "amplitude": known["amplitude"],
                        "period": known["period"],
                        "discs": n,
                    },
                )
            )
    return made


def row_of(point):
    """The means over the seeds; E = ⟨v²⟩/v_C², with the speed v_C of the container."""
    runs = [
        run
        | {
            name: run[name.replace("energy", "square")] / run["speed_square"]
            for name in ("energy", "spin_energy")
        }
        for run in point.runs
    ]
    return {**point.cells, **means(runs, QUANTITIES)}


def add_slopes(rows):
    """dE/dN from the two neighbours of a point; unknown at the ends."""
    for k, row in enumerate(rows):
        row["slope"] = row["slope_error"] = math.nan
        if 0 < k < len(rows) - 1:
            a, b = rows[k - 1], rows[k + 1]
            row["slope"] = (b["energy"] - a["energy"]) / (b["discs"] - a["discs"])
            row["slope_error"] = math.hypot(a["energy_error"], b["energy_error"]) / (
                b["discs"] - a["discs"]
            )


def sign(row, name):
    return int(np.sign(row[name])) if abs(row[name]) > CERTAIN * row[f"{name}_error"] else 0


def sentence(words, rows):
    def count(rotation):
        slopes = [sign(row, "slope") for row in rows[1:-1] if sign(row, "rotation") == rotation]
        return f"{slopes.count(1)} of {len(slopes)}"

    falls = [row["discs"] for row in rows[1:-1] if sign(row, "slope") < 0]
    return (
        f"{words}: dE/dN is certainly positive at {count(1)} N with rotation and at {count(-1)} "
        f"with counterrotation; it is certainly negative at N = {listed(falls) or 'none'}."
    )


def rings_of(point):
    """The radial densities."""
    if not point.runs:
        return []
    names = ("about_centre_of_mass", "about_container")
    return [
        {
            "setting": point.cells["setting"],
            "discs": point.cells["discs"],
            "distance": (b + 0.5) / RINGS_PER_RADIUS,
            **means([{name: run[name][b] for name in names} for run in point.runs], names),
        }
        for b in range(len(point.runs[0][names[0]]))
    ]


def table(points, settings):
    rows, findings = [], []
    for name, words, *_ in SETTINGS:
        here = [point for point in points if point.cells["setting"] == name]
        curve = [row_of(point) for point in here]
        add_slopes(curve)
        rows += [{**row, "seeds": len(point.runs)} for row, point in zip(curve, here)]
        findings.append(sentence(words, curve))
    return {"": rows, "_rings": [row for point in points for row in rings_of(point)]}, findings


SHIFT = 15  # of the curves of rings


def against_number(axes, rows, quantity, settings):
    """A curve for each setting; open symbols where the cluster certainly counterrotates."""
    for k, setting in enumerate(settings):
        here = sorted(tables.select(rows, setting=setting), key=lambda row: row["discs"])
        style.curve(axes, here, "discs", quantity, linewidth=0.8, **style.look_of(k))
        against = [row for row in here if sign(row, "rotation") < 0]
        axes.plot(
            style.column(against, "discs"),
            style.column(against, quantity),
            linestyle="none",
            markerfacecolor="white",
            zorder=3,
            **style.look_of(k),
        )


def draw_rings(axes, rows, numbers):
    for k, number in enumerate(numbers):
        here = [
            row
            for row in tables.select(rows, setting="experiment", discs=number)
            if row["distance"] < 9
        ]
        distance = np.array(style.column(here, "distance"))
        number_at = 2 * np.pi * distance * np.array(style.column(here, "about_centre_of_mass"))
        axes.plot(distance, number_at + SHIFT * k, color=style.CYCLE[k])
        axes.text(8.95, SHIFT * (k + 0.1), f"$N = {number:g}$", color=style.CYCLE[k], ha="right")
        axes.axhline(SHIFT * k, color=style.GREY, linewidth=0.4)
    axes.set_xlabel("distance from the centre of mass $d/r$")
    axes.set(ylabel=f"particles per distance (1/$r$), shifted by {SHIFT}", xlim=(0, 9))


def draw_scherer(table):
    rows = style.read(table)
    settings = list(dict.fromkeys(row["setting"] for row in rows))
    drawing, panels = style.figure(style.PAGE, 5.6, ncols=2, nrows=2)
    against_number(panels[0, 0], rows, "energy", settings)
    panels[0, 0].set(ylabel=r"mean kinetic energy $\langle v^2\rangle/v_C^2$", yscale="log")
    against_number(panels[0, 1], rows, "rotation", settings)
    style.zero_line(panels[0, 1])
    panels[0, 1].set_ylabel(r"rotation $\varpi/\Omega$")
    numbers = style.distinct(rows, "discs")
    chosen = [numbers[round(share * (len(numbers) - 1))] for share in (0.2, 0.5, 0.75, 1.0)]
    draw_rings(panels[1, 0], tables.companion(table, "_rings"), chosen)
    against_number(panels[1, 1], rows, "path_distance", settings)
    panels[1, 1].set_ylabel("rms distance from hypotrochoids ($r$)")
    panels[1, 1].set_ylim(bottom=0)
    for axes in (panels[0, 0], panels[0, 1], panels[1, 1]):
        axes.set_xlabel("number of particles $N$")
    handles = [
        panels[0, 0].plot(
            [], [], label=tables.select(rows, setting=setting)[0]["words"], **style.look_of(k)
        )[0]
        for k, setting in enumerate(settings)
    ]
    handles.append(
        panels[0, 0].plot(
            [], [], "o", color=style.GREY, markerfacecolor="white", label="open: counterrotates"
        )[0]
    )
    style.legend_of_all(drawing, handles, ncol=4)
    style.save(drawing, table)


FIGURES = [
    Figure(
        "scherer",
        "chapters",
        "chapter: energy, rings and paths of swirled spheres",
        points,
        table,
        draw_scherer,
    )
]
