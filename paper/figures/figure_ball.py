"""The simulated minimal model: spin of one large disc in a swirled container against the friction
coefficient of the wall, for three radii. Bounces are elastic, or inelastic so that the disc stays
at the wall."""

import itertools

from paper import style
from paper.combine import number
from paper.curves import with_error
from paper.engine import swirl
from paper.figure import Figure
from paper.paper_parameters import CONTAINER_RADIUS
from paper.runs import lengths
from paper.study import Point

BOUNCES = ((0.5, "full", "-"), (1.0, "none", ":"))
REPORTED_RADIUS = 5.0


def ball_run(parameters):
    """γ from the spin, and the direction of the ball about C in the M-frame, in degrees."""
    run = swirl.run(series=True, measure="centre", **parameters)
    spins = run.series["spin"][run.series["counted"] > 0]
    gamma = swirl.series_mean([1 - spin for spin in spins])
    theta = run.measured["centre"]["theta"]
    return {
        "gamma": (gamma.mean, gamma.error, gamma.effective_samples),
        "theta": (theta.mean, theta.error),
    }


def points(settings):
    """The ball is a solid disc. Its bounces on the wall are elastic as in the paper, or lose half
    of the normal velocity, after which it stays at the wall."""
    made = []
    for radius in (4.3, 5.0, 7.0):
        for restitution in (0.5, 1.0):
            for mu in (0.0, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0):
                run = {
                    "discs": 1,
                    "radius": radius,
                    "inertia": 0.5 * radius * radius,
                    "mu": mu,
                    "restitution": restitution,
                    **lengths(settings, (200, 5), (300, 5)),
                }
                made.append(
                    Point(
                        settings,
                        f"ball_R{radius:g}_mu{mu:g}_e{restitution:g}",
                        settings.seeds,
                        run,
                        work=ball_run,
                        cells={
                            "ball_radius": radius,
                            "container_radius": CONTAINER_RADIUS,
                            "mu": mu,
                            "restitution": restitution,
                        },
                    )
                )
    return made


def table(points, settings):
    rows, findings = [], []
    for point in points:
        runs, cells = point.runs, point.cells
        if not runs:
            continue
        gamma, error, _, scatter, _ = swirl.mean(
            *zip(*(run["gamma"][:2] for run in runs)),
            effective_samples=[number(run["gamma"][2]) for run in runs],
        )
        theta = swirl.mean(*zip(*(map(number, run["theta"]) for run in runs)), directions=True)
        no_slip = CONTAINER_RADIUS / cells["ball_radius"]
        rows.append(
            {
                **cells,
                "gamma": gamma,
                "gamma_error": error,
                "gamma_no_slip": no_slip,
                "slip": gamma / no_slip,
                "slip_error": error / no_slip,
                "theta": theta[0],
                "theta_error": theta[1],
                "seeds": settings.seeds,
                "scatter": scatter,
            }
        )
        if cells["ball_radius"] == REPORTED_RADIUS and cells["mu"] in (0, 1):
            findings.append(
                f"A disc of radius {REPORTED_RADIUS:g}, μ = {cells['mu']:g}, e = "
                f"{cells['restitution']:g}: γ = {with_error(gamma, error)} (γ_c = {no_slip:.3f})."
            )
    return {"": rows}, findings


def draw(table):
    rows = style.read(table)
    drawing, axes = style.figure(height=3.0)
    steps = style.distinct(rows, "mu")
    handles = []
    styles = ((style.BLUE, "o"), (style.GREEN, "s"), (style.RED, "^"))
    for (color, marker), radius in zip(styles, style.distinct(rows, "ball_radius")):
        for restitution, fill, line in BOUNCES:
            curve = [
                row | {"step": steps.index(row["mu"])}
                for row in sorted(
                    style.select(rows, ball_radius=radius, restitution=restitution),
                    key=lambda row: row["mu"],
                )
            ]
            style.curve(
                axes,
                curve,
                "step",
                "gamma",
                color=color,
                marker=marker,
                fillstyle=fill,
                linestyle=line,
            )
        handles.append(axes.plot([], [], color=color, marker=marker, label=f"radius {radius:g}")[0])
        axes.axhline(
            curve[0]["gamma_no_slip"], color=color, linewidth=0.6, linestyle="--", zorder=0
        )
    axes.axhline(1, color=style.GREY, linewidth=0.6, zorder=0)
    axes.set_xticks(range(len(steps)), [f"{mu:g}" for mu in steps])
    axes.set(
        xlabel=r"friction coefficient of the wall $\mu$", ylabel=r"$\gamma = |\varpi_M|/\Omega$"
    )
    bounces = [
        axes.plot(
            [],
            [],
            color=style.GREY,
            marker="o",
            fillstyle=fill,
            linestyle=line,
            label=f"$e = {restitution:g}$",
        )[0]
        for restitution, fill, line in BOUNCES
    ]
    # By columns: the radii first, below them the restitutions.
    style.legend(
        axes,
        ncol=len(handles),
        handles=[mark for pair in itertools.zip_longest(handles, bounces) for mark in pair if mark],
    )
    style.note(
        drawing,
        r"dashed: $\gamma_c = R_{\rm container}/R_{\rm ball}$; above 1 it " "counterrotates",
    )
    style.save(drawing, table)


FIGURES = [
    Figure(
        "ball", "beyond", "the minimal model, simulated: γ of one large disc", points, table, draw
    )
]
