"""Spheres that roll: rotation against their number in the experiment's container, smooth and
roughened, and for both readings of the amplitude."""

from paper import style
from paper.combine import at
from paper.curves import curve_tables, curves_by, rows_of, sign_changes_sentence, with_error
from paper.figure import Figure
from paper.runs import (
    HALF,
    ROUGH,
    SMOOTH,
    length_of,
    lengths,
    numbers_of_spheres,
    paper_run,
    point,
    with_periods,
)
from paper.study import Point

WORDS = {friction.name: friction.words for friction in (SMOOTH, ROUGH, HALF)}


def points(settings):
    """From N = 24 on the runs are those of Figures 1 to 4."""
    numbers = ([8, 16] if settings.quick else [8, 12, 16, 20, 22]) + numbers_of_spheres(settings)
    return [
        point(settings, friction, discs) for friction in (SMOOTH, ROUGH, HALF) for discs in numbers
    ]


def table(points, settings):
    curves = curves_by(points, "setting")
    return curve_tables(points, curves), [
        f"{WORDS[curve.name]}: {sign_changes_sentence(curve)}" for curve in curves
    ]


# --- A few spheres --------------------------------------------------------------------------------


def few_points(settings):
    """ "When there are only a few marbles in the container, they form a line that rolls along the
    container wall at the frequency of the circular translations" (main text). More than five need
    hundreds of periods to form it (docs/explanation/spheres.md), and such a line collides with the
    wall tens of thousands of times in a period."""
    made = []
    for spheres in (3, 5) if settings.quick else (3, 4, 5):
        run = with_periods(
            paper_run(settings, SMOOTH, spheres), lengths(settings, (100, 2), (50, 3))
        )
        made.append(
            Point(
                settings,
                f"spheres_few_N{spheres}_{length_of(run)}",
                settings.seeds,
                run,
                ("residence",),
                cells={"discs": spheres},
            )
        )
    return made


def few_table(points, settings):
    def words(point, *path):
        return with_error(at(point.result, *path))

    return {"": rows_of(points, ["residence.share=residence_share"])}, [
        f"{point.cells['discs']} spheres: ϖ/Ω = {words(point, 'rotation', 'mean_by_time')}, share "
        f"resident at the wall {words(point, 'measured', 'residence', 'share')}."
        for point in points
    ]


def draw(table):
    rows = style.read(table)
    curves = [
        (style.select(rows, setting=name), {"label": label} | look)
        for name, (label, look) in style.LOOKS.items()
        if style.select(rows, setting=name)
    ]
    style.rotation_figure(
        table, curves, of="spheres", width=style.PAGE, height=3.4, fine=True, ncol=3
    )


FIGURES = [
    Figure(
        "spheres",
        "rolling",
        "spheres that roll: rotation against N, smooth, rough and half the amplitude",
        points,
        table,
        draw,
    ),
    Figure(
        "spheres_few",
        "rolling",
        "spheres that roll: a few of them, after a long warm-up (a table)",
        few_points,
        few_table,
    ),
]
