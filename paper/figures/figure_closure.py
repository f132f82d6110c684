"""Beyond the paper: the coefficients of a micropolar fluid against the packing fraction, and what they explain."""

import style

PANELS = (("rotational_viscosity", r"rotational viscosity $\Gamma$"), ("shear_viscosity", r"shear viscosity $\eta$"),
          ("spin_diffusion", "spin diffusion $D$"))


TICKS = (0.2, 0.5, 1, 2, 5, 10, 20, 50)


def show_certain(axes, rows):
    """Limits that show all coefficients with a certain sign. Others may have errors that are many times larger."""
    ends = [0.0] + [row["coefficient"] + sign * row["coefficient_error"] for row in rows for sign in (-1, 1)
                    if abs(row["coefficient"]) > 3 * row["coefficient_error"]]
    if max(ends) > min(ends):
        margin = 0.3 * (max(ends) - min(ends))
        axes.set_ylim(min(ends) - margin, max(ends) + margin)


def draw(table):
    rows = style.read(table)
    drawing, axes = style.figure(style.PAGE, 4.2, ncols=3, nrows=2, sharex=True)
    dishes = sorted({(row["container_radius"], row["discs"]) for row in rows})
    for column, (relation, words) in enumerate(PANELS):
        upper, lower = axes[0][column], axes[1][column]
        style.zero_line(upper)
        for k, (radius, discs) in enumerate(dishes):
            here = [row | {"packing": 0.5 * (row["packing_low"] + row["packing_high"]) + 0.008 * (k - 1.5)}
                    for row in style.select(rows, container_radius=radius, discs=discs, relation=relation)]
            look = {"color": style.CYCLE[k], "marker": style.MARKERS[k], "linestyle": "-", "linewidth": 0.6,
                    "elinewidth": 0.7}
            for panel, name in ((upper, "coefficient"), (lower, "explained")):
                panel.errorbar(style.column(here, "packing"), style.column(here, name),
                               yerr=style.column(here, name + "_error"), **look,
                               label=f"$R/r$ = {radius:g}, $N$ = {discs:.0f}")
        if relation == "shear_viscosity":
            upper.set_yscale("log")
            upper.set_yticks(TICKS, [f"{tick:g}" for tick in TICKS])
            upper.minorticks_off()
        else:
            show_certain(upper, style.select(rows, relation=relation))
        upper.set_title(words)
        lower.set_ylim(0, 1.02)
        lower.set_xlabel(r"packing fraction $\varphi$")
    axes[0][0].set_ylabel(r"coefficient/$\sqrt{mT}$")
    axes[1][0].set_ylabel("share explained")
    style.legend_of_all(drawing, *axes[0][0].get_legend_handles_labels(), ncol=4)
    style.save(drawing, table)
