"""Figure 4b: the spin of particles at the wall; the correlation of the spins of touching particles, in triangles
and outside of them; and the share of the contacts that belong to a triangle."""

import style
from against_n import against_n
from figure import Figure
from runs import HALF, HIGH, ROUGH, SMOOTH

SETTINGS = ("smooth", "rough", "high")
QUANTITIES = """frustration.wall_spin frustration.pinned_wall_spin frustration.resident_spin frustration.spin_correlation
    frustration.pinned_correlation frustration.resident_correlation frustration.along_wall
    frustration.triangle_correlation frustration.chain_correlation frustration.correlation_by_impulse
    frustration.triangles frustration.coordination frustration.disc_sticking frustration.wall_sticking order.all=psi6
    order.pinned=psi6_pinned order.resident=psi6_resident order.six order.six_pinned collisions.disc_disc_rate
    collisions.disc_wall_rate rolling.rolling_share rolling.wall_rolling_share rolling.floor_slip
    rolling.contact_correlation rolling.vertical_share rolling.vertical_power"""
WORDS = {"frustration.pinned_wall_spin": "spin of discs at the wall that are pinned by the SI's criterion, in Ω",
         "frustration.resident_spin": "spin of discs resident at the wall, in Ω",
         "frustration.spin_correlation": "spin correlation of neighbours",
         "frustration.correlation_by_impulse": "spin correlation of colliding discs, weighted by impulse",
         "frustration.triangles": "share of contacts in triangles"}


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


FIGURES = [Figure("4b", "paper", "spin of pinned particles at the wall, and frustration",
                  *against_n((HIGH, SMOOTH, ROUGH, HALF), QUANTITIES, WORDS), draw)]
