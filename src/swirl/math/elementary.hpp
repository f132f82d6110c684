// Exponential and logarithm from + − × ÷ alone, so that they are reproducible on every platform
// (unit_circle.hpp says why). Relative errors are below 10⁻¹⁵.
#pragma once

#include <cstdint>

#include "swirl/math/vec2.hpp"

namespace swirl {

/// ln 2 as a number with 33 significant bits, whose multiples by small whole numbers are exact, and
/// the remainder.
inline constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;

/// eˣ for |x| ≤ 700. With x = k ln 2 + f and |f| ≤ ln 2 / 2, the first omitted term of the Taylor
/// series is f¹⁵/15! < 10⁻¹⁹.
constexpr double exponential(double x) {
    const double binary = x * 1.4426950408889634;  // x / ln 2
    const auto k = static_cast<std::int64_t>(binary >= 0.0 ? binary + 0.5 : binary - 0.5);
    const double f = (x - static_cast<double>(k) * ln2_high) - static_cast<double>(k) * ln2_low;
    double sum = 1.0;
    for (int n = 14; n > 0; --n) sum = 1.0 + sum * f / n;
    return sum * __builtin_bit_cast(double, static_cast<std::uint64_t>(k + 1023) << 52);
}

/// ln x for normal x > 0. With x = 2ᵉ m, √½ ≤ m < √2 and s = (m − 1)/(m + 1), it is
/// e ln 2 + 2 (s + s³/3 + …); the first omitted term is below 0.172²⁷/27 < 10⁻²¹.
constexpr double logarithm(double x) {
    const auto bits = __builtin_bit_cast(std::uint64_t, x);
    auto e = static_cast<std::int64_t>(bits >> 52) - 1023;
    double m =
        __builtin_bit_cast(double, (bits & 0x000fffffffffffffu) | (std::uint64_t{1023} << 52));
    if (m >= 1.4142135623730951) {
        m *= 0.5;
        ++e;
    }
    const double s = (m - 1.0) / (m + 1.0), q = s * s;
    double sum = 0.0;
    for (int n = 25; n > 0; n -= 2) sum = sum * q + 1.0 / n;
    return static_cast<double>(e) * ln2_high + (2.0 * s * sum + static_cast<double>(e) * ln2_low);
}

/// x to the power of a, for x > 0 and |a ln x| ≤ 700.
constexpr double power(double x, double a) { return exponential(a * logarithm(x)); }

}  // namespace swirl
