"""Figure 5b: rotation of the cluster against the number of discs, for five pairs of friction
coefficients; below, the same around zero, where curves cross."""

import math

from paper import style, tables
from paper.combine import at, number, too_short_to_average
from paper.curves import curve_tables, curves_by, lowest_of, with_error
from paper.engine import swirl
from paper.figure import Figure
from paper.paper_parameters import LAST_N
from paper.runs import (
    FRICTION_OF_5B,
    HIGH,
    NO_DISC,
    NO_WALL,
    cells_of,
    dense_point,
    length_of,
    numbers_beyond,
    numbers_of_discs,
    paper_run,
    point,
    settled_run,
    sparse_numbers,
)
from paper.study import Point

WITHOUT = {friction.name: friction for friction in (NO_WALL, NO_DISC)}
NEAR_ZERO = 0.1  # in Ω: upper limit of the lower panel
CURVES = [
    ("no-wall", r"no wall friction ($\mu_w = 0$)", style.GREEN, "^"),
    ("no-disc", r"no disc friction ($\mu_d = 0$)", style.ORANGE, "v"),
    ("low", r"low ($\mu = 0.1$)", style.SKY, "D"),
    ("medium", r"medium ($\mu = 0.5$)", style.BLUE, "s"),
    ("high", r"high ($\mu = 1$)", style.RED, "o"),
]


def points(settings):
    """Beyond the paper's last N: whether ϖ rises again after its minimum (high friction), and
    whether a curve that does not cross up to there crosses later."""
    return [
        point(settings, friction, discs)
        for friction in FRICTION_OF_5B
        for discs in numbers_of_discs(settings)
    ] + [
        (dense_point if friction == HIGH else point)(settings, friction, discs)
        for friction in FRICTION_OF_5B
        for discs in numbers_beyond(settings)
    ]


def steady_points(settings):
    made = []
    for friction in FRICTION_OF_5B:
        for discs in sparse_numbers(settings) if settings.quick else numbers_of_discs(settings):
            run = settled_run(settings, friction, discs)
            made.append(
                Point(
                    settings,
                    f"steady_{friction.name}_N{discs}_{length_of(run)}",
                    settings.seeds_beyond,
                    run,
                    cells=cells_of(friction, discs),
                )
            )
    return made


def start_points(settings):
    """The paper's protocol for the curves without one kind of friction: averages over all events,
    from the start on."""
    return [
        point(
            settings,
            friction,
            discs,
            run=paper_run(settings, friction, discs) | {"warmup": 0},
            prefix="start_",
        )
        for friction in (NO_WALL, NO_DISC)
        for discs in numbers_of_discs(settings)
    ]


def between_seeds(point):
    """The mean over the seeds with the error between them. The error within a run counts its
    transient as noise, but the transient is part of what is averaged here."""
    found = swirl.mean(
        [
            number(at(run, "rotation", "mean_by_event", "mean"))
            for run in point.runs
            if not too_short_to_average(run)
        ]
    )
    return {"mean": float(found[0]), "error": float(found[1])}


def start_table(points, settings):
    for point in points:
        if at(point.result, "rotation", "mean_by_event"):
            point.result["rotation"]["mean_by_event"] |= between_seeds(point)
    curves = curves_by(points, "setting", "mean_by_event")
    return curve_tables(points, curves), [
        f"{WITHOUT[curve.name].words}: {curve.sentence()}" for curve in curves
    ]


def compare_rates(curve):
    """The two rates differ at every N: discs near the centre of mass, whose r² is small, have the
    largest weight in the paper's ϖ and the smallest in the rotation of the rigid body."""
    known = [p for p in curve.points if math.isfinite(p[1])]
    if not known:
        return "No run with the paper's friction has an average."
    rigid = {p[0]: p for p in curve.by_rate["rigid_by_event"]}

    def both(p):
        return (
            f"{with_error(*p[1:])} at N = {p[0]:.0f} (rigid body: {with_error(*rigid[p[0]][1:])})"
        )

    lowest, last = lowest_of(known), known[-1]
    return (
        "The paper's ϖ/Ω, the mean over the discs, compared with that of the rigid body that fits "
        "the velocities best: "
        f"the lowest is {both(lowest)}{', which is the last' if last == lowest else '; the last is ' + both(last)}."
    )


def friction_words(friction):
    return f"{friction.words} (μ_d = {friction.mu_disc:g}, μ_w = {friction.mu_wall:g})"


def table(points, settings):
    curves, findings = (
        curves_by(points, "setting", "mean_by_event"),
        [],
    )  # by event, as in the paper's figure
    for curve, friction in zip(curves, FRICTION_OF_5B):
        findings.append(f"{friction_words(friction)}: {curve.sentence()}")
        if friction == HIGH:
            findings.append(compare_rates(curve))
    return curve_tables(points, curves), findings


def draw(table):
    rows, crossings = style.read(table), tables.companion(table, "_crossings")
    drawing, (axes, near) = style.figure(
        height=4.8, nrows=2, sharex=True, gridspec_kw={"height_ratios": (3, 2)}
    )
    last = max(row["discs"] for row in rows)
    for name, label, color, marker in CURVES:
        here = style.select(rows, setting=name)
        close = [
            row
            for row in here
            if abs(row["mean_by_event"]) + row["mean_by_event_error"] <= NEAR_ZERO
        ]
        if close:
            style.curve(near, close, "discs", "mean_by_event", color=color, marker=marker)
        for row in style.select(crossings, curve=name):
            if math.isfinite(row["crossing"]):
                near.axvline(row["crossing"], color=color, linewidth=0.8, linestyle="--", zorder=0)
                label += ", dashed: $N_c$"  # its number and error are in the report and in the table of the crossings
        style.curve(axes, here, "discs", "mean_by_event", label=label, color=color, marker=marker)
    for panel in (axes, near):
        style.zero_line(panel)
        style.rotation_axes(panel, "by event")
        if last > LAST_N:
            panel.axvspan(LAST_N + 0.5, last + 1.5, color="0.93", zorder=-1, linewidth=0)
    if last > LAST_N:
        style.note(drawing, "grey: denser than in the paper")
    axes.set_xlabel("")
    near.set_ylabel(r"$\varpi/\Omega$ near zero")
    shown = [row["mean_by_event"] for row in rows if abs(row["mean_by_event"]) <= NEAR_ZERO]
    near.set_ylim(max(-NEAR_ZERO, min(shown + [0]) - 0.02), NEAR_ZERO)
    axes.set_xlim(3.5, last + 1.5)
    axes.set_ylim(bottom=min(-0.16, axes.get_ylim()[0]))
    axes.text(5, -0.12, "counterrotation", color=style.GREY, fontsize=style.SMALLEST)
    style.legend(axes, ncol=1)
    style.save(drawing, table)


FIGURES = [
    Figure(
        "5b",
        "paper",
        "rotation against N, for five sets of friction coefficients",
        points,
        table,
        draw,
    ),
    Figure(
        "5b-start",
        "beyond",
        "beyond the paper: Figure 5b without one friction, all events",
        start_points,
        start_table,
        draw,
    ),
    Figure(
        "5b-steady",
        "beyond",
        "beyond the paper: Figure 5b in the steady state",
        steady_points,
        table,
        draw,
    ),
]
