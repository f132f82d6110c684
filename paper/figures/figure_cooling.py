"""Beyond the paper: free cooling of a gas of rough discs, and the mean-field theory."""

import os

import numpy as np

import style
import tables

LAST = 10.5  # collisions of a disc that the figure shows
DEVIATION = 15  # per cent
STICKS = 1e3  # friction coefficients above this: every contact sticks, as in the theory


def temperatures(axes, rows, case, look):
    here = sorted(tables.select(rows, case=case), key=lambda row: row["collisions"])
    tau = np.array([0.0] + style.column(here, "collisions"))
    for name, filled in (("translation", True), ("spins", False)):
        start = 1.0 if name == "translation" else 0.0
        if here[0]["mu"] == 0 or here[0]["mu"] > STICKS:
            axes.plot(tau, [start] + style.column(here, f"theory_{name}"), color=look["color"],
                      linestyle="-" if filled else "--", linewidth=0.9)
        axes.errorbar(tau[1:], style.column(here, name), yerr=style.column(here, f"{name}_error"), fmt=look["marker"],
                      color=look["color"], markerfacecolor=look["color"] if filled else "white", elinewidth=0.7)


def deviations(axes, rows, case, look, name):
    here = [row for row in sorted(tables.select(rows, case=case), key=lambda row: row["collisions"])
            if row[f"theory_{name}"] > 0 and row["collisions"] <= LAST
            and abs(row[name] / row[f"theory_{name}"] - 1) < 0.01 * DEVIATION]
    if not here:
        return
    theory = np.array(style.column(here, f"theory_{name}"))
    axes.errorbar(style.column(here, "collisions"), 100 * (np.array(style.column(here, name)) / theory - 1),
                  yerr=100 * np.array(style.column(here, f"{name}_error")) / theory, elinewidth=0.7, **look)


def draw(table):
    rows = style.read(table)
    stem, ending = os.path.splitext(table)
    rates = tables.read(f"{stem}_rates{ending}")
    drawing, panels = style.figure(style.PAGE, 5.4, ncols=2, nrows=2)
    cases = list(dict.fromkeys(row["case"] for row in rows))
    handles = []
    for k, case in enumerate(cases):
        look = {"color": style.CYCLE[k], "marker": style.MARKERS[k]}
        temperatures(panels[0, 0], rows, case, look)
        deviations(panels[0, 1], rows, case, look, "translation")
        deviations(panels[1, 0], rows, case, look, "spins")
        words = tables.select(rows, case=case)[0]["words"]
        handles.append(panels[0, 1].plot([], [], label=words, **look)[0])
    panels[0, 0].set_ylabel("temperature / that at the start")
    panels[0, 1].set_ylabel("$T$: simulation / theory − 1 (%)")
    panels[1, 0].set_ylabel("$T_s$: simulation / theory − 1 (%)")
    for axes in (panels[0, 1], panels[1, 0]):
        style.zero_line(axes)
        axes.set_ylim(-DEVIATION, DEVIATION)
    for axes in (panels[0, 0], panels[0, 1], panels[1, 0]):
        axes.set_xlim(0, LAST)
        axes.set_xlabel(r"collisions per disc $\tau$")
    last = panels[1, 1]
    inverse = [1 / row["container_radius"] for row in rates]
    last.errorbar(inverse, style.column(rates, "rate"), yerr=style.column(rates, "rate_error"), fmt="o",
                  color=style.BLACK, elinewidth=0.7)
    last.axhline(1.0, color=style.GREY, linewidth=0.7, linestyle=":")
    last.set_xlim(0, 1.1 * max(inverse))
    last.locator_params(axis="x", nbins=5)
    last.set_xlabel("$r/R$")
    last.set_ylabel("collision rate / Enskog's")
    style.legend_of_all(drawing, handles, [handle.get_label() for handle in handles], ncol=4)
    drawing.suptitle("\n", fontsize=style.SMALLEST)  # two lines
    style.save(drawing, table)
