"""Beyond the paper: the number of discs N_c at which the direction changes, against tangential restitution and inertia."""

import chapter_drawings


def draw(table):
    chapter_drawings.crossing_map(table, "tangential_restitution", "inertia", r"tangential restitution $\beta$", r"moment of inertia $I/mr^2$")
