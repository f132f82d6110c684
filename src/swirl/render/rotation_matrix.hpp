// Rotation matrices, stored row by row.
#pragma once

#include <array>
#include <cmath>

namespace swirl {

using Rotation = std::array<double, 9>;

/// The rotation by |w| about w, counter-clockwise as seen from the tip of w (Rodrigues' formula).
inline Rotation rotation_by(const std::array<double, 3>& w) {
    const double angle = std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    if (angle < 1e-12) return {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const double x = w[0] / angle, y = w[1] / angle, z = w[2] / angle;
    const double c = std::cos(angle), s = std::sin(angle), d = 1.0 - c;
    return {c + d * x * x,     d * x * y - s * z, d * x * z + s * y,
            d * x * y + s * z, c + d * y * y,     d * y * z - s * x,
            d * x * z - s * y, d * y * z + s * x, c + d * z * z};
}

}  // namespace swirl
