"""The common style of all figures: sizes, colours, fonts, recurring elements, and saving.

The colours are those of Okabe and Ito (2008), which are distinguishable with any kind of colour
vision. Every curve also has its own marker.
"""

import io
import math
import sys

import numpy as np

from paper import atomic_file, look, tables
from paper.paper_parameters import AMPLITUDE
from paper.tables import column, distinct, select  # noqa: F401

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import matplotlib.ticker
    from matplotlib.patheffects import withStroke
except ModuleNotFoundError as missing:
    if missing.name != "matplotlib":
        raise

    class Missing:
        """Tables are made without matplotlib; the first use of it fails."""

        def __getattr__(self, name):
            raise ModuleNotFoundError("No module named 'matplotlib'", name="matplotlib")

    matplotlib = plt = Missing()

# Column widths of the Physical Review, in inches.
COLUMN = 3.375
PAGE = 7.0
SMALLEST = 7  # font size in points, where a figure is as wide as its column

BLACK = "#000000"
ORANGE = "#e69f00"
SKY = "#56b4e9"
GREEN = "#009e73"
BLUE = "#0072b2"
RED = "#d55e00"
PINK = "#cc79a7"
GREY = "#7f7f7f"
CYCLE = [BLUE, RED, GREEN, PINK, ORANGE, SKY, BLACK, GREY]
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "<"]

# Settings of the figures with spheres and discs: label, colour, marker. Discs have dotted lines.
LOOKS = {
    "smooth": ("smooth spheres", {"color": BLUE, "marker": "o"}),
    "rough": ("roughened spheres", {"color": RED, "marker": "s"}),
    "half": ("smooth, half the amplitude", {"color": GREY, "marker": "v", "linestyle": "--"}),
    "high": (r"discs, $\mu = 1$", {"color": ORANGE, "marker": "D", "linestyle": ":"}),
    "low": (r"discs, $\mu = 0.1$", {"color": SKY, "marker": "^", "linestyle": ":"}),
}

SETTINGS = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 8,
    "mathtext.fontset": "dejavusans",
    "axes.labelsize": 8.5,
    "axes.titlesize": 8.5,
    "axes.linewidth": 0.6,
    "axes.prop_cycle": f"cycler(color={CYCLE})",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.unicode_minus": True,
    **{
        f"{axis}tick.{name}": value
        for axis in "xy"
        for name, value in (
            ("labelsize", 7.5),
            ("direction", "in"),
            ("major.width", 0.6),
            ("major.size", 3),
        )
    },
    "legend.fontsize": SMALLEST,
    "legend.frameon": False,
    "legend.handlelength": 1.6,
    "lines.linewidth": 1.0,
    "lines.markersize": 3.2,
    "errorbar.capsize": 0,
    "image.cmap": "viridis",
    "figure.dpi": 300,
    "savefig.dpi": 300,
    "pdf.fonttype": 42,  # TrueType: the text can be searched
}


def read(table):
    """The rows of a table; ends the script if there are none."""
    rows = tables.read(table)
    if not rows:
        sys.exit(f"error: '{table}' has no rows, so nothing is drawn.")
    return rows


def figure(width=COLUMN, height=None, **subplots):
    """plt.subplots() with width and height in inches."""
    plt.rcParams.update(SETTINGS)
    height = height or 0.72 * width
    return plt.subplots(figsize=(width, height), constrained_layout=True, **subplots)


def directions():
    """The colour map of signed rates: against the swirl, none, with it."""
    ends = [look.AGAINST, look.NEUTRAL, look.WITH]
    return matplotlib.colors.LinearSegmentedColormap.from_list("directions", ends)


def not_steady(rows):
    """Rows whose steady state is not verified: the run drifts, or is too short for the test."""
    return [row for row in rows if row.get("steady_state", "steady") not in ("steady", "failed")]


def note(drawing, text):
    """A remark below the figure, once."""
    notes = drawing.__dict__.setdefault("notes", [])
    if text not in notes:
        notes.append(text)
        line = "; ".join(notes)
        fits = len(line) < 19 * drawing.get_size_inches()[0]  # letters of an inch
        drawing.supxlabel(line if fits else "\n".join(notes), fontsize=SMALLEST, color="0.3")


def note_not_steady(drawing, rows):
    """For maps and profiles, which have no symbols: a note with the numbers of discs."""
    numbers = distinct(not_steady(rows), "discs")
    if numbers:
        note(drawing, "steady state not verified: N = " + ", ".join(f"{n:.0f}" for n in numbers))


def groups(rows, name):
    """[(value, its rows, colour and marker)] of each value of a column."""
    return [
        (value, select(rows, **{name: value}), look_of(k))
        for k, value in enumerate(distinct(rows, name))
    ]


def look_of(k):
    return {"color": CYCLE[k], "marker": MARKERS[k]}


def curve(axes, rows, x, y, **look):
    """One line with errors; its symbols are open where the run is not steady. If no run has an
    average, only its label. Returns the mark for a legend."""
    if not np.isfinite(column(rows, y)).any():
        return axes.errorbar([], [], **look)
    bars = column(rows, y + "_error")
    if not np.isfinite(bars).any():  # a video of few periods; matplotlib needs a finite one
        bars = None
    elif axes.get_yscale() == "log":
        bars = log_errors(column(rows, y), bars)
    across = column(rows, x + "_error") if x + "_error" in rows[0] else None
    mark = axes.errorbar(
        column(rows, x), column(rows, y), bars, across, **({"elinewidth": 0.7} | look)
    )
    line, marked = mark[0], not_steady(rows)
    if marked:
        axes.plot(
            column(marked, x),
            column(marked, y),
            line.get_marker(),
            color=line.get_color(),
            markersize=line.get_markersize(),
            markerfacecolor="white",
            markeredgewidth=0.6,
            zorder=line.get_zorder(),
        )
        note(axes.figure, "open: steady state not verified")
    return mark


def rotation_figure(table, curves, of="discs", width=COLUMN, height=None, fine=False, **more):
    """A complete figure: rotation against the number of `of`; `curves` are rows and their style.
    With `fine`, the scale is fine near zero."""
    drawing, axes = figure(width, height)
    zero_line(axes)
    for rows, look in curves:
        curve(axes, rows, "discs", "mean_by_time", **look)
    if fine:
        fine_near_zero(axes, [row["mean_by_time"] for rows, _ in curves for row in rows])
    rotation_axes(axes, of=of)
    legend(axes, **more)
    save(drawing, table)


LINEAR = 0.1  # rotation rates: linear up to ±0.1, logarithmic beyond


def fine_near_zero(axes, values, linear=LINEAR):
    """Shows all values with a fine scale near zero. Dotted lines mark where the scale becomes
    logarithmic."""
    low, high = np.nanmin([*values, 0]), np.nanmax([*values, 0])
    if max(high, -low) <= linear:
        return
    axes.set_yscale("symlog", linthresh=linear, linscale=2)
    ticks = [0, *(sign * linear * k for sign in (-1, 1) for k in (0.5, 1, 3, 10, 30, 100, 300))]
    axes.set_yticks([t for t in ticks if low - linear / 4 <= t <= max(high, linear)])
    axes.yaxis.set_major_formatter(lambda y, _: f"{y:g}".replace("-", "−"))
    axes.minorticks_off()
    for level, beyond in ((linear, high), (-linear, -low)):
        if beyond > linear:
            axes.axhline(level, color=GREY, linewidth=0.7, linestyle=":", zorder=0)
    note(axes.figure, "logarithmic beyond the dotted lines")


def without_crossing(axes, rows, x, color):
    """Arrows towards the N_c that a search has not found: it is above the searched N, or below for
    more friction."""
    found = column(select(rows, crosses=1.0), x)
    for row in select(rows, crosses=0.0):
        above = not found or row[x] < min(found)
        axes.annotate(
            "",
            (row[x], 0.99 if above else 0.01),
            (row[x], 0.91 if above else 0.09),
            axes.get_xaxis_transform(),
            arrowprops={"arrowstyle": "->", "color": color, "linewidth": 0.8},
        )
        note(axes.figure, "arrows: no change of direction among the searched $N$")


def log_errors(values, errors):
    """Bars of a logarithmic axis: the errors of ln y, so that no bar reaches zero."""
    values, factor = np.abs(values), np.exp(np.array(errors) / np.abs(values))
    return [values * (1 - 1 / factor), values * (factor - 1)]


def legend(axes, ncol=2, **more):
    """Above the axes, clear of the data."""
    axes.legend(
        loc="lower center",
        bbox_to_anchor=(0.5, 1.0),
        ncol=ncol,
        columnspacing=1.2,
        borderaxespad=0.2,
        **more,
    )


def legend_of_all(drawing, marks, ncol):
    """Above all axes of a figure; `marks` are those of the legend, or the axes that have them."""
    marks = marks if isinstance(marks, list) else marks.get_legend_handles_labels()[0]
    drawing.suptitle(
        "\n".join([" "] * math.ceil(len(marks) / ncol)), fontsize=SMALLEST
    )  # reserves the space
    drawing.legend(
        marks,
        [mark.get_label() for mark in marks],
        loc="upper center",
        ncol=ncol,
        columnspacing=1.2,
        borderaxespad=0.2,
    )


def rotation_axes(axes, average="by time", of="discs"):
    axes.set_xlabel(rf"number of {of} $N$")
    axes.xaxis.set_major_locator(matplotlib.ticker.MaxNLocator(integer=True, steps=(1, 2, 5, 10)))
    axes.set_ylabel(rf"rotation $\varpi/\Omega$, {average}")


def curves_by_setting(axes, rows, quantity, settings=tuple(LOOKS), **more):
    """A curve against N for each setting of the table."""
    for name in settings:
        here = [row for row in select(rows, setting=name) if row[quantity] == row[quantity]]
        if here:
            label, look = LOOKS[name]
            curve(axes, here, "discs", quantity, **({"label": label} | look | more))


def zero_line(axes):
    axes.axhline(0, color=GREY, linewidth=0.6, zorder=0)


def scale(values, colors):
    """A mappable for a colour bar."""
    span = matplotlib.colors.Normalize(min(values), max(values))
    return matplotlib.cm.ScalarMappable(norm=span, cmap=colors)


def bare(axes):
    """No axes, for a drawing in space."""
    axes.set_aspect("equal")
    axes.axis("off")


def map_radius(cells):
    """The radius of the container, from the centres of the cells of a map."""
    across = len({row["x"] for row in cells})
    return max(row["x"] for row in cells) * across / (across - 1)


def container(axes, radius, color=BLACK, amplitude=AMPLITUDE):
    """The wall in the M-frame, with M, the centre S of the swirl above C, and θ."""
    bare(axes)
    axes.add_patch(plt.Circle((0, 0), radius, fill=False, color=BLACK, linewidth=0.8))
    axes.plot(0, -radius, "o", color=PINK, markersize=3, clip_on=False, zorder=5)
    axes.text(0, -1.07 * radius, "$M$", color=PINK, fontsize=SMALLEST + 1, ha="center", va="top")
    # The outline keeps it visible on arrows and on any colour of a map.
    edge = [withStroke(linewidth=1.6, foreground=BLACK if color == "white" else "white")]
    axes.plot(
        0,
        amplitude,
        "+",
        color=color,
        markersize=4,
        markeredgewidth=0.8,
        zorder=5,
        path_effects=edge,
    )
    axes.text(
        0.05 * radius,
        amplitude + 0.02 * radius,
        "$S$",
        color=color,
        fontsize=SMALLEST + 1,
        va="bottom",
        zorder=5,
        path_effects=edge,
    )
    for degrees, align in ((0, "left"), (90, "center"), (180, "right")):
        turn = math.radians(degrees)
        axes.text(
            1.06 * radius * math.cos(turn),
            1.11 * radius * math.sin(turn),
            r"$\theta = 0$" if degrees == 0 else f"{degrees}°",
            fontsize=SMALLEST,
            color="0.3",
            ha=align,
            va="center",
        )
    axes.set(xlim=(-1.3 * radius, 1.3 * radius), ylim=(-1.3 * radius, 1.2 * radius))


def cells(axes, rows, name, radius, most):
    """A map of equal cells over the square around the container, white outside the container.
    Colours grow with the square root, so that one scale up to `most` shows few particles and
    many."""
    side = round(len(rows) ** 0.5)
    image = [column(rows[k * side : (k + 1) * side], name) for k in range(side)]
    shown = axes.imshow(
        image,
        origin="lower",
        extent=[-radius, radius, -radius, radius],
        interpolation="nearest",
        norm=matplotlib.colors.PowerNorm(0.5, 0, most),
    )
    shown.set_clip_path(plt.Circle((0, 0), radius, transform=axes.transData))
    return shown


def often_visited(rows, least):
    """Cells of a flow map with more than this share of all visits; others have no reliable mean."""
    total = sum(row["visits"] for row in rows)
    return [row for row in rows if row["visits"] > least * total]


COARSE = 2  # cells of the table, in each direction, that share an arrow on a density map


def blocks(rows, side):
    """The flow in squares of side × side cells; all visits have the same weight."""
    across, up = (distinct(rows, axis) for axis in ("x", "y"))
    members = {}
    for row in rows:
        members.setdefault((across.index(row["x"]) // side, up.index(row["y"]) // side), []).append(
            row
        )

    def middle(positions, k):
        here = positions[k * side : (k + 1) * side]
        return sum(here) / len(here)

    result = []
    for (i, j), here in members.items():
        here = [row for row in here if row["visits"] > 0]
        visits = sum(row["visits"] for row in here)
        if visits:
            result.append(
                {"x": middle(across, i), "y": middle(up, j), "visits": visits}
                | {
                    name: sum(row["visits"] * row[name] for row in here) / visits
                    for name in ("u_x", "u_y")
                }
            )
    return result


def speed(row):
    return math.hypot(row["u_x"], row["u_y"])


def arrows(axes, rows, spacing, fastest, color, key=(0.9, 0.03)):
    """Velocities in units of the container's speed, each in the middle of its cell. The fastest
    arrow is as long as the distance of the cells, so arrows do not overlap. `key`: position of the
    scale in the axes."""
    drawn = axes.quiver(
        column(rows, "x"),
        column(rows, "y"),
        column(rows, "u_x"),
        column(rows, "u_y"),
        color=color,
        angles="xy",
        scale_units="xy",
        scale=fastest / spacing,
        pivot="mid",
        units="xy",
        width=0.095 * spacing,
        headwidth=3.6,
        headlength=4,
        headaxislength=3.6,
        minlength=0.5,
    )
    # The scale, outside the container.
    known = max([k for k in (0.1, 0.2, 0.5, 1, 2, 5) if k <= fastest], default=fastest)
    axes.quiverkey(
        drawn,
        *key,
        known,
        f"speed {known:g}",
        labelpos="N" if key[0] > 0.5 else "E",
        coordinates="axes",
        color=BLACK if color == "white" else color,
        fontproperties={"size": SMALLEST},
        labelsep=0.03,
    )


def save(drawing, table):
    """Writes PNG and PDF next to the table, atomically. They contain no date: the same table gives
    the same bytes."""
    drawing.draw_without_rendering()  # the first layout has the sizes of labels that change in it
    for kind, about in (("png", {"Software": None}), ("pdf", {"CreationDate": None})):
        drawn = io.BytesIO()
        drawing.savefig(drawn, format=kind, metadata=about)
        drawing.set_layout_engine("none")  # one layout for both files
        atomic_file.write_or_exit(table.removesuffix("csv") + kind, drawn.getvalue())


def grid(rows, x, y, name):
    """(values along x, values along y, image) of a quantity over two parameters; points without a
    row are NaN."""
    across, up = distinct(rows, x), distinct(rows, y)
    image = np.full((len(up), len(across)), np.nan)
    for row in rows:
        image[up.index(row[y]), across.index(row[x])] = row[name]
    return across, up, image


def label_grid(axes, across, up):
    axes.set_xticks(range(len(across)), [f"{value:g}" for value in across])
    axes.set_yticks(range(len(up)), [f"{value:g}" for value in up])
