"""Beyond the paper: rotation of spheres and the packing of their cluster against the number of spheres."""

import style

QUANTITIES = (("by_time", r"rotation $\varpi/\Omega$"), ("order", r"hexatic order $\psi_6$"),
              ("elongation", "elongation"), ("coordination", "contacts of a sphere"))


def draw(table):
    rows = style.read(table)
    drawing, axes = style.figure(height=5.2, nrows=len(QUANTITIES), sharex=True)
    for k, (here, (quantity, label)) in enumerate(zip(axes, QUANTITIES)):
        here.axvspan(28, 30, color="0.9", zorder=0, linewidth=0)
        style.curve(here, rows, "discs", quantity, color=style.CYCLE[k], marker=style.MARKERS[k])
        here.set_ylabel(label)
    style.zero_line(axes[0])
    axes[-1].set_xlabel(r"number of spheres $N$")
    axes[-1].xaxis.set_major_locator(style.matplotlib.ticker.MaxNLocator(integer=True))
    style.save(drawing, table)
