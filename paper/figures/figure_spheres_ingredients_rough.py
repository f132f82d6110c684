"""Spheres that roll: rotation without each ingredient of the model, for roughened spheres."""

from figures import figure_spheres_ingredients


def draw(table):
    figure_spheres_ingredients.draw(table, "-rough")
