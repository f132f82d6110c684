"""Beyond the paper: where a layer of rolling spheres is unstable, and how its core and its wall layer rotate."""

import style
import tables

PANELS = (("distance", r"distance of the centre of mass $\langle|q|\rangle/R$"),
          ("steady", r"part that turns with the swirl"),
          ("core", r"rotation of the core ($\Omega$)"),
          ("layer", r"rotation of the wall layer ($\Omega$)"))


def draw(table):
    rows = style.read(table)
    layers = list(dict.fromkeys(row["packing_fraction"] for row in rows))
    drawing, panels = style.figure(style.PAGE, 5.2, ncols=2, nrows=2)
    handles = []
    for axes, (quantity, words) in zip(panels.flat, PANELS):
        style.zero_line(axes)
        handles = []
        for k, layer in enumerate(layers):
            here = sorted(tables.select(rows, packing_fraction=layer), key=lambda row: row["amplitude"])
            handles.append(axes.errorbar(
                style.column(here, "amplitude"), style.column(here, quantity),
                yerr=style.column(here, f"{quantity}_error"), color=style.CYCLE[k], marker=style.MARKERS[k],
                elinewidth=0.7, label=rf"$\varphi = {here[0]['packing_fraction']:g}$, $N = {here[0]['discs']:g}$"))
        axes.set_ylabel(words)
        axes.set_xlabel("amplitude $A/r$")
    style.legend_of_all(drawing, handles, [handle.get_label() for handle in handles], ncol=3)
    style.save(drawing, table)
