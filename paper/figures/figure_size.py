"""Beyond the paper: rotation against the packing fraction in containers of different sizes, and where the direction of
rotation changes."""

import chapter_drawings


def draw(table):
    chapter_drawings.dishes(table, "container_radius", r"container radius $R/r$", "$R/r$", logarithmic=True)
