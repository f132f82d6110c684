// The energy of a snapshot, as reported in every result.
#pragma once

#include <cstddef>

#include "swirl/math/real.hpp"
#include "swirl/math/vec2.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

/// Kinetic energy K in the lab frame, including spins, and the invariant K − ΩL with the angular
/// momentum L about the swirl centre, positive with the swirl. The invariant is conserved on the
/// exact circle without friction (docs/explanation/physics.md). `swirl_sign` is −1 for a clockwise
/// swirl.
struct Budget {
    double energy = 0.0, invariant = 0.0;
};

inline Budget budget_of(const Snapshot& s, double swirl_sign = 1.0) {
    double K = 0.0, L = 0.0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Disc d = s.disc(i);
        K += kinetic_energy(d);
        L += d.mass * cross(s.position(i), d.velocity) + d.inertia * d.spin;
    }
    return {K, K - 2.0 * pi / s.period * (swirl_sign * L)};
}

}  // namespace swirl
