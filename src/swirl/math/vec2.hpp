// Vectors in the plane. `Real` is a double, or a vector of doubles (Lanes, lanes.hpp): the physics
// is written once, for one disc and for eight.
#pragma once

namespace swirl {

#define SWIRL_INLINE [[gnu::always_inline]] inline

template <class Real>
struct BasicVec2 {
    Real x, y;
};
using Vec2 = BasicVec2<double>;

template <class Real>
SWIRL_INLINE constexpr BasicVec2<Real> operator+(const BasicVec2<Real>& a,
                                                 const BasicVec2<Real>& b) {
    return {a.x + b.x, a.y + b.y};
}
template <class Real>
SWIRL_INLINE constexpr BasicVec2<Real> operator-(const BasicVec2<Real>& a,
                                                 const BasicVec2<Real>& b) {
    return {a.x - b.x, a.y - b.y};
}
template <class Real>
SWIRL_INLINE constexpr BasicVec2<Real> operator*(const Real& s, const BasicVec2<Real>& a) {
    return {s * a.x, s * a.y};
}
template <class Real>
SWIRL_INLINE constexpr Real dot(const BasicVec2<Real>& a, const BasicVec2<Real>& b) {
    return a.x * b.x + a.y * b.y;
}
/// z component of a × b.
template <class Real>
SWIRL_INLINE constexpr Real cross(const BasicVec2<Real>& a, const BasicVec2<Real>& b) {
    return a.x * b.y - a.y * b.x;
}
/// a rotated by +90°: ẑ × a, the paper's (x, y)^⊥ = (−y, x).
template <class Real>
SWIRL_INLINE constexpr BasicVec2<Real> perpendicular(const BasicVec2<Real>& a) {
    return {-a.y, a.x};
}
/// The product as complex numbers: b rotated by the angle of a and stretched by its magnitude.
template <class Real>
SWIRL_INLINE constexpr BasicVec2<Real> complex_product(const BasicVec2<Real>& a,
                                                       const BasicVec2<Real>& b) {
    return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}

}  // namespace swirl
