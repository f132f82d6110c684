// Normal deviates without elementary functions (Karney 2016, doi:10.1145/2710016, algorithm N).
// They compare uniform deviates only, so they are the same on every platform, and their
// distribution is exact up to the 2⁻⁵³ of a uniform deviate.
#pragma once

#include <cstdint>

#include "swirl/math/random.hpp"

namespace swirl {

/// True with probability e⁻ᵖ for 0 ≤ p ≤ 1: the length of the descending run p > u₁ > u₂ > … is
/// even (von Neumann 1951).
constexpr bool happens_with_exp(double p, Random& random) {
    for (bool is_even = true;; is_even = !is_even) {
        const double u = random.uniform();
        if (!(u < p)) return is_even;
        p = u;
    }
}

/// A deviate of mean 0 and standard deviation 1.
constexpr double normal_deviate(Random& random) {
    for (;;) {
        // k with a probability proportional to exp(−k²/2): geometric, then thinned.
        std::int64_t k = 0;
        while (happens_with_exp(0.5, random)) ++k;
        bool accepted = true;
        for (std::int64_t n = k * (k - 1); accepted && n > 0; --n)
            accepted = happens_with_exp(0.5, random);
        if (!accepted) continue;
        // k + x, where x is accepted with probability exp(−x (2k + x)/2).
        const double x = random.uniform(), whole = static_cast<double>(k);
        const double p = x * (2.0 * whole + x) / (2.0 * whole + 2.0);
        for (std::int64_t n = k + 1; accepted && n > 0; --n) accepted = happens_with_exp(p, random);
        if (!accepted) continue;
        return random.bits() >> 63 ? whole + x : -(whole + x);
    }
}

}  // namespace swirl
