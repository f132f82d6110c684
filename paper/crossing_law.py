"""A law for N_c, fixed before the runs that test it: a friction part and a spin part. It fails; the
table says by how much."""

import os

from paper import tables
from paper.paper_parameters import AMPLITUDE, CONTAINER_RADIUS

PAPER = CONTAINER_RADIUS, AMPLITUDE / CONTAINER_RADIUS  # R/r and A/R


def law(mu, inertia, cannot_spin, container_radius):
    """N_c in a container of this radius, in radii of a disc. It grows with the area."""
    spins = 0 if cannot_spin else 45.1 * inertia**-0.13
    return (container_radius / PAPER[0]) ** 2 * ((26.4 * mu**-0.44) ** 3 + spins**3) ** (1 / 3)


def law_row(mu, inertia, cannot_spin, radius, ratio, found, error):
    expected = law(mu, inertia, cannot_spin, radius)
    return {
        "mu": mu,
        "inertia": inertia,
        "cannot_spin": cannot_spin,
        "container_radius": radius,
        "amplitude_ratio": ratio,
        "crossing": found,
        "crossing_error": error,
        "law": expected,
        "ratio": expected / found,
    }


def law_rows(crossings, out):
    """The law at the crossings of this figure, and at those of discs with μ = 1 in other dishes, if
    figures "size" and "amplitude" are in this folder: the smallest N at which the direction of the
    rigid rate changes. The law has the same N_c for all amplitudes."""
    here = [
        law_row(
            c["mu_disc"], c["inertia"], c["cannot_spin"], *PAPER, c["crossing"], c["crossing_error"]
        )
        for c in crossings
        if c["body"] == "discs"
        and c["mu_disc"] == c["mu_wall"]
        and c["cannot_spin"] in (0, 1)
        and c["crosses"] == 1
    ]
    changes = [
        change
        for name in ("size", "amplitude")
        for change in tables.companion(os.path.join(out, f"figure_{name}.csv"), "_changes")
        if change["direction"] == "counterrotation"
    ]
    first = {}
    for change in sorted(changes, key=lambda change: change["packing_fraction"]):
        first.setdefault((change["container_radius"], change["amplitude_ratio"]), change)
    first.pop(PAPER, None)
    return here + [
        law_row(
            1,
            10,
            0,
            radius,
            ratio,
            change["packing_fraction"] * radius**2,
            change["packing_fraction_error"] * radius**2,
        )
        for (radius, ratio), change in sorted(first.items())
    ]
