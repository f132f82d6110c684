// Where a measured curve changes sign.
//
// Points y_k ± e_k at x_k, in the order of x. A crossing lies between a point that is above zero
// beyond doubt and one below, or the other way round: by three errors each. The zero is that of the
// straight line a + b x fitted with weights 1/e² to the points from the one to the other and the
// next on either side (four at least); from the covariance of the fit
//
//     x_c = −a/b,      error² = (var a + 2 x_c cov(a, b) + x_c² var b) / b²,
//
// enlarged by √(χ²/ν) where the points scatter about the line by more than their errors say.
// Limits: the curve must be near enough to straight over those points.
#pragma once

#include <optional>
#include <span>

namespace swirl {

struct CurvePoint {
    double x, y, error;
};

struct ZeroCrossing {
    double x, error;
    bool falling;  // from positive to negative
};

/// The first crossing; nothing if the curve has none. Points without an error do not count.
std::optional<ZeroCrossing> zero_crossing(std::span<const CurvePoint> curve);

}  // namespace swirl
