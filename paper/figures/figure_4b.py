"""Figure 4b: the spin of particles at the wall; the correlation of the spins of touching particles, in triangles
and outside of them; and the share of the contacts that belong to a triangle."""

import style

SETTINGS = ("smooth", "rough", "high")


def draw(table):
    rows = style.read(table)
    drawing, (spin, correlation, triangles) = style.figure(width=style.PAGE, height=2.7, ncols=3)
    style.curves_by_setting(spin, rows, "resident_spin", SETTINGS)
    spin.set_ylabel(r"spin at the wall $\langle|\omega_i|\rangle/\Omega$")
    spin.set_ylim(bottom=0)
    style.curves_by_setting(correlation, rows, "chain_correlation", SETTINGS)
    style.curves_by_setting(correlation, rows, "triangle_correlation", SETTINGS, linestyle="none", markersize=2)
    style.zero_line(correlation)
    correlation.set_ylabel("correlation of touching spins")
    correlation.set_title("lines: no triangle; dots: in triangles", fontsize=style.SMALLEST)
    style.curves_by_setting(triangles, rows, "triangles", SETTINGS)
    triangles.set_ylabel("share of contacts in triangles")
    for axes in (spin, correlation, triangles):
        axes.set_xlabel(r"number of particles $N$")
    style.legend_of_all(drawing, *spin.get_legend_handles_labels(), ncol=3)
    style.save(drawing, table)
