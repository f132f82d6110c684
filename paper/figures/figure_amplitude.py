"""Beyond the paper: rotation against the packing fraction for different amplitudes of the swirl, and where the
direction of rotation changes."""

import chapter_drawings


def draw(table):
    chapter_drawings.dishes(table, "amplitude_ratio", r"amplitude $A/R$", "$A/R$", logarithmic=True)
