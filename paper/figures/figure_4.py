"""Figures 4a to 4c, smooth and rough, against the number of particles. 4a: the slip parameter of
pinned particles. 4b: the spin of particles at the wall; the correlation of the spins of touching
particles, in triangles and outside of them; and the share of the contacts that belong to a
triangle. 4c: rotation of the cluster."""

from paper import style
from paper.against_n import against_n
from paper.figure import Figure
from paper.runs import HALF, HIGH, LOW, ROUGH, SMOOTH

SLIPS = (
    ("pinned_region", "pinned (SI)"),
    ("slip_resident", "resident at the wall"),
    ("cluster", "all"),
)
SLIP_WORDS = {
    "slip.pinned_region": "slip parameter of all discs pinned by the SI's criterion",
    "slip.resident": "slip parameter of discs resident at the wall",
}

SPINS = (
    ("resident_spin", "spin at the wall\n" r"$\langle|\omega_i|\rangle/\Omega$"),
    ("chain_correlation", "spin correlation,\ncontacts in no triangle"),
    ("triangle_correlation", "spin correlation,\ncontacts in triangles"),
    ("triangles", "share of contacts\nin triangles"),
)
SHOWN = ("smooth", "rough", "high")
QUANTITIES = """frustration.wall_spin frustration.pinned_wall_spin frustration.resident_spin frustration.spin_correlation
    frustration.pinned_correlation frustration.resident_correlation frustration.along_wall
    frustration.triangle_correlation frustration.chain_correlation frustration.correlation_by_impulse
    frustration.triangles frustration.coordination frustration.disc_sticking frustration.wall_sticking order.all=psi6
    order.pinned=psi6_pinned order.resident=psi6_resident order.six order.six_pinned collisions.disc_disc_rate
    collisions.disc_wall_rate rolling.rolling_share rolling.wall_rolling_share rolling.floor_slip
    rolling.contact_correlation rolling.vertical_share rolling.vertical_power"""
SPIN_WORDS = {
    "frustration.pinned_wall_spin": "spin of discs at the wall that are pinned by the SI's "
    "criterion, in Ω",
    "frustration.resident_spin": "spin of discs resident at the wall, in Ω",
    "frustration.spin_correlation": "spin correlation of neighbours",
    "frustration.correlation_by_impulse": "spin correlation of colliding discs, weighted by "
    "impulse",
    "frustration.triangles": "share of contacts in triangles",
}


def draw_slip(table):
    rows = style.read(table)
    drawing, panels = style.figure(width=style.PAGE, height=2.6, ncols=len(SLIPS), sharey=True)
    for axes, (quantity, title) in zip(panels, SLIPS):
        style.curves_by_setting(axes, rows, quantity)
        axes.axhline(1, color=style.GREY, linewidth=0.6, linestyle="--", zorder=0)
        axes.set(title=title, xlabel=r"number of particles $N$")
    panels[0].set_ylabel("slip parameter $s$")
    style.legend_of_all(drawing, panels[0], ncol=5)
    style.save(drawing, table)


def draw_spins(table):
    rows = style.read(table)
    drawing, panels = style.figure(width=style.PAGE, height=2.4, ncols=len(SPINS))
    panels[2].sharey(panels[1])
    for axes, (quantity, title) in zip(panels, SPINS):
        style.curves_by_setting(axes, rows, quantity, SHOWN)
        axes.set(title=title, xlabel=r"number of particles $N$")
        style.zero_line(axes)
    style.legend_of_all(drawing, panels[0], ncol=3)
    style.save(drawing, table)


def draw_rotation(table):
    rows = style.read(table)
    drawing, axes = style.figure(height=2.9)
    style.zero_line(axes)
    style.curves_by_setting(axes, rows, "mean_by_time", ("smooth", "rough", "low", "high"))
    style.rotation_axes(axes, of="particles")
    style.legend(axes)
    style.save(drawing, table)


FIGURES = [
    Figure(
        "4a",
        "paper",
        "slip parameter of pinned particles, smooth and rough",
        *against_n(
            (LOW, HIGH, SMOOTH, ROUGH, HALF),
            "slip.cluster slip.pinned_region slip.resident=slip_resident",
            SLIP_WORDS,
        ),
        draw_slip,
    ),
    Figure(
        "4b",
        "paper",
        "spin of pinned particles at the wall, and frustration",
        *against_n((HIGH, SMOOTH, ROUGH, HALF), QUANTITIES, SPIN_WORDS),
        draw_spins,
    ),
    Figure(
        "4c",
        "paper",
        "rotation against N, smooth and rough",
        *against_n((LOW, HIGH, SMOOTH, ROUGH, HALF), with_crossings=True),
        draw_rotation,
    ),
]
