"""Figure 4c: rotation of the cluster against the number of particles, smooth and rough.

    /usr/bin/python3 figures/figure_4c.py out/figure_4c.csv
"""

import style


def main():
    table = style.table_from_arguments("figure_4c")
    rows = style.read(table)
    drawing, axes = style.figure(height=2.9)
    style.zero_line(axes)
    style.curves_by_setting(axes, rows, "by_time", ("smooth", "rough", "low", "high"))
    style.rotation_axes(axes, of="particles")
    style.legend(axes)
    style.save(drawing, table)


if __name__ == "__main__":
    main()
