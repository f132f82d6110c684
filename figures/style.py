"""What all figures share: sizes, colours, letters, and how a figure is saved.

Colours are those of Okabe and Ito (2008), which people with any kind of colour vision can tell
apart; every curve has a marker of its own besides.
"""

import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from tables import column, read, select  # noqa: E402, F401

# Column widths of the Physical Review, in inches.
COLUMN = 3.375
PAGE = 7.0

BLACK = "#000000"
ORANGE = "#e69f00"
SKY = "#56b4e9"
GREEN = "#009e73"
YELLOW = "#f0e442"
BLUE = "#0072b2"
RED = "#d55e00"
PINK = "#cc79a7"
GREY = "#7f7f7f"
CYCLE = [BLUE, RED, GREEN, PINK, ORANGE, SKY, BLACK, GREY]
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "<"]

SETTINGS = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 8,
    "axes.labelsize": 8.5,
    "axes.linewidth": 0.6,
    "axes.prop_cycle": matplotlib.cycler(color=CYCLE),
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 8.5,
    "xtick.labelsize": 7.5,
    "ytick.labelsize": 7.5,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.major.size": 3,
    "ytick.major.size": 3,
    "legend.fontsize": 7,
    "legend.frameon": False,
    "legend.handlelength": 1.6,
    "lines.linewidth": 1.0,
    "lines.markersize": 3.2,
    "errorbar.capsize": 0,
    "image.cmap": "viridis",
    "figure.dpi": 300,
    "savefig.dpi": 300,
    "pdf.fonttype": 42,  # letters as letters, so that the text can be searched
    "axes.unicode_minus": True,
    "mathtext.fontset": "dejavusans",
}


def figure(width=COLUMN, height=None, **subplots):
    """A figure of the given width in inches; returns what plt.subplots returns."""
    plt.rcParams.update(SETTINGS)
    height = height or 0.72 * width
    return plt.subplots(figsize=(width, height), constrained_layout=True, **subplots)


def curve(axes, rows, x, y, **look):
    """One line with its errors."""
    axes.errorbar(column(rows, x), column(rows, y), yerr=column(rows, y + "_error"),
                  elinewidth=0.7, **look)


def zero_line(axes):
    axes.axhline(0, color=GREY, linewidth=0.6, zorder=0)


def middle(values, margin=0.08):
    """Limits that hold all values but the most extreme hundredth on either side."""
    ordered = sorted(v for v in values if v == v)
    low, high = ordered[len(ordered) // 100], ordered[-1 - len(ordered) // 100]
    room = margin * (high - low) or 1.0
    return low - room, high + room


def scale(values, colors):
    """What a colour bar needs."""
    span = matplotlib.colors.Normalize(min(values), max(values))
    return matplotlib.cm.ScalarMappable(norm=span, cmap=colors)


def bare(axes):
    """No axes: a picture of things, not of numbers."""
    axes.set_aspect("equal")
    axes.axis("off")


def dish(axes, radius, centre=(0, 0)):
    """The container's wall."""
    bare(axes)
    axes.add_patch(plt.Circle(centre, radius, fill=False, color=BLACK, linewidth=0.8))
    axes.set_xlim(centre[0] - 1.04 * radius, centre[0] + 1.04 * radius)
    axes.set_ylim(centre[1] - 1.04 * radius, centre[1] + 1.04 * radius)


def cells(axes, rows, name, radius):
    """A map of equal cells over the square of the container, white outside of it."""
    side = round(len(rows) ** 0.5)
    image = [column(rows[k * side:(k + 1) * side], name) for k in range(side)]
    shown = axes.imshow(image, origin="lower", extent=[-radius, radius, -radius, radius],
                        interpolation="nearest", vmin=0)
    shown.set_clip_path(plt.Circle((0, 0), radius, transform=axes.transData))
    return shown


def arrows(axes, rows, radius, color, least=0):
    """Velocities in units of the container's speed; cells seldom visited are left out."""
    rows = [row for row in rows if row["visits"] > least]
    drawn = axes.quiver(column(rows, "x"), column(rows, "y"), column(rows, "u_x"),
                        column(rows, "u_y"), color=color, angles="xy", scale_units="xy",
                        scale=1.0, width=0.006, headwidth=3.5, headlength=4)
    axes.quiverkey(drawn, 0.86, 0.03, 1.0, "speed 1", labelpos="N", coordinates="axes",
                   color=BLACK if color == "white" else color, fontproperties={"size": 6},
                   labelsep=0.03)


def save(drawing, table):
    """PNG and PDF beside the table, each written aside and renamed; no date inside, so the same
    table gives the same bytes."""
    stem = os.path.splitext(table)[0]
    for kind, about in (("png", {"Software": None}), ("pdf", {"CreationDate": None})):
        aside = f"{stem}.{os.getpid()}.partial.{kind}"
        try:
            drawing.savefig(aside, metadata=about)
            os.replace(aside, f"{stem}.{kind}")
        except OSError as error:
            if os.path.exists(aside):
                os.remove(aside)
            sys.exit(f"'{stem}.{kind}' could not be written: {error.strerror}.")


def table_from_arguments(name):
    """The one argument of a figure's script: the table it draws."""
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print(f"usage: /usr/bin/python3 {sys.argv[0]} {name}.csv\n"
              f"draws the table that `swirl paper` wrote, to PNG and PDF beside it", file=sys.stderr)
        sys.exit(0 if sys.argv[1:] in (["-h"], ["--help"]) else 2)
    if not os.path.exists(sys.argv[1]):
        sys.exit(f"There is no table '{sys.argv[1]}'; `swirl paper` writes it.")
    return sys.argv[1]
