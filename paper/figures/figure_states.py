"""Motion of the discs in the M-frame, with both kinds of friction and with one of them absent."""

import style
from paper_parameters import CONTAINER_RADIUS, OMEGA

SETTINGS = (("high", "both coefficients 1", style.RED), ("no-wall", r"$\mu_w = 0$", style.GREEN),
            ("no-disc", r"$\mu_d = 0$", style.ORANGE))


def draw(table):
    rows = style.read(table)
    numbers = sorted({row["discs"] for row in rows})
    drawing, (speed, heat) = style.figure(height=2.5, ncols=2)
    per_speed = 1 / (2 * OMEGA ** 2 * CONTAINER_RADIUS)  # |Coriolis force| = 2 Ω v, in units of ΩR
    for k, (setting, label, color) in enumerate(SETTINGS):
        here = style.select(rows, setting=setting)
        for axes, name, factor in ((speed, "coriolis", per_speed), (heat, "granular", 1.0)):
            known = [row for row in here if row[name] == row[name]]
            axes.bar([numbers.index(row["discs"]) + 0.27 * (k - 1) for row in known],
                     [row[name] * factor for row in known], 0.25, color=color, label=label)
            axes.errorbar([numbers.index(row["discs"]) + 0.27 * (k - 1) for row in known],
                          [row[name] * factor for row in known],
                          yerr=[row[name + "_error"] * factor for row in known],
                          color=style.BLACK, linestyle="none", elinewidth=0.7)
    for axes in (speed, heat):
        axes.set_xticks(range(len(numbers)), [f"{n:.0f}" for n in numbers])
        axes.set_xlabel("number of discs $N$")
        style.zero_line(axes)
    speed.set_title(r"mean speed ($\Omega R$)")
    heat.set_title("granular temp. ($m v_c^2$)")
    style.legend_of_all(drawing, *speed.get_legend_handles_labels(), ncol=3)
    style.note_not_steady(drawing, rows)
    style.save(drawing, table)
