"""Beyond the paper: kinetic energy, rotation, rings and paths of swirled spheres against their number."""

import os

import numpy as np

import style
import tables

SHIFT = 15  # of the curves of rings


def against_number(axes, rows, quantity, settings):
    """A curve for each setting; open symbols where the cluster certainly counterrotates."""
    for k, setting in enumerate(settings):
        here = sorted(tables.select(rows, setting=setting), key=lambda row: row["discs"])
        color, marker = style.CYCLE[k], style.MARKERS[k]
        axes.plot(style.column(here, "discs"), style.column(here, quantity), color=color, linewidth=0.8)
        for open_symbols in (False, True):
            part = [row for row in here if (row["rotation"] < -3 * row["rotation_error"]) == open_symbols]
            axes.errorbar(style.column(part, "discs"), style.column(part, quantity),
                          yerr=style.column(part, f"{quantity}_error"), fmt=marker, color=color, elinewidth=0.7,
                          markerfacecolor="white" if open_symbols else color)


def rings(axes, rows, numbers):
    for k, number in enumerate(numbers):
        here = [row for row in tables.select(rows, setting="experiment", discs=number) if row["distance"] < 9]
        distance = np.array(style.column(here, "distance"))
        number_at = 2 * np.pi * distance * np.array(style.column(here, "about_centre_of_mass"))
        axes.plot(distance, number_at + SHIFT * k, color=style.CYCLE[k])
        axes.text(8.95, SHIFT * (k + 0.1), f"$N = {number:g}$", color=style.CYCLE[k], ha="right")
        axes.axhline(SHIFT * k, color=style.GREY, linewidth=0.4)
    axes.set_xlabel("distance from the centre of mass $d/r$")
    axes.set_ylabel(f"particles per distance (1/$r$), shifted by {SHIFT}")
    axes.set_xlim(0, 9)


def draw(table):
    rows = style.read(table)
    stem, ending = os.path.splitext(table)
    settings = list(dict.fromkeys(row["setting"] for row in rows))
    drawing, panels = style.figure(style.PAGE, 5.6, ncols=2, nrows=2)
    against_number(panels[0, 0], rows, "energy", settings)
    panels[0, 0].set_ylabel(r"mean kinetic energy $\langle v^2\rangle/v_C^2$")
    panels[0, 0].set_yscale("log")
    against_number(panels[0, 1], rows, "rotation", settings)
    style.zero_line(panels[0, 1])
    panels[0, 1].set_ylabel(r"rotation $\varpi/\Omega$")
    numbers = sorted({row["discs"] for row in rows})
    chosen = [numbers[round(share * (len(numbers) - 1))] for share in (0.2, 0.5, 0.75, 1.0)]
    rings(panels[1, 0], tables.read(f"{stem}_rings{ending}"), chosen)
    against_number(panels[1, 1], rows, "path_distance", settings)
    panels[1, 1].set_ylabel("rms distance from hypotrochoids ($r$)")
    panels[1, 1].set_ylim(bottom=0)
    for axes in (panels[0, 0], panels[0, 1], panels[1, 1]):
        axes.set_xlabel("number of particles $N$")
    handles = [panels[0, 0].plot([], [], color=style.CYCLE[k], marker=style.MARKERS[k],
                                 label=tables.select(rows, setting=setting)[0]["words"])[0]
               for k, setting in enumerate(settings)]
    handles.append(panels[0, 0].plot([], [], "o", color=style.GREY, markerfacecolor="white",
                                     label="open: counterrotates")[0])
    style.legend_of_all(drawing, handles, [handle.get_label() for handle in handles], ncol=4)
    style.save(drawing, table)
