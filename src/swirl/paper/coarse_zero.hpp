// The zero of a curve whose points are several N apart: that of the straight line between the two
// points next to it. find_crossing (statistics/zero_crossing.hpp) decides whether there is one, and
// reports no N for such curves, because the curve between the points is unknown. The error here
// follows from the errors of the two points. It does not contain the curvature between them.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "swirl/statistics/zero_crossing.hpp"

namespace swirl {

struct CoarseZero {
    double discs = not_available, error = not_available;
    bool falls = false;  // from positive to negative
    bool exists() const { return discs == discs; }
};

/// The zero of the straight line between two points of opposite signs.
struct LineZero {
    double fraction;  // of the way from the first point to the second
    double discs, error;
};
inline LineZero zero_of_line(const RotationPoint& a, const RotationPoint& b) {
    const double f = a.mean / (a.mean - b.mean), step = b.discs - a.discs;
    return {f, a.discs + f * step,
            std::hypot((1.0 - f) * a.error, f * b.error) * step / std::fabs(b.mean - a.mean)};
}

/// The k for which the zero is between the points k and k + 1, inside the bracket of the change;
/// the middle one of several.
inline std::size_t middle_zero(const std::vector<RotationPoint>& curve, const SignChange& change) {
    std::vector<std::size_t> zeros;
    for (std::size_t k = 0; k + 1 < curve.size(); ++k) {
        const RotationPoint &a = curve[k], &b = curve[k + 1];
        if (a.discs < change.before || b.discs > change.after) continue;
        if ((a.mean < 0.0) != (b.mean < 0.0)) zeros.push_back(k);
    }
    return zeros[zeros.size() / 2];
}

/// The last change of sign. If its bracket has several zeros, the middle one is used.
inline CoarseZero last_zero(const std::vector<RotationPoint>& curve) {
    const Crossing found = find_crossing(curve);
    if (found.changes.empty()) return {};
    const SignChange& change = found.changes.back();
    const std::size_t k = middle_zero(curve, change);
    const LineZero zero = zero_of_line(curve[k], curve[k + 1]);
    return {zero.discs, zero.error, change.to_counterrotation};
}

}  // namespace swirl
