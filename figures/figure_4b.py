"""Figure 4b: the spin of the pinned discs at the wall, and how frustrated the contacts are.

    /usr/bin/python3 figures/figure_4b.py out/figure_4b.csv
"""

import style


def main():
    table = style.table_from_arguments("figure_4b")
    rows = style.read(table)
    drawing, (spin, contacts) = style.figure(height=4.2, nrows=2, sharex=True)
    style.curve(spin, rows, "discs", "pinned_wall_spin", color=style.RED, marker="o",
                label="pinned discs at the wall")
    style.curve(spin, rows, "discs", "wall_spin", color=style.BLUE, marker="s", fillstyle="none",
                label="all discs at the wall")
    spin.set_ylabel(r"spin $\langle|\omega_i|\rangle/\Omega$")
    spin.set_ylim(bottom=0)
    style.legend(spin)
    style.zero_line(contacts)
    style.curve(contacts, rows, "discs", "spin_correlation", color=style.BLACK, marker="v",
                label="spins, neighbours")
    style.curve(contacts, rows, "discs", "triangles", color=style.GREEN, marker="^",
                label="contacts in triangles")
    style.curve(contacts, rows, "discs", "disc_sticking", color=style.PINK, marker="D",
                label="sticking, disc–disc")
    style.curve(contacts, rows, "discs", "wall_sticking", color=style.ORANGE, marker="P",
                label="sticking, disc–wall")
    style.curve(contacts, rows, "discs", "pinned_correlation", color=style.BLUE, marker="<",
                label="spins, pinned neighbours")
    style.legend(contacts)
    contacts.set_xlabel(r"number of discs $N$")
    style.save(drawing, table)


if __name__ == "__main__":
    main()
