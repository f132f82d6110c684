"""Figure 3b: angular velocity of the discs about the centre of mass, relative to that of the wall.

    /usr/bin/python3 figures/figure_3b.py out/figure_3b.csv         slices of the table, 5° wide
    /usr/bin/python3 figures/figure_3b.py out/figure_3b.csv 20      sliding slices of 20°, in steps of 5°
"""

import style

if __name__ == "__main__":
    style.profiles("figure_3b", "normalised", 1,
                   r"$\langle\varpi_{M,i}\rangle/\langle\varpi_{\rm wall}\rangle$")
