"""Beyond the paper: rotation against the packing fraction for different amplitudes of the swirl, and where the
direction of rotation changes.

    /usr/bin/python3 figures/figure_amplitude.py out/figure_amplitude.csv
"""

import chapters


def main():
    chapters.dishes("amplitude", "amplitude_ratio", r"amplitude $A/R$", "$A/R$", logarithmic=True)


if __name__ == "__main__":
    main()
