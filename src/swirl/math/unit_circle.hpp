// Cosine and sine from + − × alone. Library functions differ in the last bit between platforms, and
// a trajectory that depends on the platform's libm would not be reproducible.
#pragma once

#include <cstdint>

#include "swirl/math/vec2.hpp"

namespace swirl {

inline constexpr double pi = 3.14159265358979323846;

/// v, rotated by k right angles.
SWIRL_INLINE constexpr Vec2 quarter_turns(std::int64_t k, const Vec2& v) {
    switch (k & 3) {
        case 0:
            return v;
        case 1:
            return {-v.y, v.x};
        case 2:
            return {-v.x, -v.y};
        default:
            return {v.y, -v.x};
    }
}

/// (cos 2πu, sin 2πu), with an error below 2⁻⁵² for |u| ≤ 1. `u` counts turns, so quarter turns are
/// exact: u = k/4 + f with |f| ≤ 1/8. The remaining angle φ = 2πf, |φ| ≤ π/4, is evaluated as a
/// Taylor series, whose first omitted term is below φ¹⁸/18! = 2·10⁻¹⁸.
SWIRL_INLINE constexpr Vec2 unit_circle(double u) {
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
    return quarter_turns(k, {c, s});
}

/// sin φ, 1 − cos φ, and φ − sin φ, with full precision for small angles.
struct Turn {
    double sine, versine, lag;
};

/// For |φ| ≤ π/4: Taylor series, whose first omitted terms are below φ¹⁷/17! = 5·10⁻¹⁷ and
/// φ¹⁸/18! = 2·10⁻¹⁸. On a circular path this is evaluated for every event, so it has no division,
/// and terms are grouped in pairs that do not wait for each other.
SWIRL_INLINE constexpr Turn small_turn(double phi) {
    // 1/n!; up to 16! the divisor is exact.
    constexpr double s1 = 1.0 / 6.0, s2 = 1.0 / 120.0, s3 = 1.0 / 5040.0, s4 = 1.0 / 362880.0;
    constexpr double s5 = 1.0 / 39916800.0, s6 = 1.0 / 6227020800.0, s7 = 1.0 / 1307674368000.0;
    constexpr double c1 = 1.0 / 24.0, c2 = 1.0 / 720.0, c3 = 1.0 / 40320.0, c4 = 1.0 / 3628800.0;
    constexpr double c5 = 1.0 / 479001600.0, c6 = 1.0 / 87178291200.0;
    constexpr double c7 = 1.0 / 20922789888000.0;
    const double q = phi * phi, q2 = q * q, q4 = q2 * q2;
    const double lag =
        phi * q * ((s1 - q * s2) + q2 * ((s3 - q * s4) + q2 * ((s5 - q * s6) + q2 * s7)));
    return {phi - lag,
            q * (((0.5 - q * c1) + q2 * (c2 - q * c3)) + q4 * ((c4 - q * c5) + q2 * (c6 - q * c7))),
            lag};
}

/// (cos 2πu, sin 2πu) in a third of the time, with an error below 2⁻⁵¹. The last bit may differ
/// from unit_circle.
SWIRL_INLINE constexpr Vec2 quick_unit_circle(double u) {
    const double quarters = 4.0 * u;
    const auto k = static_cast<std::int64_t>(quarters >= 0.0 ? quarters + 0.5 : quarters - 0.5);
    const Turn turn = small_turn((quarters - static_cast<double>(k)) * (pi / 2.0));
    const double c = 1.0 - turn.versine, s = turn.sine;
    return quarter_turns(k, {c, s});
}

/// For |φ| ≤ 2: Taylor series, whose first omitted terms are below 2²⁵/25! = 2·10⁻¹⁸ and
/// 2²⁴/24! = 3·10⁻¹⁷. It has neither divisions nor branches.
SWIRL_INLINE constexpr Turn wide_turn(double phi) {
    // 1/n!
    constexpr double s[] = {1.0 / 6.0,
                            1.0 / 120.0,
                            1.0 / 5040.0,
                            1.0 / 362880.0,
                            1.0 / 39916800.0,
                            1.0 / 6227020800.0,
                            1.0 / 1307674368000.0,
                            1.0 / 355687428096000.0,
                            1.0 / 121645100408832000.0,
                            1.0 / 51090942171709440000.0,
                            1.0 / 25852016738884976640000.0};
    constexpr double c[] = {0.5,
                            1.0 / 24.0,
                            1.0 / 720.0,
                            1.0 / 40320.0,
                            1.0 / 3628800.0,
                            1.0 / 479001600.0,
                            1.0 / 87178291200.0,
                            1.0 / 20922789888000.0,
                            1.0 / 6402373705728000.0,
                            1.0 / 2432902008176640000.0,
                            1.0 / 1124000727777607680000.0};
    const double q = phi * phi, q2 = q * q, q4 = q2 * q2;
    const auto pair = [&q](double a, double b) { return a - q * b; };
    const auto sum = [&](const double(&n)[11]) {
        const double first = pair(n[0], n[1]) + q2 * pair(n[2], n[3]);
        const double then = pair(n[4], n[5]) + q2 * pair(n[6], n[7]);
        const double last = pair(n[8], n[9]) + q2 * n[10];
        return first + q4 * (then + q4 * last);
    };
    const double lag = (phi * q) * sum(s);
    return {phi - lag, q * sum(c), lag};
}

/// The same for any angle.
SWIRL_INLINE constexpr Turn turn_by(double phi) {
    if (phi <= 2.0 && phi >= -2.0) return wide_turn(phi);
    const Vec2 u = quick_unit_circle(phi * (0.5 / pi));
    return {u.y, 1.0 - u.x, phi - u.y};
}

/// The angle of a vector in turns, 0 ≤ u < 1, counter-clockwise from +x: the inverse of
/// unit_circle, with an error below 2⁻⁵². It is 0 for the null vector, and NaN if a component is
/// NaN. Let t be the tangent of the angle from the nearest axis or diagonal, |t| ≤ √2 − 1. Then
/// atan t = t P(t²), where P interpolates in the Chebyshev points of 0 ≤ t² ≤ (√2 − 1)².
inline constexpr double turns_of(const Vec2& v) {
    const double a = v.x < 0.0 ? -v.x : v.x, b = v.y < 0.0 ? -v.y : v.y;
    const double large = a > b ? a : b, small = a > b ? b : a;
    const bool diagonal = small > 0.41421356237309503 * large;
    const double over = diagonal ? small - large : small;
    const double under = diagonal ? small + large : large;
    const double t = over / (under == 0.0 ? 1.0 : under);
    const double q = t * t;
    double P = 0.021754756199224901;
    P = P * q - 0.044038163703618224;
    P = P * q + 0.057096360853832684;
    P = P * q - 0.066447160157704369;
    P = P * q + 0.076905204995795826;
    P = P * q - 0.090908170600401461;
    P = P * q + 0.11111108226282496;
    P = P * q - 0.14285714234227295;
    P = P * q + 0.19999999999529294;
    P = P * q - 0.33333333333331627;
    P = P * q + 1.0;
    double u = t * P * (0.5 / pi) + (diagonal ? 0.125 : 0.0);
    u = a >= b ? u : 0.25 - u;
    u = v.x < 0.0 ? 0.5 - u : u;
    u = v.y < 0.0 ? 1.0 - u : u;
    return u < 1.0 ? u : u - 1.0;
}

}  // namespace swirl
