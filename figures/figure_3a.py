"""Figure 3a: angular velocity of the discs about the centre of mass against the angle.

    /usr/bin/python3 figures/figure_3a.py out/figure_3a.csv         slices of the table, 5° wide
    /usr/bin/python3 figures/figure_3a.py out/figure_3a.csv 20      sliding slices of 20°, in steps of 5°
"""

import style

if __name__ == "__main__":
    style.profiles("figure_3a", "varpi_m", -1, r"$\langle\varpi_{M,i}\rangle/\Omega$")
