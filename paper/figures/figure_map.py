"""Beyond the paper: rotation of 48 discs against both friction coefficients."""

import numpy as np
from paper import style
from paper.curves import CERTAIN, lowest_of, rate_of, rows_of, with_error
from paper.figure import Figure
from paper.paper_parameters import LAST_N
from paper.runs import length_of, lengths, text
from paper.study import Point


def points(settings):
    made, steps = [], [0.0, 0.1, 0.3, 1.0] if settings.quick else [
        0.0,
        0.02,
        0.05,
        0.1,
        0.2,
        0.3,
        0.5,
        0.7,
        1.0,
    ]
    for mu_disc in steps:
        for mu_wall in steps:
            if not mu_disc and not mu_wall:
                continue  # there is no steady state
            friction = {"mu_disc": mu_disc, "mu_wall": mu_wall}
            run = {"discs": LAST_N, **friction, **lengths(settings, (100, 2), (200, 4))}
            made.append(
                Point(
                    settings,
                    f"map_d{text(mu_disc)}_w{text(mu_wall)}_{length_of(run)}",
                    settings.seeds_beyond,
                    run,
                    cells={**friction, "discs": LAST_N},
                )
            )
    return made


def table(points, settings):
    rates = [rate_of(point, "mean_by_time") for point in points]
    lowest = lowest_of(rates)
    if not lowest:
        return {"": rows_of(points)}, ["No run was completed."]
    at = points[rates.index(lowest)].cells
    return {"": rows_of(points)}, [
        f"{LAST_N} discs certainly counterrotate at "
        f"{sum(mean < -CERTAIN * error for _, mean, error in rates)} of "
        f"{len(points)} pairs of friction coefficients; lowest is ϖ/Ω = {with_error(*lowest[1:])} "
        f"at μ_d = {text(at['mu_disc'])}, μ_w = {text(at['mu_wall'])}."
    ]


def draw(table):
    rows = style.read(table)
    across, up, rates = style.grid(rows, "mu_disc", "mu_wall", "mean_by_time")
    large = len(up) > 6  # the nine steps of the full study need the width of a page
    drawing, axes = style.figure(*((style.PAGE, 5.6) if large else (style.COLUMN, 2.9)))
    colors = style.directions()
    colors.set_bad("0.85")
    # Counterrotation is weak compared with rotation: linear up to 0.02, logarithmic beyond.
    span = style.matplotlib.colors.SymLogNorm(linthresh=0.02, vmin=-1, vmax=1)
    shown = axes.imshow(rates, origin="lower", cmap=colors, norm=span)
    for (y, x), value in np.ndenumerate(rates):
        if value == value:
            number = f"{value:.2f}".replace("-0.00", "0.00").replace("-", "−")
            axes.text(
                x,
                y,
                number,
                ha="center",
                va="center",
                fontsize=8 if large else style.SMALLEST,
                color="white" if abs(value) > 0.3 else "black",
            )
    for row in style.not_steady(rows):
        corner = (across.index(row["mu_disc"]) - 0.44, up.index(row["mu_wall"]) - 0.44)
        axes.add_patch(
            style.plt.Rectangle(corner, 0.88, 0.88, fill=False, linewidth=0.7, linestyle=":")
        )
        style.note(drawing, "dotted: steady state not verified")
    if np.isnan(rates).any():
        style.note(drawing, "grey: no result")
    style.label_grid(axes, across, up)
    for side in axes.spines.values():
        side.set_visible(False)
    axes.tick_params(length=0)
    bar = drawing.colorbar(shown, ax=axes, shrink=0.85, label=r"$\varpi/\Omega$ at $N = 48$")
    bar.set_ticks([-1, -0.1, 0, 0.1, 1], labels=["−1", "−0.1", "0", "0.1", "1"])
    bar.minorticks_off()
    axes.set(xlabel=r"disc friction $\mu_d$", ylabel=r"wall friction $\mu_w$")
    style.save(drawing, table)


FIGURES = [
    Figure(
        "map",
        "beyond",
        "beyond the paper: both friction coefficients at N = 48",
        points,
        table,
        draw,
    )
]
