"""Beyond the paper: rotation against the number of discs if one kind of contact has no friction."""

import style

TICKS = (-0.1, -0.05, 0, 0.05, 0.1, 0.3, 1)
KINDS = (("none", "friction everywhere"), ("wall", "none with the wall"),
         ("boundary", "none between discs at the wall"), ("bulk", "none between other discs"))


def draw(table):
    rows = style.read(table)
    drawing, axes = style.figure(1.4 * style.COLUMN, 2.9)
    style.zero_line(axes)
    for k, (kind, words) in enumerate(KINDS):
        style.curve(axes, style.select(rows, frictionless=kind), "discs", "by_time", label=words,
                    color=style.CYCLE[k], marker=style.MARKERS[k])
    style.rotation_axes(axes)
    axes.set_yscale("symlog", linthresh=0.1, linscale=2)
    axes.set_yticks(TICKS, [f"{tick:g}".replace("-", "−") for tick in TICKS])
    axes.minorticks_off()
    style.legend(axes, ncol=2)
    style.save(drawing, table)
