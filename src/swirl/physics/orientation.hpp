// The orientation of a sphere, on which its motion does not depend. It is a unit quaternion that
// takes the sphere's own axes to those of the lab. At the beginning they are the same.
//
// Between events the spin of a sphere is ω(t) = ω₀ + α t: constant if it rolls, with a constant
// rate α (horizontal) while it slides (floor.hpp). About a fixed axis the rotation in a time h is
// exp(h ω₀). If the axis moves, it is given by Magnus' series (Blanes, Casas, Oteo, Ros 2009,
// doi:10.1016/j.physrep.2008.11.001), here up to the fourth order:
//
//     exp(Φ),  Φ = h ω₀ + h²/2 α + h³/12 α × ω₀ + O(h⁵)
//
// Sliding lasts some hundredths of the unit of time, so the omitted terms are below 10⁻⁸ of a turn.
// Longer sliding is divided into steps. Cosine and sine are those of math/unit_circle.hpp, so
// results are the same on every platform.
#pragma once

#include "swirl/math/real.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/math/vec2.hpp"

namespace swirl {

struct Quaternion {
    double w = 1.0, x = 0.0, y = 0.0, z = 0.0;
};

constexpr Quaternion operator*(const Quaternion& a, const Quaternion& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
            a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

/// Rotation by the angle |Φ| about Φ = (x, y, z).
inline Quaternion turn_by(double x, double y, double z) {
    const double angle = square_root(x * x + y * y + z * z);
    if (angle == 0.0) return {};
    const Vec2 half = unit_circle(angle / (4.0 * pi));
    const double s = half.y / angle;
    return {half.x, s * x, s * y, s * z};
}

/// Normalised to length 1, which products lose by rounding.
inline Quaternion unit(const Quaternion& q) {
    const double n = square_root(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {q.w / n, q.x / n, q.y / n, q.z / n};
}

/// The orientation after a time h. The spin at the beginning is (ω_x, ω_y) = `horizontal` and
/// ω_z = `vertical`; `rate` is (α_x, α_y).
inline Quaternion turned_for(const Quaternion& from, double h, const Vec2& horizontal,
                             double vertical, const Vec2& rate) {
    // The error is of the order of h⁵ α² ω: 10⁻⁸ of a turn with α ≈ 5 (plastic) and ω ≈ 1.
    constexpr double max_step = 0.05;
    Quaternion q = from;
    Vec2 spin = horizontal;
    const bool slides = rate.x != 0.0 || rate.y != 0.0;
    for (double left = h; left > 0.0;) {
        const double step = slides && left > max_step ? max_step : left;
        const double a = 0.5 * step * step, b = step * step * step / 12.0;
        // α × ω with α_z = 0.
        const double x = rate.y * vertical, y = -(rate.x * vertical),
                     z = rate.x * spin.y - rate.y * spin.x;
        q = turn_by(step * spin.x + a * rate.x + b * x, step * spin.y + a * rate.y + b * y,
                    step * vertical + b * z) *
            q;
        spin = spin + step * rate;
        left -= step;
    }
    return unit(q);
}

/// A direction. `turned` converts it from the sphere's axes to those of the lab.
struct Direction {
    double x, y, z;
};
constexpr Direction turned(const Quaternion& q, const Direction& d) {
    // d + 2 w (q × d) + 2 q × (q × d)
    const double cx = q.y * d.z - q.z * d.y, cy = q.z * d.x - q.x * d.z, cz = q.x * d.y - q.y * d.x;
    return {d.x + 2.0 * (q.w * cx + q.y * cz - q.z * cy),
            d.y + 2.0 * (q.w * cy + q.z * cx - q.x * cz),
            d.z + 2.0 * (q.w * cz + q.x * cy - q.y * cx)};
}

}  // namespace swirl
