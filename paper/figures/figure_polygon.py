"""Beyond the paper: rotation against the number of sides of the container's path."""

from paper import style
from paper.curves import rate_of, rows_of, with_error
from paper.figure import Figure
from paper.paper_parameters import COUNTERROTATING_N, ROTATING_N
from paper.runs import sides
from paper.study import Point


def points(settings):
    """Vertices are events, too. A length in periods gives every path the same time."""
    made = []
    for discs, periods in ((ROTATING_N, 2000), (COUNTERROTATING_N, 300)):
        periods = settings.periods(periods, 5)
        for m in [6, 30, 300, 0] if settings.quick else [6, 10, 20, 30, 60, 100, 300, 0]:
            made.append(
                Point(
                    settings,
                    f"polygon_M{m}_N{discs}_{periods}periods",
                    settings.seeds_beyond,
                    {"discs": discs, "periods": periods, **sides(m)},
                    cells={"sides": m, "discs": discs},
                )
            )
    return made


def table(points, settings):
    words = {}
    for point in points:
        m = point.cells["sides"]
        words.setdefault(point.cells["discs"], []).append(
            f"{with_error(*rate_of(point, 'mean_by_time')[1:])} on "
            f"{f'{m} sides' if m else 'the circle'}"
        )
    return {"": rows_of(points)}, [
        f"N = {discs}: ϖ/Ω by time = {', '.join(all)}." for discs, all in words.items()
    ]


def draw(table):
    rows = style.read(table)
    groups = style.groups(rows, "discs")
    drawing, axes = style.figure(height=3.4, nrows=len(groups), sharex=True, squeeze=False)
    for panel, (discs, here, look) in zip(axes[:, 0], groups):
        style.curve(
            panel,
            [row for row in here if row["sides"] > 0],
            "sides",
            "mean_by_time",
            label="polygon",
            **look,
        )
        for circle in style.select(here, sides=0.0):
            note = " (steady state not verified)" if style.not_steady([circle]) else ""
            panel.axhline(
                circle["mean_by_time"], color=style.BLACK, linewidth=0.7, label="circle" + note
            )
            panel.axhspan(
                circle["mean_by_time"] - circle["mean_by_time_error"],
                circle["mean_by_time"] + circle["mean_by_time_error"],
                color=style.GREY,
                alpha=0.3,
                linewidth=0,
            )
        panel.set(xscale="log", ylabel=rf"$\varpi/\Omega$,  $N = {discs:.0f}$")
        style.legend(panel)
    axes[-1][0].set_xticks([6, 10, 30, 100, 300])
    axes[-1][0].set_xticklabels(["6", "10", "30", "100", "300"])
    axes[-1][0].minorticks_off()
    axes[-1][0].set_xlabel("sides of the polygon $M$")
    style.save(drawing, table)


FIGURES = [
    Figure(
        "polygon",
        "beyond",
        "beyond the paper: the polygon's sides, and the true circle",
        points,
        table,
        draw,
    )
]
