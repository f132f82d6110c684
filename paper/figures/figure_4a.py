"""Figure 4a: the slip parameter of pinned particles, smooth and rough."""

import style
from against_n import against_n
from figure import Figure
from runs import HALF, HIGH, LOW, ROUGH, SMOOTH

PANELS = (("pinned_region", "pinned (SI)"), ("slip_resident", "resident at the wall"), ("cluster", "all"))
WORDS = {"slip.pinned_region": "slip parameter of all discs pinned by the SI's criterion",
         "slip.resident": "slip parameter of discs resident at the wall"}


def draw(table):
    rows = style.read(table)
    drawing, panels = style.figure(width=style.PAGE, height=2.6, ncols=len(PANELS), sharey=True)
    for axes, (quantity, title) in zip(panels, PANELS):
        style.curves_by_setting(axes, rows, quantity)
        axes.axhline(1, color=style.GREY, linewidth=0.6, linestyle="--", zorder=0)
        axes.set_title(title)
        axes.set_xlabel(r"number of particles $N$")
    panels[0].set_ylabel("slip parameter $s$")
    style.legend_of_all(drawing, *panels[0].get_legend_handles_labels(), ncol=5)
    style.save(drawing, table)


FIGURES = [Figure("4a", "paper", "slip parameter of pinned particles, smooth and rough",
                  *against_n((LOW, HIGH, SMOOTH, ROUGH, HALF),
                             "slip.cluster slip.pinned_region slip.resident=slip_resident", WORDS), draw)]
