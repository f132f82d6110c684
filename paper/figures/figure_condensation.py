"""Beyond the paper: without disc friction the cluster condenses. The waiting time against the number of
discs, and the granular temperature before and after."""

import style


def draw(table):
    rows = style.read(table)
    drawing, (waiting, heat) = style.figure(height=3.8, nrows=2, sharex=True)
    found = [row for row in rows if row["condensed"]]
    if found:
        middles = style.column(found, "waiting")
        waiting.errorbar(style.column(found, "discs"), middles,
                         yerr=style.column(found, "waiting_error"), color=style.BLUE, marker="o",
                         elinewidth=0.7, label="mean")
        for end, marker in (("shortest", "v"), ("longest", "^")):
            waiting.plot(style.column(found, "discs"), style.column(found, end), marker,
                         color=style.GREY, markersize=3, label=end)
    waiting.set_ylim(bottom=0)
    waiting.set_ylabel("waiting time (periods)")
    style.legend(waiting, ncol=3)
    for phase, color, marker in (("before", style.RED, "s"), ("after", style.BLUE, "o")):
        name = f"{phase}_granular"
        known = [row for row in rows if row[name] == row[name]]
        heat.errorbar(style.column(known, "discs"), style.column(known, name),
                      yerr=style.column(known, f"{name}_error"), color=color, marker=marker,
                      elinewidth=0.7, label=phase)
    heat.set_yscale("log")
    heat.set_ylabel("temp. ($m v_c^2$)")
    heat.set_xlabel("number of discs $N$")
    style.legend(heat)
    style.save(drawing, table)
