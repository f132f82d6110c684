"""Motion of the discs in the M-frame, with both kinds of friction and with one of them absent."""

from paper import style
from paper.against_n import findings_of
from paper.curves import rows_of
from paper.figure import Figure
from paper.paper_parameters import CONTAINER_RADIUS, COUNTERROTATING_N, OMEGA, ROTATING_N
from paper.runs import HIGH, NO_DISC, NO_WALL, measured_point, settled_point

SETTINGS = (
    ("high", "both coefficients 1", style.RED),
    ("no-wall", r"$\mu_w = 0$", style.GREEN),
    ("no-disc", r"$\mu_d = 0$", style.ORANGE),
)
FRICTIONS = (HIGH, NO_WALL, NO_DISC)
QUANTITIES = """temperature.granular temperature.of_the_spin centre.coriolis order.all=psi6 residence.share=residence_share
    frustration.coordination frustration.triangles"""


def points(settings):
    """Without disc friction in the steady state; the paper's 10^6 events cover the transient."""
    return [
        (measured_point if friction.mu_disc else settled_point)(settings, friction, discs)
        for friction in FRICTIONS
        for discs in (ROTATING_N, COUNTERROTATING_N)
    ]


def table(points, settings):
    words = {"temperature.granular": "granular temperature, in m v²"}
    return {"": rows_of(points, QUANTITIES.split())}, findings_of(points, FRICTIONS, words)


def draw(table):
    rows = style.read(table)
    numbers = style.distinct(rows, "discs")
    drawing, (speed, heat) = style.figure(height=2.5, ncols=2)
    per_speed = 1 / (2 * OMEGA**2 * CONTAINER_RADIUS)  # |Coriolis force| = 2 Ω v, in units of ΩR
    for k, (setting, label, color) in enumerate(SETTINGS):
        here = style.select(rows, setting=setting)
        for axes, name, factor in ((speed, "coriolis", per_speed), (heat, "granular", 1.0)):
            known = [row for row in here if row[name] == row[name]]
            axes.bar(
                [numbers.index(row["discs"]) + 0.27 * (k - 1) for row in known],
                [row[name] * factor for row in known],
                0.25,
                color=color,
                label=label,
            )
            axes.errorbar(
                [numbers.index(row["discs"]) + 0.27 * (k - 1) for row in known],
                [row[name] * factor for row in known],
                yerr=[row[name + "_error"] * factor for row in known],
                color=style.BLACK,
                linestyle="none",
                elinewidth=0.7,
            )
    for axes in (speed, heat):
        axes.set_xticks(range(len(numbers)), [f"{n:.0f}" for n in numbers])
        axes.set_xlabel("number of discs $N$")
        style.zero_line(axes)
    speed.set_title(r"mean speed ($\Omega R$)")
    heat.set_title("granular temp. ($m v_c^2$)")
    style.legend_of_all(drawing, speed, ncol=3)
    style.note_not_steady(drawing, rows)
    style.save(drawing, table)


FIGURES = [
    Figure(
        "states",
        "beyond",
        "motion in the M-frame, without disc or wall friction",
        points,
        table,
        draw,
    )
]
