"""Beyond the paper: rotation against the number of discs for three coefficients of tangential
restitution, solid discs.

    /usr/bin/python3 figures/figure_tangential.py out/figure_tangential.csv
"""

import style

if __name__ == "__main__":
    style.rotation_curves("figure_tangential", "tangential_restitution", r"\beta")
