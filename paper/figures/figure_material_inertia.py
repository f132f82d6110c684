"""Beyond the paper: the number of discs N_c at which the direction changes, against inertia and restitution."""

import chapter_drawings


def draw(table):
    chapter_drawings.crossing_map(table, "inertia", "restitution", r"moment of inertia $I/mr^2$", r"restitution $e$")
