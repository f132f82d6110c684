// Cosine and sine from + − × alone. The library's differ in the last bit between platforms, and a
// trajectory that depends on the platform's libm cannot be reproduced.
#pragma once

#include <cstdint>

#include "physics/vec2.hpp"

namespace swirl {

inline constexpr double pi = 3.14159265358979323846;

/// (cos 2πu, sin 2πu), within 2⁻⁵² of the truth for |u| ≤ 1. `u` counts turns, so that quarter
/// turns are exact: u = k/4 + f with |f| ≤ 1/8, then the Taylor series of the remaining angle
/// φ = 2πf, |φ| ≤ π/4, where the first term left out is below φ¹⁸/18! = 2·10⁻¹⁸.
inline constexpr Vec2 unit_circle(double u) {
    const double quarters = 4.0 * u;
    const auto k = static_cast<std::int64_t>(quarters >= 0.0 ? quarters + 0.5 : quarters - 0.5);
    const double phi = (quarters - static_cast<double>(k)) * (pi / 2.0);
    const double q = phi * phi;
    double c = 1.0, s = 1.0;
    for (int n = 16; n > 0; n -= 2) {
        c = 1.0 - c * q / (n * (n - 1.0));
        s = 1.0 - s * q / (n * (n + 1.0));
    }
    s = s * phi;
    switch (k & 3) {
        case 0:
            return {c, s};
        case 1:
            return {-s, c};
        case 2:
            return {-c, -s};
        default:
            return {s, -c};
    }
}

}  // namespace swirl
