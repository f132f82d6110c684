"""Beyond the paper: rotation against the packing fraction in containers of different sizes, and where the direction of
rotation changes.

    /usr/bin/python3 figures/figure_size.py out/figure_size.csv
"""

import chapters


def main():
    chapters.dishes("size", "container_radius", r"container radius $R/r$", "$R/r$", logarithmic=True)


if __name__ == "__main__":
    main()
