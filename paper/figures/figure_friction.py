"""Beyond the paper: the number of discs at which rotation turns into counterrotation, against the
friction coefficient."""

from paper import style
from paper.figure import Figure
from paper.runs import numbers_beyond, text
from paper.searches import SEARCH_COLUMNS, search_cells, search_point


def points(settings):
    made = []
    for mu in [0.1, 0.5, 1.0] if settings.quick else [0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 2.0]:
        run = {"mu": mu, "events": int(settings.events or 300_000)}
        # μ = 0.2 crosses beyond the paper's last N.
        made.append(
            search_point(
                settings, f"N_c_mu{text(mu)}", run, 20, numbers_beyond(settings)[-1], {"mu": mu}
            )
        )
    return made


def table(points, settings):
    found = [(point.cells, point.runs[0]) for point in points if point.runs]
    return (
        {"": ([{**cells, **search_cells(run)} for cells, run in found], ["mu", *SEARCH_COLUMNS])},
        [f"μ = {text(cells['mu'])}: {run['report']}" for cells, run in found],
    )


def draw(table):
    rows = style.read(table)
    drawing, axes = style.figure()
    style.curve(
        axes, style.select(rows, crosses=1.0), "mu", "crossing", color=style.BLUE, marker="o"
    )
    style.without_crossing(axes, rows, "mu", style.BLUE)
    axes.margins(y=0.15)  # the arrows are above every crossing
    axes.set_xscale("log")
    axes.set_xticks([0.05, 0.1, 0.2, 0.5, 1, 2])
    axes.set_xticklabels(["0.05", "0.1", "0.2", "0.5", "1", "2"])
    axes.minorticks_off()
    axes.set(xlabel=r"friction coefficient $\mu_d = \mu_w$", ylabel=r"crossing $N_c$")
    style.save(drawing, table)


FIGURES = [
    Figure(
        "friction", "beyond", "beyond the paper: the crossing N_c against μ", points, table, draw
    )
]
