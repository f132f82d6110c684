"""Beyond the paper: the number of discs N_c at which the direction changes, against both friction coefficients."""

import chapter_drawings


def draw(table):
    chapter_drawings.crossing_map(table, "mu_disc", "mu_wall", r"disc friction $\mu_d$", r"wall friction $\mu_w$")
