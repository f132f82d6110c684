"""Beyond the paper: the number of discs N_c at which the direction changes, against both friction coefficients.

    /usr/bin/python3 figures/figure_material_friction.py out/figure_material_friction.csv
"""

import chapters


def main():
    chapters.crossing_map("material_friction", "mu_disc", "mu_wall", r"disc friction $\mu_d$", r"wall friction $\mu_w$")


if __name__ == "__main__":
    main()
