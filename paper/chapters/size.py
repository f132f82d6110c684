"""Size and amplitude: the rotation over the packing fraction φ = N r²/R² and the relative amplitude
A/R of the swirl, in dishes of different sizes R/r. The paper has one dish, R/r = 8.6 and A/R =
0.22. Where does the direction of rotation change, and in which state of the cluster?"""

from paper import chapter_drawings
from paper.standard_runs import Dish, dish_points, dish_tables
from paper.figure import Figure

RATIO_OF_THE_PAPER = 0.22  # SI: "A/R = 0.22"
NEAR_THE_CHANGES = (0.1, 0.2, 0.25, 0.28, 0.3, 0.36, 0.4)


def dishes_of_sizes(settings):
    """Dense clusters in large dishes take most of the time, and there the direction does not
    change."""
    if settings.quick:
        radii, fractions = (8.6, 17.2), (0.2, 0.3, 0.4, 0.49, 0.6)
    else:
        radii = (6.0, 8.6, 12.0, 17.2, 24.0, 34.4, 60.0)
        fractions = (
            0.05,
            0.1,
            0.15,
            0.2,
            0.25,
            0.28,
            0.3,
            0.32,
            0.34,
            0.36,
            0.38,
            0.4,
            0.43,
            0.46,
            0.49,
            0.52,
            0.56,
            0.6,
            0.65,
        )
    return [
        (Dish(radius, RATIO_OF_THE_PAPER), fraction)
        for radius in radii
        for fraction in fractions
        if (
            fraction in NEAR_THE_CHANGES
            if radius >= 40
            else fraction < (0.66 if radius < 20 else 0.47)
        )
    ]


def size_points(settings):
    return dish_points(settings, dishes_of_sizes(settings))


def amplitude_points(settings):
    if settings.quick:
        ratios, fractions = (0.1, 0.22, 0.4), (0.2, 0.4, 0.6)
    else:
        ratios = (0.05, 0.1, 0.15, 0.22, 0.3, 0.4, 1.0)
        fractions = (0.1, 0.2, 0.3, 0.4, 0.46, 0.49, 0.52, 0.6)
    dishes = [(Dish(8.6, ratio), fraction) for ratio in ratios for fraction in fractions]
    if not settings.quick:
        dishes += [
            (Dish(17.2, ratio), fraction)
            for ratio in (0.1, RATIO_OF_THE_PAPER, 0.4)
            for fraction in fractions[:-1]
        ]
    return dish_points(settings, dishes)


def draw_size(table):
    chapter_drawings.dishes(table, "container_radius", r"container radius $R/r$", "$R/r$")


FIGURES = [
    Figure(
        "size",
        "chapters",
        "chapter: the direction of rotation in containers of different sizes",
        size_points,
        dish_tables,
        draw_size,
    ),
    Figure(
        "amplitude",
        "chapters",
        "chapter: the direction of rotation for different amplitudes",
        amplitude_points,
        dish_tables,
        lambda table: chapter_drawings.dishes(
            table, "amplitude_ratio", r"amplitude $A/R$", "$A/R$"
        ),
    ),
]
