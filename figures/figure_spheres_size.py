"""Beyond the paper: rotation of spheres against the packing fraction in containers of different sizes.

    /usr/bin/python3 figures/figure_spheres_size.py out/figure_spheres_size.csv
"""

import chapters


def main():
    chapters.dishes("spheres_size", "container_radius", r"container radius $R/r$", "$R/r$", logarithmic=True)


if __name__ == "__main__":
    main()
