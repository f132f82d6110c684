"""Beyond the paper: rotation against the number of discs for six moments of inertia (a solid disc
has ½, a ring 1, the paper 10).

    /usr/bin/python3 figures/figure_inertia.py out/figure_inertia.csv
"""

import style

if __name__ == "__main__":
    style.rotation_curves("figure_inertia", "inertia", "I")
