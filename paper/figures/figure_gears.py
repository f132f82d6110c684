"""Beyond the paper: rotation against the spins of touching discs and the slip at the wall."""

import os

import style
import tables

PANELS = (("correlation_by_impulse", "spin correlation, weighted with impulse"),
          ("spin_correlation", "spin correlation of touching discs"),
          ("resident", "slip parameter, resident discs"),
          ("wall_sticking", "share of sticking wall contacts"))


def draw(table):
    rows = style.read(table)
    stem, ending = os.path.splitext(table)
    ranks = {row["predictor"].split(".")[1]: row for row in tables.read(f"{stem}_ranks{ending}")}
    drawing, panels = style.figure(style.PAGE, 4.6, ncols=2, nrows=2)
    values = sorted({row["mu"] for row in rows})
    for axes, (name, words) in zip(panels.flat, PANELS):
        style.zero_line(axes)
        for k, mu in enumerate(values):
            here = style.select(rows, mu=mu)
            axes.errorbar(style.column(here, name), style.column(here, "by_time"),
                          xerr=style.column(here, name + "_error"),
                          yerr=style.column(here, "by_time_error"), fmt=style.MARKERS[k], color=style.CYCLE[k],
                          elinewidth=0.7, label=rf"$\mu = {mu:g}$")
        rank = ranks[name]
        axes.text(0.98, 0.55, rf"$\rho$ = {rank['rank_correlation']:.2f} ± {rank['rank_correlation_error']:.2f}"
                  .replace("-", "−"), transform=axes.transAxes, ha="right")
        axes.set_xlabel(words)
        axes.set_ylabel(r"rotation $\varpi/\Omega$")
    style.legend(panels[0, 0], ncol=5)
    style.save(drawing, table)
