"""Beyond the paper: rotation against the number of solid discs for three coefficients of tangential restitution."""

import style
from figure import Figure
from runs import sparse_numbers
from varied import curve_points, curve_tables


def points(settings):
    return curve_points(settings, "tangential", "tangential_restitution", (0.0, 0.5, 1.0), sparse_numbers(settings),
                        inertia=0.5)


def draw(table):
    style.rotation_curves(table, "tangential_restitution", r"\beta")


FIGURES = [Figure("tangential", "beyond", "beyond the paper: tangential restitution, solid discs", points, curve_tables,
                  draw)]
