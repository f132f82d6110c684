"""Beyond the paper: the number of discs N_c at which the direction changes, against inertia and restitution.

    /usr/bin/python3 figures/figure_material_inertia.py out/figure_material_inertia.csv
"""

import chapters


def main():
    chapters.crossing_map("material_inertia", "inertia", "restitution", r"moment of inertia $I/mr^2$", r"restitution $e$")


if __name__ == "__main__":
    main()
