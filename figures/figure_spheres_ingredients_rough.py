"""Spheres that roll: rotation without each ingredient of the model, for roughened spheres.

    /usr/bin/python3 figures/figure_spheres_ingredients_rough.py out/figure_spheres_ingredients_rough.csv
"""

import figure_spheres_ingredients


def main():
    figure_spheres_ingredients.main("figure_spheres_ingredients_rough", "-rough")


if __name__ == "__main__":
    main()
