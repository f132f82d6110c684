"""Where in the M-frame discs pin and depin, by the criterion of the paper's Supplementary
Information and by residences in the wall layer."""

from paper import style
from paper.combine import failed, number
from paper.figure import Figure
from paper.figures.figure_3 import FIRST, first_cells, points
from paper.paper_parameters import COUNTERROTATING_N, ROTATING_N

CRITERIA = (
    ("the SI's criterion", style.RED, "--", ("si_pinning", "si_depinning")),
    ("residences in the wall layer", style.BLUE, "-", ("residence_begin", "residence_end")),
)
EVENTS = ("pinning", "depinning")


def table(points, settings):
    """Distributions of the angles where discs pin and depin. Mean directions alone do not show
    them."""
    columns = [*FIRST, "theta"] + [
        f"{name}{ending}"
        for _, _, _, names in CRITERIA
        for name in names
        for ending in ("", "_mean", "_mean_error", "_resultant")
    ]
    rows = []
    for point in points:
        if failed(point.result):
            continue
        found = point.result["measured"]
        for k, theta in enumerate(found["residence"]["positions"]["theta"]):
            cells = [*first_cells(point).values(), theta]
            for criterion in ("pinned", "residence"):
                for event in EVENTS:
                    mean = found[criterion][event]
                    cells += [
                        found[criterion]["positions"][event][k],
                        *(number(mean.get(part)) for part in ("mean", "error", "concentration")),
                    ]
            rows.append(dict(zip(columns, cells)))
    return {"": (rows, columns)}, []


def draw(table):
    rows = style.read(table)
    rows = style.select(rows, setting="smooth") or rows
    known = style.distinct(rows, "discs")
    # The N of the paper's maps, or the nearest ones.
    numbers = sorted(
        {min(known, key=lambda n: abs(n - target)) for target in (ROTATING_N, COUNTERROTATING_N)}
    )
    drawing, panels = style.figure(
        width=style.PAGE,
        height=4.6,
        nrows=2,
        ncols=len(numbers),
        sharex=True,
        sharey="row",
        squeeze=False,
    )
    for column, discs in enumerate(numbers):
        here = sorted(style.select(rows, discs=discs), key=lambda row: row["theta"])
        width = 360 / len(here)
        edges = [row["theta"] - width / 2 for row in here] + [here[-1]["theta"] + width / 2]
        for which, axes in enumerate(panels[:, column]):
            means = []
            for label, color, line, names in CRITERIA:
                name = names[which]
                axes.stairs(
                    [100 * row[name] for row in here],
                    edges,
                    color=color,
                    linestyle=line,
                    linewidth=1.1,
                    label=label,
                )
                means.append((here[0][name + "_resultant"], here[0][name + "_mean"], color))
            axes.set_title(
                f"$N = {discs:.0f}$, {EVENTS[which]}: resultant "
                f"{means[0][0]:.2f} (SI), {means[1][0]:.2f} (residences)",
                fontsize=style.SMALLEST + 0.5,
                pad=11,
            )
            for _, mean, color in means:
                # Above the axes, clear of the curves.
                axes.plot(
                    mean,
                    1.02,
                    "v",
                    color=color,
                    markersize=4,
                    clip_on=False,
                    transform=axes.get_xaxis_transform(),
                )
            axes.set_xlim(0, 360)
            axes.set_xticks(range(0, 361, 45))
    for axes in panels.flat:
        axes.set_ylim(bottom=0)
    for axes in panels[:, 0]:
        axes.set_ylabel("per cent in 10°")
    for axes in panels[-1]:
        axes.set_xlabel(r"angular position $\theta$ (°); M is at 270°")
    style.legend_of_all(drawing, panels[0][0], ncol=2)
    style.note_not_steady(drawing, [row for row in rows if row["discs"] in numbers])
    style.save(drawing, table)


FIGURES = [
    Figure(
        "pinning", "paper", "where particles pin and depin, by two criteria", points, table, draw
    )
]
