"""Spheres that roll: the slip parameter of the pinned, spins at the wall, and how far the spheres
keep each other from rolling.

    /usr/bin/python3 figures/figure_spheres_pinned.py out/figure_spheres_pinned.csv
"""

import style

PANELS = (
    ("pinned_region", "slip parameter $s$, pinned"),
    ("pinned_wall_spin", r"spin $|\omega_z|/\Omega$, pinned"),
    ("rolling_share", "share that rolls"),
    ("contact_correlation", "correlation of rolling"),
)


def main():
    table = style.table_from_arguments("figure_spheres_pinned")
    rows = style.read(table)
    drawing, panels = style.figure(width=style.PAGE, height=4.4, nrows=2, ncols=2, sharex=True)
    for axes, (name, label) in zip(panels.flat, PANELS):
        for k, mu in enumerate(sorted({row["mu"] for row in rows})):
            style.curve(axes, style.select(rows, mu=mu), "discs", name, color=style.CYCLE[k],
                        marker=style.MARKERS[k], label=rf"$\mu = {mu:g}$")
        axes.set_ylabel(label)
    for axes in panels[-1]:
        axes.set_xlabel(r"number of spheres $N$")
    panels[0][0].axhline(1, color=style.GREY, linewidth=0.6, linestyle="--", zorder=0)
    style.legend(panels[0][0])
    style.save(drawing, table)


if __name__ == "__main__":
    main()
