"""Do opposite spins of touching particles ("gears") get lost before the slip parameter rises, with
it, or after it? Contacts in triangles and in none, of discs and spheres, from the runs of the
figures 4 and "gears", and of discs at other amplitudes.

The gear order is the spin correlation of touching particles in no triangle with the opposite sign:
1 for gears, 0 for independent spins. Its loss is the N beyond its maximum at which a share q of the
maximum is left. The rise of the slip is the N at which the slip parameter has 1 − q of its way from
its lowest value to that at the last N. The lag is loss minus rise, for q = 3/4, 1/2 and 1/4.
Errors: jackknife over the seeds. Limits: the rise depends on the range of N; curves are
interpolated by straight lines; a curve without certain gear order above LEAST_ORDER has no loss."""

import math

import numpy as np
from paper import style
from paper.chapters.mechanism import gears_points, mechanism_point, mechanism_run
from paper.coarse_zero import rise_through
from paper.combine import at, number
from paper.curves import CERTAIN, measured_cells, with_error
from paper.engine import swirl
from paper.figure import Figure
from paper.jackknife import jackknife
from paper.paper_parameters import AMPLITUDE, AMPLITUDES, CONTAINER_RADIUS, EXPERIMENT_DISH, LAST_N
from paper.runs import HALF, HIGH, LOW, ROUGH, SMOOTH, measured_point, points_of

FRICTIONS = (LOW, HIGH, SMOOTH, ROUGH, HALF)
LEFT = (0.75, 0.5, 0.25)  # q
LEAST_ORDER = 0.1
RATIOS = (0.11, 0.44)  # A/R of discs with μ = 1, besides the paper's 0.22
MEASURED = (
    "frustration.chain_correlation",
    "frustration.triangle_correlation",
    "frustration.triangles",
    "slip.resident=slip",
)
QUANTITIES = {"order": "frustration.chain_correlation", "slip": "slip.resident"}


def points(settings):
    gears = gears_points(settings)
    numbers = dict.fromkeys(p.cells["discs"] for p in gears)
    return (
        [
            measured_point(settings, friction, discs)
            for friction, discs in points_of(settings, FRICTIONS)
            if discs <= LAST_N
        ]
        + gears
        + [
            mechanism_point(
                settings,
                f"gear-order_A{ratio:g}_N{discs}",
                mechanism_run(settings, discs, 1)
                | {"amplitude": ratio * CONTAINER_RADIUS, "speed": 1},
                {"mu": 1, "discs": discs},
                ["slip", "frustration"],
            )
            for ratio in RATIOS
            for discs in numbers
        ]
    )


def row_of(point):
    """The correlation of contacts in no triangle and in triangles, the share of the latter, and the
    slip."""
    given, cells = point.tasks[0].parameters, point.cells
    ratio = (
        AMPLITUDES[cells["setting"]] / EXPERIMENT_DISH[0]
        if "preset" in given
        else (given.get("amplitude", AMPLITUDE) / CONTAINER_RADIUS)
    )
    return {
        "particles": "spheres" if "preset" in given else "discs",
        "setting": cells.get("setting", "more"),
        "mu": cells.get("mu", cells.get("mu_disc")),
        "amplitude_ratio": round(ratio, 4),
        "discs": cells["discs"],
        "seeds": len(point.runs),
        **measured_cells(point.result, MEASURED),
    }


def loss(discs, order, left):
    top = int(np.argmax(order))
    return rise_through(discs[top:], -order[top:], -left * order[top])


def rise(discs, slip, left):
    low = int(np.argmin(slip))
    return rise_through(discs[low:], slip[low:], slip[low] + (1 - left) * (slip[-1] - slip[low]))


def timing(discs, order, slip):
    """Rows for each q; `order` and `slip` are arrays [seed, N]. Without certain gear order there is
    no loss."""
    seeds, (means, errors) = np.arange(len(order)), swirl.mean(order.T)[:2]
    top = int(np.argmax(means))
    error = errors[top]
    ordered = means[top] - CERTAIN * error > LEAST_ORDER
    rows = []
    for left in LEFT:
        row = {"left": left, "order": means[top], "order_error": error, "order_discs": discs[top]}

        def lost(k):
            return loss(discs, order[k].mean(axis=0), left) if ordered else math.nan

        def risen(k):
            return rise(discs, slip[k].mean(axis=0), left)

        for name, statistic in (
            ("loss", lost),
            ("rise", risen),
            ("lag", lambda k: lost(k) - risen(k)),
        ):
            row[name], row[f"{name}_error"] = statistic(seeds), jackknife(len(seeds), statistic)[1]
        rows.append(row)
    return rows


def verdict(rows):
    """By all lags that are known."""
    known = [(row["lag"], row["lag_error"]) for row in rows if math.isfinite(row["lag"])]
    if not known:
        return "no gear order to lose"
    for sign, words in ((1, "the loss follows"), (-1, "the loss precedes")):
        if all(sign * lag > CERTAIN * error for lag, error in known):
            return words
    return "neither comes first for certain"


def table(points, settings):
    rows, findings = [], []
    for friction in FRICTIONS:
        here = [p for p in points if p.cells.get("setting") == friction.name]
        runs = min((len(p.runs) for p in here), default=0)
        if len(here) < 2 or not runs:
            continue
        values = {
            name: np.array(
                [
                    [number(at(run, "measured", *path.split("."), "mean")) for run in p.runs[:runs]]
                    for p in here
                ]
            ).T
            for name, path in QUANTITIES.items()
        }
        discs = np.array([p.cells["discs"] for p in here], dtype=float)
        found = timing(discs, -values["order"], values["slip"])
        words = verdict(found)
        rows += [
            {"setting": friction.name, "seeds": runs, **row, "verdict": words} for row in found
        ]
        half = found[LEFT.index(0.5)]
        findings.append(
            f"{friction.words}: strongest gear order "
            f"{with_error(half['order'], half['order_error'])} at N = "
            f"{half['order_discs']:.0f}; half of it is lost at N = "
            f"{with_error(half['loss'], half['loss_error'])}, the slip "
            f"has half of its rise at {with_error(half['rise'], half['rise_error'])}: {words}."
        )
    return {"": list(map(row_of, points)), "_lags": rows}, findings


def draw(table):
    rows = style.read(table)
    drawing, axes = style.figure(style.PAGE, 2.6, ncols=3)
    for panel, (x, y) in zip(
        axes,
        (
            ("discs", "chain_correlation"),
            ("slip", "chain_correlation"),
            ("slip", "triangle_correlation"),
        ),
    ):
        style.zero_line(panel)
        for k, friction in enumerate(FRICTIONS):
            here = style.select(rows, setting=friction.name)
            if here:
                words = (
                    friction.words if "spheres" in friction.words else f"discs, {friction.words}"
                )
                style.curve(panel, here, x, y, linewidth=0.7, label=words, **style.look_of(k))
        panel.set(
            xlabel="number of particles $N$" if x == "discs" else "slip parameter, residents",
            ylabel="spin correlation, " + ("no triangle" if y.startswith("chain") else "triangles"),
        )
    style.legend_of_all(drawing, axes[0], ncol=3)
    style.save(drawing, table)


FIGURES = [
    Figure(
        "gear_order",
        "chapters",
        "chapter: does the gear order vanish before the slip rises?",
        points,
        table,
        draw,
    )
]
