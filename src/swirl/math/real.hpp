// The operations on real numbers that the event loop may use in addition to + − × ÷: square root,
// selection and comparison. Each is exact or exactly rounded, so results are the same for every
// compiler, processor and vector width. lanes.hpp overloads them for several doubles at once.
#pragma once

#include <cstdint>
#include <limits>

#include "swirl/math/vec2.hpp"

namespace swirl {

/// The time of an event that does not happen.
inline constexpr double never = std::numeric_limits<double>::infinity();

SWIRL_INLINE double square_root(double x) { return __builtin_sqrt(x); }
SWIRL_INLINE constexpr double select(bool condition, double yes, double no) {
    return condition ? yes : no;
}
/// `yes` if the condition holds, otherwise `no`: without a branch, for unpredictable conditions.
SWIRL_INLINE constexpr std::uint32_t chosen(bool condition, std::uint32_t yes, std::uint32_t no) {
    return no ^ ((no ^ yes) & (0u - static_cast<std::uint32_t>(condition)));
}
/// −a if the condition holds, otherwise a. It flips the sign bit, without a branch.
SWIRL_INLINE constexpr double minus_if(bool condition, double a) {
    return __builtin_bit_cast(double, __builtin_bit_cast(std::uint64_t, a) ^
                                          (static_cast<std::uint64_t>(condition) << 63));
}
/// The larger number; `b` if they are equal or one of them is NaN.
template <class Real>
SWIRL_INLINE constexpr Real larger(const Real& a, const Real& b) {
    return select(a > b, a, b);
}
template <class Real>
SWIRL_INLINE constexpr Real smaller(const Real& a, const Real& b) {
    return select(a < b, a, b);
}
template <class Real>
SWIRL_INLINE constexpr Real magnitude(const Real& a) {
    return larger(-a, a);
}

}  // namespace swirl
