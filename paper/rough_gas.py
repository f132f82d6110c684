"""The mean-field theory of Huthmann and Zippelius (Phys. Rev. E 56, R6275, 1997, cond-mat/9708093)
for a cooling gas of rough discs in a circular dish at rest with a smooth wall.

The theory describes the translational temperature T = ½m⟨v²⟩ and that of the spins T_s = I⟨ω²⟩ of a
homogeneous gas whose velocities and spins have normal distributions. Two discs of mass m and radius
r approach with the speed u along the normal. Their contact slips at the rate s = w + rΣ, with w the
tangential part of the relative velocity and Σ the sum of the spins. If every contact sticks (μ →
∞), the tangential impulse is −mηs, with

    η = q (1 + β) / (2q + 2),   q = I/(m r²),

because the effective mass of two equal discs is mq/(2q + 2). The impulse changes the energies by

    translation   −(1 − e²) m u²/4 − mη s w + mη² s²
    spins                          − mη s rΣ + (mη²/q) s².

Pairs collide at a rate proportional to u, so ⟨u²⟩ = 4T/m. The tangential components do not affect
the rate: ⟨w²⟩ = 2T/m and r²⟨Σ²⟩ = 2T_s/(mq), and both are independent. A gas of N discs has the
energy N T + N T_s/2. With τ the mean number of collisions of a disc with others, N/2 of them for
each unit of τ give

    dT/dτ   = −a T + b T_s        a = (1 − e²)/2 + η(1 − η) + a_w,   b = η²/q
    dT_s/dτ = 2b T − 2c T_s       c = (η/q)(1 − η/q).

The wall has the same restitution e. Each collision with it removes (1 − e²) m v²/2 of the normal
velocity v, on average (1 − e²) T. The discs at the wall have the number density p/T, so √(T/2πm)
p/T of them hit a unit of its length in a unit of time. With p = n T (1 + 2φg) and the circle of
radius R − r on which their centres are,

    a_w = (1 − e²) 2π(R − r) n (1 + 2φg) / (√(2πm) N ν),   ν that of T = 1.

The time follows from the collision rate of a disc,

    dτ/dt = ν = 2√π n σ g √(T/m),   σ = 2r,   g = (1 − 7φ/16)/(1 − φ)²,

with n the number of discs per area and Henderson's pair correlation g at contact (1975,
doi:10.1080/00268977500102511).

Limits. β = −1, or no friction (η = 0): only e matters, which is Haff's law. e = β = 1: a = b = c,
so the energy is constant and T = T_s in the end.
"""

import dataclasses
import math

import numpy as np
import scipy.integrate
import scipy.linalg

from paper.hard_discs import contact_correlation, pressure_ratio

FRACTION = 0.2  # φ = N r²/R²


@dataclasses.dataclass(frozen=True)
class Case:
    """One collision law. `beta` is that of the theory: −1 without friction."""

    case: str
    words: str
    restitution: float
    beta: float
    mu: float
    inertia: float

    def rates(self, discs):
        """The matrix of the theory."""
        e, q = self.restitution, self.inertia
        eta = q * (1 + self.beta) / (2 * q + 2)
        b, c = eta * eta / q, eta / q * (1 - eta / q)
        a = (1 - e * e) / 2 + eta * (1 - eta) + wall_loss(e, discs)
        return np.array([[-a, b], [2 * b, -2 * c]])

    def after(self, tau, discs):
        """(T, T_s) after τ collisions of a disc, in units of T at the start."""
        return scipy.linalg.expm(self.rates(discs) * tau) @ [1, 0]

    def time_of(self, tau, discs):
        """The time of τ collisions, in units of the inverse collision rate at the start: the
        integral of √(T₀/T)."""
        return scipy.integrate.quad(lambda t: 1 / math.sqrt(self.after(t, discs)[0]), 0, tau)[0]


def collision_rate():
    """Enskog's, of discs of radius 1 and mass 1 at T = 1."""
    return 4 * math.sqrt(math.pi) * (FRACTION / math.pi) * contact_correlation(FRACTION)


def radius_of(discs):
    return math.sqrt(discs / FRACTION)


def wall_loss(restitution, discs):
    """a_w."""
    pressure = pressure_ratio(FRACTION)
    return (
        (1 - restitution**2)
        * 2
        * math.pi
        * (radius_of(discs) - 1)
        * FRACTION
        / math.pi
        * pressure
        / (math.sqrt(2 * math.pi) * discs * collision_rate())
    )
