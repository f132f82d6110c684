"""Beyond the paper: rotation of spheres against the packing fraction in containers of different sizes."""

import chapter_drawings


def draw(table):
    chapter_drawings.dishes(table, "container_radius", r"container radius $R/r$", "$R/r$", logarithmic=True)
