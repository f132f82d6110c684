"""What all figures share: sizes, colours, letters, and how a figure is saved.

Colours are those of Okabe and Ito (2008), which people with any kind of colour vision can tell
apart; every curve has a marker of its own besides.
"""

import csv
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

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


def read(table):
    """The rows of a CSV table: numbers as floats, an empty cell as NaN, anything else as text."""

    def value(cell):
        if cell == "":
            return float("nan")
        try:
            return float(cell)
        except ValueError:
            return cell

    with open(table, newline="") as file:
        return [{name: value(cell) for name, cell in row.items()} for row in csv.DictReader(file)]


def select(rows, **wanted):
    return [row for row in rows if all(row[name] == value for name, value in wanted.items())]


def column(rows, name):
    return [row[name] for row in rows]


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
