"""Figure 5b: rotation of the cluster against the number of discs, for five pairs of friction
coefficients; below, the same around zero, where curves cross."""

import style
from paper_parameters import LAST_N

NEAR_ZERO = 0.1  # in Ω: upper limit of the lower panel
CURVES = [
    ("no-wall", r"no wall friction ($\mu_w = 0$)", style.GREEN, "^"),
    ("no-disc", r"no disc friction ($\mu_d = 0$)", style.ORANGE, "v"),
    ("low", r"low ($\mu = 0.1$)", style.SKY, "D"),
    ("medium", r"medium ($\mu = 0.5$)", style.BLUE, "s"),
    ("high", r"high ($\mu = 1$)", style.RED, "o"),
]


def draw(table):
    rows = style.read(table)
    drawing, (axes, near) = style.figure(height=4.6, nrows=2, sharex=True,
                                         gridspec_kw={"height_ratios": (3, 2)})
    for panel in (axes, near):
        style.zero_line(panel)
    for name, label, color, marker in CURVES:
        here = style.select(rows, setting=name)
        style.curve(axes, here, "discs", "by_event", label=label, color=color, marker=marker)
        close = [row for row in here if abs(row["by_event"]) + row["by_event_error"] <= NEAR_ZERO]
        if close:
            style.curve(near, close, "discs", "by_event", color=color, marker=marker)
    style.rotation_axes(axes, "by event")
    axes.set_xlabel("")
    style.rotation_axes(near, "by event")
    near.set_ylabel(r"$\varpi/\Omega$ near zero")
    shown = [row["by_event"] for row in rows if abs(row["by_event"]) <= NEAR_ZERO]
    near.set_ylim(max(-NEAR_ZERO, min(shown + [0]) - 0.02), NEAR_ZERO)
    last = max(row["discs"] for row in rows)
    notes = []
    if last > LAST_N:
        for panel in (axes, near):
            panel.axvspan(LAST_N + 0.5, last + 1.5, color="0.93", zorder=-1, linewidth=0)
        notes.append("grey: denser than in the paper")
    axes.set_xlim(3.5, last + 1.5)
    axes.set_ylim(bottom=min(-0.16, axes.get_ylim()[0]))
    axes.text(5, -0.12, "counterrotation", color=style.GREY, fontsize=style.SMALLEST)
    style.legend(axes)
    if style.not_steady(rows):
        notes.append("ring: steady state not verified")
    if notes:
        style.note(drawing, "; ".join(notes))
    style.save(drawing, table)
