"""Spheres that roll: N_c against the friction coefficient of all contacts, for the experiment's values and with one
assumption changed at a time. Dashed: N_c of the experiment's smooth and roughened spheres."""

import style
from paper_parameters import ROUGH_CHANGE_N, SMOOTH_CHANGE_N

PANELS = (("amplitude $A$", "A", "{amplitude_mm:g} mm"), ("restitution $e$", "e", "{restitution:g}"),
          ("floor, rolling", "fr", None))


def label_of(row, words):
    if row["curve"] == "experiment":
        return "as the contacts" if words is None else words.format(**row)
    if words is None:
        return (f"floor {row['floor_friction']:g}" if row["curve"][0] == "f"
                else f"resistance {row['rolling_resistance']:g}")
    return words.format(**row)


def draw(table):
    rows = style.read(table)
    drawing, panels = style.figure(width=style.PAGE, height=3.0, ncols=3, sharex=True, sharey=True)
    for axes, (title, letters, words) in zip(panels, PANELS):
        names = ["experiment"] + [name for name in dict.fromkeys(row["curve"] for row in rows)
                                  if name[0] in letters and name != "experiment"]
        for k, name in enumerate(names):
            here = [row for row in style.select(rows, curve=name, crosses=1.0) if row["crossing"] == row["crossing"]]
            if here:
                style.curve(axes, here, "mu", "crossing", color=style.BLACK if k == 0 else style.CYCLE[k - 1],
                            marker=style.MARKERS[k], label=label_of(here[0], words))
        for n in (SMOOTH_CHANGE_N, ROUGH_CHANGE_N):
            axes.axhline(n, color=style.GREY, linewidth=0.6, linestyle="--", zorder=0)
        axes.set_xlabel(r"friction coefficient $\mu$")
        style.legend(axes, ncol=2)
        axes.set_title(title, pad=44)
    panels[0].set_ylabel("$N_c$")
    style.save(drawing, table)
