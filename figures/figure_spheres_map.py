"""Spheres that roll: rotation of 36 of them against the friction coefficients of their contacts and of the floor.

    /usr/bin/python3 figures/figure_spheres_map.py out/figure_spheres_map.csv
"""

import style


def main():
    table = style.table_from_arguments("figure_spheres_map")
    rows = style.read(table)
    drawing, axes = style.figure(height=2.9)
    style.rotation_map(drawing, axes, rows, ("mu", "floor_friction"),
                       label=r"$\varpi/\Omega$ at $N = 36$")
    axes.set_xlabel(r"friction coefficient of spheres and wall $\mu$")
    axes.set_ylabel(r"friction coefficient of the floor $\mu_f$")
    style.save(drawing, table)


if __name__ == "__main__":
    main()
