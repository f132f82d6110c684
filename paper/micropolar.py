"""The relations of a micropolar fluid, fitted to measured fields (Dahler, Scriven 1961; Tsai, Ye,
Gollub, Lubensky 2005, doi:10.1103/PhysRevLett.94.214301):

    torque of the stress   σ_yx − σ_xy = Γ √(mT) (curl u − 2ω)
    deviator of σ          = 2 √(mT) η e,  e the deviator of the strain rate
    couple stress          C = D √(mT) ∇ω
    pressure               p = k p_H,  p_H that of smooth elastic discs (Henderson 1975,
                           doi:10.1080/00268977500102511)

Rigid discs have no other scale of time than √(m/T), so the coefficients depend on the packing
fraction only, as long as the spins are as hot as the motion.

One measured number is no coefficient of a fluid: the angle α by which the principal axes of the
stress are turned against those of the strain rate. With e* = e turned by 45°, (e_xx, e_xy) →
(−e_xy, e_xx), the fit a e + b e* has tan 2α = b/a. It depends on the amplitude of the swirl at the
same packing fraction (docs/results/continuum.md), so no odd viscosity and no normal-stress
difference of a fluid are derived from it.

The fit is y = Σ k_a x_a at every point where the packing fraction, a mean over the seeds, is in a
range and no contact with the wall contributes. Both x and y have errors, which are correlated
within a run. So only products of two different seeds count: k = M⁻¹ v with M_ab = Σ x_a,i x_b,j and
v_a = Σ x_a,i y_j over points and pairs of seeds i ≠ j; noise does not change their expectation. The
share of the square of the mean field y that is explained is v·k / Σ y_i y_j. Errors: jackknife over
the seeds. Limits: four seeds; points with a missing value in any seed are omitted.
"""

import dataclasses
import math

import numpy as np

from paper.hard_discs import pressure_ratio
from paper.jackknife import jackknife


# --- Relations ------------------------------------------------------------------------------------


def speed(f):
    """√(T/m) for discs of mass 1."""
    return np.sqrt(f["temperature"])


def strain(f):
    return 2 * speed(f) * f["strain_xx"], 2 * speed(f) * f["strain_xy"]


def turned(f):
    xx, xy = strain(f)
    return -xy, xx


def deviator(f):
    stress = {ab: f[f"kinetic_{ab}"] + f[f"collisional_{ab}"] for ab in ("xx", "xy", "yy")}
    return 0.5 * (stress["xx"] - stress["yy"]), 0.5 * (
        stress["xy"] + f["kinetic_xy"] + f["collisional_yx"]
    )


@dataclasses.dataclass(frozen=True)
class Relation:
    """`terms` and `field` return one component or two of x_a and y; `shown` is the number of all
    coefficients."""

    name: str
    words: str
    explains: str
    terms: tuple
    field: object
    shown: object = lambda k: k[0]


RELATIONS = (
    Relation(
        "rotational_viscosity",
        "rotational viscosity Γ",
        "torque of the stress",
        (lambda f: (speed(f) * (f["vorticity"] - 2 * f["spin"]),),),
        lambda f: (f["torque"],),
    ),
    Relation("shear_viscosity", "shear viscosity η", "deviator of the stress", (strain,), deviator),
    Relation(
        "spin_diffusion",
        "spin diffusion D",
        "couple stress",
        (lambda f: tuple(speed(f) * f[f"spin_gradient_{a}"] for a in "xy"),),
        lambda f: tuple(f[f"kinetic_couple_{a}"] + f[f"collisional_couple_{a}"] for a in "xy"),
    ),
    Relation(
        "pressure",
        "pressure relative to smooth elastic discs",
        "pressure",
        # Discs of radius 1 have the number density φ/π.
        (lambda f: (f["packing"] / math.pi * f["temperature"] * pressure_ratio(f["packing"]),),),
        lambda f: (f["pressure"],),
    ),
    Relation(
        "angle",
        "angle of the stress against the strain rate",
        "deviator of the stress, with η",
        (strain, turned),
        deviator,
        lambda k: math.degrees(0.5 * math.atan2(k[1], k[0])),
    ),
)


@dataclasses.dataclass
class Fit:
    points: int
    coefficient: tuple = (math.nan, math.nan)  # and its error
    explained: tuple = (math.nan, math.nan)


def fit_relation(seeds, relation, low, high, reach):
    """`seeds`: {column: array over the points of the grid} of each seed; `reach`: largest distance
    from C."""
    if not seeds:
        return Fit(0)
    packing = sum(f["packing"] / len(seeds) for f in seeds)
    square = seeds[0]["x"] ** 2 + seeds[0]["y"] ** 2
    chosen = (packing >= low) & (packing < high) & (square < reach * reach)
    here = [{name: column[chosen] for name, column in f.items()} for f in seeds]
    # [seed, term, component, point] and [seed, component, point]
    terms = np.array([[term(f) for term in relation.terms] for f in here])
    field = np.array([relation.field(f) for f in here])
    known = np.isfinite(terms).all(axis=(0, 1, 2)) & np.isfinite(field).all(axis=(0, 1))
    terms, field = terms[..., known], field[..., known]
    found = fit(terms.reshape(*terms.shape[:2], -1), field.reshape(len(seeds), -1), relation.shown)
    return dataclasses.replace(found, points=int(known.sum()))


def fit(terms, field, shown=lambda k: k[0]):
    """The fit of a field [seed, point] to terms [seed, term, point]; `shown` is the number of all
    coefficients."""
    known = np.isfinite(terms).all(axis=(0, 1)) & np.isfinite(field).all(axis=0)
    if not known.any():
        return Fit(0)
    both = np.concatenate([terms, field[:, None]], axis=1)[..., known]

    def products(chosen):
        """Sums over pairs of different seeds of all terms and the field."""
        total = both[chosen].sum(axis=0)
        return total @ total.T - np.einsum("sap,sbp->ab", both[chosen], both[chosen])

    def coefficients(s):
        try:
            return np.linalg.solve(s[:-1, :-1], s[:-1, -1])
        except np.linalg.LinAlgError:  # a term is zero at every point
            return np.full(len(s) - 1, math.nan)

    def explained(chosen):
        s = products(chosen)
        # Noise may make a sum of squares negative; then nothing is known.
        return s[:-1, -1] @ coefficients(s) / s[-1, -1] if (s.diagonal() > 0).all() else math.nan

    return Fit(
        int(known.sum()),
        jackknife(len(field), lambda k: shown(coefficients(products(k)))),
        jackknife(len(field), explained),
    )
