"""Beyond the paper: rotation against the number of discs for three coefficients of restitution."""

import style
from figure import Figure
from runs import sparse_numbers
from varied import curve_points, curve_tables


def points(settings):
    return curve_points(settings, "restitution", "restitution", (1.0, 0.99, 0.9), sparse_numbers(settings))


def draw(table):
    style.rotation_curves(table, "restitution", "e")


FIGURES = [Figure("restitution", "beyond", "beyond the paper: restitution e = 1, 0.99, 0.9", points, curve_tables, draw)]
