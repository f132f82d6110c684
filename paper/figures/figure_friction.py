"""Beyond the paper: the number of discs at which rotation turns into counterrotation, against the
friction coefficient."""

import style

TOP = 0.96  # height in the axes of the markers for friction coefficients without a crossing


def draw(table):
    rows = style.read(table)
    drawing, axes = style.figure()
    style.curve(axes, style.select(rows, crosses=1.0), "mu", "crossing", color=style.BLUE,
                marker="o", label="crossing")
    none = style.select(rows, crosses=0.0)
    if none:
        low, high = axes.get_ylim()
        axes.set_ylim(low, high + 0.15 * (high - low))  # these markers stay above every crossing
        axes.plot(style.column(none, "mu"), [TOP] * len(none), "^", color=style.GREY,
                  transform=axes.get_xaxis_transform(), label="no crossing found")
        style.legend(axes)
    axes.set_xscale("log")
    axes.set_xticks([0.05, 0.1, 0.2, 0.5, 1, 2])
    axes.set_xticklabels(["0.05", "0.1", "0.2", "0.5", "1", "2"])
    axes.minorticks_off()
    axes.set_xlabel(r"friction coefficient $\mu_d = \mu_w$")
    axes.set_ylabel(r"crossing $N_c$")
    style.save(drawing, table)
