"""Beyond the paper: rotation of 48 discs against both friction coefficients."""

import style
from curves import CERTAIN, lowest_of, rate_of, rows_of, with_error
from figure import Figure
from paper_parameters import LAST_N
from runs import length_of, lengths, text
from study import Point


def points(settings):
    made, steps = [], [0.0, 0.1, 0.3, 1.0] if settings.quick else [0.0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0]
    for mu_disc in steps:
        for mu_wall in steps:
            if not mu_disc and not mu_wall:
                continue  # there is no steady state
            friction = {"mu_disc": mu_disc, "mu_wall": mu_wall}
            run = {"discs": LAST_N, **friction, **lengths(settings, (100, 2), (200, 4))}
            made.append(Point(settings, f"map_d{text(mu_disc)}_w{text(mu_wall)}_{length_of(run)}", settings.seeds_beyond,
                              run, cells={**friction, "discs": LAST_N}))
    return made


def table(points, settings):
    rates = [rate_of(point, "mean_by_time") for point in points]
    lowest = lowest_of(rates)
    if not lowest:
        return {"": rows_of(points)}, ["No run was completed."]
    at = points[rates.index(lowest)].cells
    return {"": rows_of(points)}, [
        f"{LAST_N} discs certainly counterrotate at {sum(mean < -CERTAIN * error for _, mean, error in rates)} of "
        f"{len(points)} pairs of friction coefficients; lowest is ϖ/Ω = {with_error(*lowest[1:])} at "
        f"μ_d = {text(at['mu_disc'])}, μ_w = {text(at['mu_wall'])}."]


def draw(table):
    rows = style.read(table)
    steps = style.distinct(rows, "mu_wall")
    # The nine steps of the full study need the width of a page.
    large = len(steps) > 6
    drawing, axes = style.figure(width=style.PAGE if large else style.COLUMN,
                                 height=5.6 if large else 2.9)
    style.rotation_map(drawing, axes, rows, ("mu_disc", "mu_wall"), fontsize=8 if large else style.SMALLEST,
                       label=r"$\varpi/\Omega$ at $N = 48$")
    axes.set(xlabel=r"disc friction $\mu_d$", ylabel=r"wall friction $\mu_w$")
    style.save(drawing, table)


FIGURES = [Figure("map", "beyond", "beyond the paper: both friction coefficients at N = 48", points, table, draw)]
