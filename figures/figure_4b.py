"""Figure 4b: the spin of the discs at the wall, frustration of the contacts, and hexatic order of the
packing.

    /usr/bin/python3 figures/figure_4b.py out/figure_4b.csv
"""

import style

PANELS = (
    (r"spin $\langle|\omega_i|\rangle/\Omega$", (
        ("resident_spin", "resident at the wall", style.RED, "o", {}),
        ("pinned_wall_spin", "pinned (SI), at the wall", style.RED, "o",
         {"fillstyle": "none", "linestyle": "--"}),
        ("wall_spin", "all at the wall", style.BLUE, "s", {"fillstyle": "none"}))),
    ("correlation of spins", (
        ("resident_correlation", "one resident", style.RED, "o", {}),
        ("along_wall", "both resident", style.ORANGE, "P", {}),
        ("pinned_correlation", "both pinned (SI)", style.RED, "o",
         {"fillstyle": "none", "linestyle": "--"}),
        ("correlation_by_impulse", "collisions, by impulse", style.BLACK, "v", {}),
        ("spin_correlation", "all neighbours", style.BLUE, "s", {"fillstyle": "none"}))),
    (r"share, or $\psi_6$", (
        ("triangles", "contacts in triangles", style.GREEN, "^", {}),
        ("disc_sticking", "sticking, disc–disc", style.PINK, "D", {}),
        ("wall_sticking", "sticking, disc–wall", style.ORANGE, "P", {}),
        ("psi6_resident", r"$\psi_6$, resident", style.RED, "o", {}),
        ("psi6_pinned", r"$\psi_6$, pinned (SI)", style.RED, "o",
         {"fillstyle": "none", "linestyle": "--"}))),
)


def main():
    table = style.table_from_arguments("figure_4b")
    rows = style.read(table)
    drawing, panels = style.figure(width=style.PAGE, height=3.0, ncols=len(PANELS))
    for axes, (label, curves) in zip(panels, PANELS):
        for name, words, color, marker, look in curves:
            style.curve(axes, rows, "discs", name, color=color, marker=marker, label=words, **look)
        axes.set_ylabel(label)
        axes.set_xlabel(r"number of discs $N$")
        style.legend(axes, ncol=1)
    panels[0].set_ylim(bottom=0)
    style.zero_line(panels[1])
    style.save(drawing, table)


if __name__ == "__main__":
    main()
