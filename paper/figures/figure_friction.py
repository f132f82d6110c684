"""Beyond the paper: the number of discs at which rotation turns into counterrotation, against the
friction coefficient."""

import style
from figure import Figure
from runs import numbers_beyond, text
from searches import SEARCH_COLUMNS, search_cells, search_point

TOP = 0.96  # height in the axes of the markers for friction coefficients without a crossing


def points(settings):
    made = []
    for mu in [0.1, 0.5, 1.0] if settings.quick else [0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 2.0]:
        run = {"mu": mu, "events": int(settings.events or 300_000)}
        # μ = 0.2 crosses beyond the paper's last N.
        made.append(search_point(settings, f"N_c_mu{text(mu)}", run, 20, numbers_beyond(settings)[-1], {"mu": mu}))
    return made


def table(points, settings):
    found = [(point.cells, point.runs[0]) for point in points if point.runs]
    return ({"": ([{**cells, **search_cells(run)} for cells, run in found], ["mu", *SEARCH_COLUMNS])},
            [f"μ = {text(cells['mu'])}: {run['report']}" for cells, run in found])


def draw(table):
    rows = style.read(table)
    drawing, axes = style.figure()
    style.curve(axes, style.select(rows, crosses=1.0), "mu", "crossing", color=style.BLUE,
                marker="o", label="crossing")
    none = style.select(rows, crosses=0.0)
    if none:
        low, high = axes.get_ylim()
        axes.set_ylim(low, high + 0.15 * (high - low))  # these markers stay above every crossing
        axes.plot(style.column(none, "mu"), [TOP] * len(none), "^", color=style.GREY,
                  transform=axes.get_xaxis_transform(), label="no crossing found")
        style.legend(axes)
    axes.set_xscale("log")
    axes.set_xticks([0.05, 0.1, 0.2, 0.5, 1, 2])
    axes.set_xticklabels(["0.05", "0.1", "0.2", "0.5", "1", "2"])
    axes.minorticks_off()
    axes.set_xlabel(r"friction coefficient $\mu_d = \mu_w$")
    axes.set_ylabel(r"crossing $N_c$")
    style.save(drawing, table)


FIGURES = [Figure("friction", "beyond", "beyond the paper: the crossing N_c against μ", points, table, draw)]
