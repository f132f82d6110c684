"""Figure 4b: the spin of particles at the wall; the correlation of the spins of touching particles, in triangles
and outside of them; and the share of the contacts that belong to a triangle."""

import style
from against_n import against_n
from figure import Figure
from runs import HALF, HIGH, ROUGH, SMOOTH

PANELS = (("resident_spin", "spin at the wall\n" r"$\langle|\omega_i|\rangle/\Omega$"),
          ("chain_correlation", "spin correlation,\ncontacts in no triangle"),
          ("triangle_correlation", "spin correlation,\ncontacts in triangles"),
          ("triangles", "share of contacts\nin triangles"))
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
    drawing, panels = style.figure(width=style.PAGE, height=2.4, ncols=len(PANELS))
    panels[2].sharey(panels[1])
    for axes, (quantity, title) in zip(panels, PANELS):
        style.curves_by_setting(axes, rows, quantity, SETTINGS)
        axes.set_title(title)
        axes.set_xlabel(r"number of particles $N$")
        style.zero_line(axes)
    style.legend_of_all(drawing, *panels[0].get_legend_handles_labels(), ncol=3)
    style.save(drawing, table)


FIGURES = [Figure("4b", "paper", "spin of pinned particles at the wall, and frustration",
                  *against_n((HIGH, SMOOTH, ROUGH, HALF), QUANTITIES, WORDS), draw)]
