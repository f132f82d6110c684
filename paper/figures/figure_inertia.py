"""Beyond the paper: rotation against the number of discs for six moments of inertia. I = 1/2 is a solid disc, I = 1 a
ring, and I = 10 the paper's."""

import style
from figure import Figure
from runs import numbers_beyond, sparse_numbers
from varied import curve_points, curve_tables


def points(settings):
    # Discs with a physical inertia cross beyond the paper's last N, if at all.
    return curve_points(settings, "inertia", "inertia", (0.5, 1.0, 3.0, 10.0, 100.0, 1e4),
                        sparse_numbers(settings) + numbers_beyond(settings))


def draw(table):
    style.rotation_curves(table, "inertia", "I")


FIGURES = [Figure("inertia", "beyond", "beyond the paper: moment of inertia ½ to 10⁴", points, curve_tables, draw)]
