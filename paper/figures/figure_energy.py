"""Beyond the paper: the energy without any friction, on polygons and on the circle (first seed)."""

import style


def draw(table):
    rows = style.select(style.read(table), seed=1)  # one run of each path
    drawing, axes = style.figure()
    for k, sides in enumerate(sorted({row["sides"] for row in rows}, key=lambda m: m or 1e9)):
        curve = style.select(rows, sides=sides)
        axes.plot(style.column(curve, "period"), style.column(curve, "energy"),
                  color=style.CYCLE[k], marker=style.MARKERS[k], markevery=max(len(curve) // 8, 1),
                  label=f"{sides:.0f} sides" if sides else "circle")
    axes.set_yscale("log")
    axes.set_xlabel("periods")
    axes.set_ylabel("kinetic energy ($m v_c^2$)")
    style.legend(axes)
    style.save(drawing, table)
