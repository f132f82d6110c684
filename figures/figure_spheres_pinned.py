"""Spheres that roll: the slip parameter and the spin of those at the wall, and how much spheres
prevent each other from rolling.

    /usr/bin/python3 figures/figure_spheres_pinned.py out/figure_spheres_pinned.csv
"""

import style

SI = {"fillstyle": "none", "linestyle": "--", "linewidth": 0.6}
PANELS = (
    ("slip parameter $s$", (("slip_resident", {}), ("pinned_region", SI))),
    (r"spin $|\omega_z|/\Omega$", (("resident_spin", {}), ("pinned_wall_spin", SI))),
    ("share that rolls", (("rolling_share", {}),)),
    ("correlation of rolling", (("contact_correlation", {}),)),
)


def main():
    table = style.table_from_arguments("figure_spheres_pinned")
    rows = style.read(table)
    coefficients = sorted({row["mu"] for row in rows})
    drawing, panels = style.figure(width=style.PAGE, height=4.4, nrows=2, ncols=2, sharex=True)
    for axes, (label, curves) in zip(panels.flat, PANELS):
        for k, mu in enumerate(coefficients):
            for name, look in curves:
                style.curve(axes, style.select(rows, mu=mu), "discs", name, color=style.CYCLE[k],
                            marker=style.MARKERS[k], **look)
        axes.set_ylabel(label)
    for axes in panels[-1]:
        axes.set_xlabel(r"number of spheres $N$")
    panels[0][0].axhline(1, color=style.GREY, linewidth=0.6, linestyle="--", zorder=0)
    handles = [panels[0][0].plot([], [], color=style.CYCLE[k], marker=style.MARKERS[k],
                               label=rf"$\mu = {mu:g}$")[0] for k, mu in enumerate(coefficients)]
    handles += [panels[0][0].plot([], [], color=style.GREY, marker="o", label=words, **look)[0]
              for words, look in (("resident at the wall", {}), ("pinned (SI)", SI))]
    style.legend_of_all(drawing, handles, [mark.get_label() for mark in handles], ncol=4)
    style.save(drawing, table)


if __name__ == "__main__":
    main()
