"""Figure 4c: rotation of the cluster against the number of particles, smooth and rough."""

import style


def draw(table):
    rows = style.read(table)
    drawing, axes = style.figure(height=2.9)
    style.zero_line(axes)
    style.curves_by_setting(axes, rows, "by_time", ("smooth", "rough", "low", "high"))
    style.rotation_axes(axes, of="particles")
    style.legend(axes)
    style.save(drawing, table)
