"""Beyond the paper: the number of discs N_c at which the direction changes, against tangential restitution and inertia.

    /usr/bin/python3 figures/figure_material_tangential.py out/figure_material_tangential.csv
"""

import chapters


def main():
    chapters.crossing_map("material_tangential", "tangential_restitution", "inertia", r"tangential restitution $\beta$", r"moment of inertia $I/mr^2$")


if __name__ == "__main__":
    main()
