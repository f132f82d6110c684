"""Spheres that roll: rotation with each ingredient of the model switched off alone."""

from paper import style
from paper.curves import curve_tables, curves_by, sign_change_rows, sign_changes_sentence
from paper.figure import Figure
from paper.runs import ROUGH, SMOOTH, length_of, paper_run
from paper.study import Point

CURVES = [
    ("all", "all ingredients", style.BLACK, "o"),
    ("no-damping", r"no damping ($e = 1$)", style.SKY, "D"),
    ("shell", r"hollow ($I = \frac{2}{3}$)", style.BLUE, "s"),
    ("no-floor", "no floor", style.GREEN, "X"),
    ("no-vertical", "no vertical friction", style.RED, "v"),
    ("no-vertical-wall", "… at the wall only", style.PINK, "P"),
    ("no-vertical-disc", "… between spheres only", style.ORANGE, "^"),
]
# All ingredients, and each one switched off alone: words, and the change of the parameters (None:
# without it).
VARIANTS = {
    "all": ("all ingredients", {}),
    "no-vertical": ("no vertical friction", {"vertical_disc": 0, "vertical_wall": 0}),
    "no-vertical-disc": ("no vertical friction between spheres", {"vertical_disc": 0}),
    "no-vertical-wall": ("no vertical friction at the wall", {"vertical_wall": 0}),
    "no-floor": ("no floor", {"floor": "none", "floor_friction": None, "gravity": None}),
    "no-damping": ("no damping (e = 1)", {"restitution": 1}),
    "shell": ("hollow spheres (I = 2/3)", {"inertia": 1 / 1.5}),
}


def points_of(mu, ending, numbers, quick_numbers):
    def points(settings):
        made = []
        for name, (_, change) in VARIANTS.items():
            for spheres in quick_numbers if settings.quick else numbers:
                run = {
                    **paper_run(settings, SMOOTH, spheres),
                    "mu": mu,
                    "floor_friction": mu,
                    **change,
                }
                run = {parameter: value for parameter, value in run.items() if value is not None}
                made.append(
                    Point(
                        settings,
                        f"spheres_{name}{ending}_N{spheres}_{length_of(run)}",
                        settings.seeds,
                        run,
                        cells={"curve": name + ending, "mu": mu, "discs": spheres},
                    )
                )
        return made

    return points


def table(points, settings):
    mu, curves = points[0].cells["mu"], curves_by(points, "curve")
    columns = "curve mu crossing crossing_error lower upper before after direction".split()
    changes = [
        row for curve in curves for row in sign_change_rows(curve, {"curve": curve.name, "mu": mu})
    ]
    return (
        curve_tables(points, curves) | {"_sign_changes": (changes, columns)},
        [
            f"{words}, μ = {mu}: {sign_changes_sentence(curve)}"
            for (words, _), curve in zip(VARIANTS.values(), curves)
        ],
    )


def draw(table, ending=""):
    """`ending` ends the names of the curves."""
    rows = style.read(table)
    curves = [
        (
            style.select(rows, curve=name + ending),
            {"label": label, "color": color, "marker": marker},
        )
        for name, label, color, marker in CURVES
    ]
    style.rotation_figure(table, curves, of="spheres", height=3.2)


def draw_rough(table):
    draw(table, "-rough")


# The roughened ones at the N where the direction is decided.
FIGURES = [
    Figure(
        "spheres_ingredients",
        "rolling",
        "spheres that roll: each ingredient switched off alone",
        points_of(SMOOTH.mu_disc, "", (24, 36, 44, 48, 52), (36, 44, 48)),
        table,
        draw,
    ),
    Figure(
        "spheres_ingredients_rough",
        "rolling",
        "spheres that roll: each ingredient switched off, roughened spheres",
        points_of(ROUGH.mu_disc, "-rough", (30, 36, 44, 48), (44, 48)),
        table,
        draw_rough,
    ),
]
