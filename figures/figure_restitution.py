"""Beyond the paper: rotation against the number of discs for three coefficients of restitution.

    /usr/bin/python3 figures/figure_restitution.py out/figure_restitution.csv
"""

import style

if __name__ == "__main__":
    style.rotation_curves("figure_restitution", "restitution", "e")
