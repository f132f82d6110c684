"""Beyond the paper: without disc friction, rotation and mean spin against time from rest."""

import style
from paper_parameters import EVENTS


def smoothed(rows, name, width=10):
    """Means over `width` periods, and the middles of these intervals."""
    blocks = [rows[k:k + width] for k in range(0, len(rows) - width + 1, width)]
    return ([sum(style.column(b, "period")) / width for b in blocks],
            [sum(style.column(b, name)) / width for b in blocks])


def draw(table):
    rows = style.read(table)
    drawing, (rotation, spin) = style.figure(height=3.6, nrows=2, sharex=True)
    rotation.axhline(1, color=style.GREY, linewidth=0.6, zorder=0)
    for k, discs in enumerate(sorted({row["discs"] for row in rows})):
        curve = style.select(rows, discs=discs)
        look = {"color": style.CYCLE[k], "marker": style.MARKERS[k], "markevery": 5,
                "label": f"$N = {discs:.0f}$"}
        rotation.plot(*smoothed(curve, "varpi"), **look)
        spin.plot(*smoothed(curve, "spin"), **look)
        for axes in (rotation, spin):
            after = [row["period"] for row in curve if row["events"] >= EVENTS]
            if after:
                axes.axvline(after[0], color=style.CYCLE[k], linewidth=0.7, linestyle="--")
    rotation.set_ylabel(r"$\varpi/\Omega$")
    spin.set_ylabel(r"mean spin $\langle\omega_i\rangle/\Omega$")
    spin.set_xlabel(r"periods from rest (dashed: the paper's $10^6$ events)")
    style.legend(rotation, ncol=4)
    style.save(drawing, table)
