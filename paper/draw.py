"""Draws a table of `swirl paper` again, to PNG and PDF next to it.

    /usr/bin/python3 paper draw out/figure_5b.csv
    /usr/bin/python3 paper draw out/figure_3a.csv 20      sliding slices of 20°, in steps of 5°
"""

import os
import sys

from paper import catalogue, optional_file


def main():
    if len(sys.argv) not in (2, 3) or sys.argv[1] in ("-h", "--help"):
        print(f"usage: {__doc__[__doc__.index('/usr'):]}", end="", file=sys.stderr)
        sys.exit(0 if sys.argv[1:] in (["-h"], ["--help"]) else 2)
    table = sys.argv[1]
    if not optional_file.exists(table):
        sys.exit(f"error: the table '{table}' does not exist.\nhint: `swirl paper` writes it.")
    name = os.path.splitext(os.path.basename(table))[0].removeprefix("figure_")
    draw = catalogue.drawing(name)
    if not draw:
        sys.exit(
            f"error: '{table}' is not the table of a figure.\n"
            "hint: name it as `swirl paper` does, such as "
            "figure_5b.csv."
        )
    draw(table, *map(float, sys.argv[2:]))
