"""Beyond the paper: the torques on the cluster against the number of discs."""

import numpy as np

import style

SUMS = (("wall_normal", "wall, normal"), ("wall_tangential", "wall, friction"), ("transfer", "between discs"))
ZONES = (("transfer_pinned", "two pinned"), ("transfer_mixed", "pinned and loose"),
         ("transfer_loose", "two loose"))


def zero_of_rotation(rows):
    """Where a straight line between two N has no rotation; None if the sign does not change."""
    n, rate = style.column(rows, "discs"), style.column(rows, "by_time")
    for k in reversed(range(len(n) - 1)):
        if rate[k] > 0 > rate[k + 1]:
            return n[k] + (n[k + 1] - n[k]) * rate[k] / (rate[k] - rate[k + 1])
    return None


def draw(table):
    rows = sorted(style.read(table), key=lambda row: row["discs"])
    drawing, both = style.figure(style.PAGE, 2.8, ncols=2)
    zero = zero_of_rotation(rows)
    for axes, terms, letter in zip(both, (SUMS, ZONES), "ab"):
        style.zero_line(axes)
        if zero is not None:
            axes.axvline(zero, color=style.GREY, linewidth=0.7, linestyle="--")
        for k, (name, words) in enumerate(terms):
            axes.errorbar(style.column(rows, "discs"), style.column(rows, name),
                          yerr=style.column(rows, name + "_error"), color=style.CYCLE[k],
                          marker=style.MARKERS[k], elinewidth=0.7, label=words)
        axes.set_xlabel("number of discs $N$")
        axes.set_ylabel(r"torque on the orbital motion, $m v^2$")
        axes.text(0.02, 0.95, f"({letter})", transform=axes.transAxes)
        style.legend(axes, ncol=3)
    both[1].set_ylim(np.array(both[1].get_ylim()) * 1.05)
    style.save(drawing, table)
