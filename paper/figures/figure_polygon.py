"""Beyond the paper: rotation against the number of sides of the container's path."""

import style


def draw(table):
    rows = style.read(table)
    numbers = sorted({row["discs"] for row in rows})
    drawing, axes = style.figure(height=3.4, nrows=len(numbers), sharex=True, squeeze=False)
    for k, (panel, discs) in enumerate(zip(axes[:, 0], numbers)):
        here = style.select(rows, discs=discs)
        polygons = [row for row in here if row["sides"] > 0]
        style.curve(panel, polygons, "sides", "by_time", color=style.CYCLE[k],
                    marker=style.MARKERS[k], label="polygon")
        for circle in style.select(here, sides=0.0):
            note = " (steady state not verified)" if style.not_steady([circle]) else ""
            panel.axhline(circle["by_time"], color=style.BLACK, linewidth=0.7,
                          label="circle" + note)
            panel.axhspan(circle["by_time"] - circle["by_time_error"],
                          circle["by_time"] + circle["by_time_error"], color=style.GREY,
                          alpha=0.3, linewidth=0)
        panel.set_xscale("log")
        panel.set_ylabel(rf"$\varpi/\Omega$,  $N = {discs:.0f}$")
        style.legend(panel)
    axes[-1][0].set_xticks([6, 10, 30, 100, 300])
    axes[-1][0].set_xticklabels(["6", "10", "30", "100", "300"])
    axes[-1][0].minorticks_off()
    axes[-1][0].set_xlabel("sides of the polygon $M$")
    style.save(drawing, table)
