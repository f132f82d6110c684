"""Beyond the paper: fluctuations of the rotation against the packing fraction in containers of different sizes, and how
slope, fluctuations and correlation time at a change of direction scale with the size."""

import os

import numpy as np

import chapter_drawings
import style
import tables

QUANTITIES = (("slope", r"slope $|d(\varpi/\Omega)/d\varphi|$"),
              ("susceptibility", r"$N\,\mathrm{var}(\varpi/\Omega)\,\tau$"),
              ("correlation", r"correlation time $\tau$ (periods)"))
KINDS = {"free": "free", "wall": "at the wall", "elongated": "elongated", "back": "back to rotation"}


def against_packing(axes, rows, quantity, label):
    chapter_drawings.curves(axes, rows, "container_radius", quantity, "$R/r$")
    axes.set_xlabel(chapter_drawings.PACKING)
    axes.set_ylabel(label)


def against_size(axes, changes, scaling, quantity, label):
    """One curve for each transition, with its power law."""
    groups = sorted({(row["amplitude_ratio"], row["kind"]) for row in changes})
    for k, (amplitude, kind) in enumerate(groups):
        here = tables.select(changes, amplitude_ratio=amplitude, kind=kind)
        x, y = (np.array(style.column(here, name)) for name in ("container_radius", quantity))
        axes.errorbar(x, abs(y), yerr=style.column(here, quantity + "_error"), color=style.CYCLE[k],
                      fmt=style.MARKERS[k], elinewidth=0.7, label=f"$A/R = {amplitude:g}$, {KINDS[kind]}")
        law = tables.select(scaling, amplitude_ratio=amplitude, kind=kind, quantity=quantity)
        if law and law[0]["exponent"] == law[0]["exponent"]:
            ends = np.array([min(x), max(x)])
            axes.plot(ends, law[0]["factor"] * ends ** law[0]["exponent"], color=style.CYCLE[k], linewidth=0.7,
                      linestyle="--")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xticks([6, 12, 24, 60], ["6", "12", "24", "60"])
    axes.xaxis.set_minor_locator(style.matplotlib.ticker.NullLocator())
    axes.set_xlabel(r"container radius $R/r$")
    axes.set_ylabel(label)


def draw(table):
    stem, ending = os.path.splitext(table)
    rows = tables.select(style.read(table), amplitude_ratio=0.22)
    changes, scaling = tables.read(f"{stem}_changes{ending}"), tables.read(f"{stem}_scaling{ending}")
    drawing, axes = style.figure(style.PAGE, 4.9, ncols=3, nrows=2)
    against_packing(axes[0][0], rows, "susceptibility", QUANTITIES[1][1])
    against_packing(axes[0][1], rows, "correlation", QUANTITIES[2][1])
    against_packing(axes[0][2], rows, "binder", "Binder cumulant")
    for upper in axes[0][:2]:
        upper.set_yscale("log")
    axes[0][2].axhline(2 / 3, color=style.GREY, linewidth=0.6, linestyle=":")
    axes[0][2].axhline(0, color=style.GREY, linewidth=0.6)
    for lower, (quantity, label) in zip(axes[1], QUANTITIES):
        against_size(lower, changes, scaling, quantity, label)
    for row, ncol in ((axes[0], 7), (axes[1], 3)):
        # The legend is wider than its axes, so the layout only knows its height: two lines of a title.
        row[1].set_title("\n")
        if changes or row is axes[0]:
            row[1].legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=ncol,
                          columnspacing=1.0).set_in_layout(False)
    style.save(drawing, table)
