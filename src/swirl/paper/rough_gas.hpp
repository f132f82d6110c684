// The mean-field theory of a freely cooling gas of rough discs: translational temperature
// T = ½m⟨v²⟩ and temperature of the spins T_s = I⟨ω²⟩, of a homogeneous gas whose velocities and
// spins have normal distributions. The theory is that of Huthmann and Zippelius (Phys. Rev. E 56,
// R6275, 1997, cond-mat/9708093), which Luding, Huthmann, McNamara and Zippelius compared with
// simulations (Phys. Rev. E 58, 3416, 1998). The derivation below uses the collision law of this
// program.
//
// One collision. Two discs of mass m and radius r approach with the speed u along the normal. Their
// contact slips at the rate s = w + rΣ, with w the tangential part of the relative velocity and Σ
// the sum of the spins. If every contact sticks (μ → ∞), the tangential impulse is −mηs, with
//
//     η = q (1 + β) / (2q + 2),   q = I/(m r²),
//
// because the effective mass of two equal discs is mq/(2q + 2). The impulse changes the energies by
//
//     translation   −(1 − e²) m u²/4 − mη s w + mη² s²
//     spins                          − mη s rΣ + (mη²/q) s².
//
// Averages over the colliding pairs. Pairs collide at a rate proportional to u, so ⟨u²⟩ = 4T/m. The
// tangential components do not affect the rate: ⟨w²⟩ = 2T/m and r²⟨Σ²⟩ = 2T_s/(mq), and both are
// independent. A gas of N discs has the energy N T + N T_s/2. With τ the mean number of collisions
// of a disc, N/2 collisions for each unit of τ give
//
//     dT/dτ   = −a T + b T_s        a = (1 − e²)/2 + η(1 − η),   b = η²/q
//     dT_s/dτ = 2b T − 2c T_s       c = (η/q)(1 − η/q).
//
// This system is linear in τ, so its solution is a matrix exponential. The time follows from the
// collision rate of a disc,
//
//     dτ/dt = ν = 2√π n σ g √(T/m),   σ = 2r,   g = (1 − 7φ/16)/(1 − φ)²,
//
// with n the number of discs per area and Henderson's pair correlation g at contact (1975,
// doi:10.1080/00268977500102511).
//
// Limits. β = −1, or no friction (η = 0): only e matters, and T = T₀ exp(−(1 − e²)τ/2), which is
// Haff's law. e = β = 1: a = b = c, so the energy is constant and T = T_s in the end.
#pragma once

#include <cmath>

#include "swirl/math/unit_circle.hpp"

namespace swirl {

struct Temperatures {
    double translation, spins;
};

struct RoughGas {
    double restitution, roughness, inertia;  // e, η, q

    /// `beta`: of a contact that sticks; −1 without friction.
    static RoughGas of(double restitution, double beta, double q) {
        return {restitution, q * (1.0 + beta) / (2.0 * q + 2.0), q};
    }
    double a() const {
        return 0.5 * (1.0 - restitution * restitution) + roughness * (1.0 - roughness);
    }
    double b() const { return roughness * roughness / inertia; }
    double c() const { return roughness / inertia * (1.0 - roughness / inertia); }

    /// After τ collisions of a disc. With M = (−a, b; 2b, −2c), half its trace s, and
    /// h² = s² − det M: exp(Mτ) = exp(sτ) (cosh(hτ) + (M − s) sinh(hτ)/h).
    Temperatures after(double tau, const Temperatures& start) const {
        const double half_trace = -0.5 * a() - c(), half_difference = 0.5 * a() - c();
        const double h = std::sqrt(half_difference * half_difference + 2.0 * b() * b());
        const double even = std::exp(half_trace * tau) * std::cosh(h * tau);
        const double odd = std::exp(half_trace * tau) * (h > 0.0 ? std::sinh(h * tau) / h : tau);
        const double T = start.translation, S = start.spins;
        return {even * T + odd * ((-a() - half_trace) * T + b() * S),
                even * S + odd * (2.0 * b() * T + (-2.0 * c() - half_trace) * S)};
    }

    /// The time of τ collisions, in units of the inverse collision rate at the start: the integral
    /// of √(T₀/T) by Simpson's rule.
    double time_of(double tau, const Temperatures& start) const {
        const int steps = 2 * (10 + static_cast<int>(20.0 * tau));
        double sum = 0.0;
        for (int k = 0; k <= steps; ++k) {
            const double T = after(tau * k / steps, start).translation;
            const double weight = k == 0 || k == steps ? 1.0 : k % 2 ? 4.0 : 2.0;
            sum += weight * std::sqrt(start.translation / T);
        }
        return sum * tau / (3.0 * steps);
    }
};

/// g: Henderson's pair correlation at contact.
inline double contact_correlation(double packing_fraction) {
    const double free = 1.0 - packing_fraction;
    return (1.0 - 7.0 / 16.0 * packing_fraction) / (free * free);
}

/// ν of discs of radius 1 and mass 1 at T = 1, with packing fraction φ.
inline double enskog_collision_rate(double packing_fraction) {
    return 4.0 * std::sqrt(pi) * (packing_fraction / pi) * contact_correlation(packing_fraction);
}

}  // namespace swirl
