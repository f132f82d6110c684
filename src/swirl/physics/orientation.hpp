// How a sphere is turned, which its motion does not depend on: a unit quaternion that takes the
// sphere's own axes to those of the lab. At the beginning they are the same.
//
// While nothing happens to a sphere its spin is ω(t) = ω₀ + α t: constant if it rolls, with a
// constant rate α (horizontal) while it slides (floor.hpp). About a fixed axis the turn in a time h
// is exp(h ω₀). Where the axis moves it is that of Magnus' series (Blanes, Casas, Oteo, Ros 2009,
// doi:10.1016/j.physrep.2008.11.001), here up to the fourth order:
//
//     exp(Φ),  Φ = h ω₀ + h²/2 α + h³/12 α × ω₀ + O(h⁵)
//
// Slides last some hundredths of the unit of time, so what is left out is below 10⁻⁸ of a turn;
// longer ones are taken in steps. Cosine and sine are those of math/unit_circle.hpp: the same bits
// everywhere.
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

/// By the angle |Φ| about Φ = (x, y, z).
inline Quaternion turn_by(double x, double y, double z) {
    const double angle = square_root(x * x + y * y + z * z);
    if (angle == 0.0) return {};
    const Vec2 half = unit_circle(angle / (4.0 * pi));
    const double s = half.y / angle;
    return {half.x, s * x, s * y, s * z};
}

/// Of length 1 again, which products lose by rounding.
inline Quaternion unit(const Quaternion& q) {
    const double n = square_root(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {q.w / n, q.x / n, q.y / n, q.z / n};
}

/// So a sphere is turned after the time h, with the spin (ω_x, ω_y, ω_z) at its beginning and the
/// rate (α_x, α_y) of the first two.
inline Quaternion turned_for(const Quaternion& from, double h, const Vec2& horizontal,
                             double vertical, const Vec2& rate) {
    // h⁵ α² ω and the like, with the α of plastic (some 5) and ω of 1: 10⁻⁸ of a turn.
    constexpr double longest = 0.05;
    Quaternion q = from;
    Vec2 spin = horizontal;
    const bool slides = rate.x != 0.0 || rate.y != 0.0;
    for (double left = h; left > 0.0;) {
        const double step = slides && left > longest ? longest : left;
        const double a = 0.5 * step * step, b = step * step * step / 12.0;
        // α × ω, α_z = 0.
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

/// Where a point of the sphere, given in its own axes, is in the lab.
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
