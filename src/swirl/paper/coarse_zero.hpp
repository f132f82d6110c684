// The zero of a curve whose points are several N apart. find_crossing
// (statistics/zero_crossing.hpp) decides whether there is one, and reports no N for such curves,
// because the curve between the points is unknown. Here it is interpolated.
//
// Interpolation. Between the points k and k + 1, of opposite signs, a parabola through these two
// and a third point has exactly one zero. There are two such parabolas, one with point k − 1 and
// one with point k + 2. Their errors at x are f‴/6 times (x − x_k)(x − x_{k+1})(x − x_third), whose
// last factor is positive for one and negative for the other. So the zero of a smooth curve whose
// third derivative keeps its sign lies between the zeros of the two parabolas. N_c is their mean,
// and half of their distance is the error of the interpolation. At the end of a curve there is one
// parabola; then the distance from the zero of the straight line is the error. Two points alone
// have only the straight line. Its zero may be anywhere between them: the error is a uniform
// distribution's, step/√12.
//
// The statistical error follows from the errors of the two points. The error is both together, as
// for independent ones. A curve that jumps between two points, from one state to another, is not
// smooth; then the parabolas differ much, but do not bound the zero.
#pragma once

#include <algorithm>
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

/// The zero between a and b, of opposite signs, of the parabola through a, b and c.
inline double zero_of_parabola(const RotationPoint& a, const RotationPoint& b,
                               const RotationPoint& c) {
    const double slope = (b.mean - a.mean) / (b.discs - a.discs);
    const double curvature =
        ((c.mean - b.mean) / (c.discs - b.discs) - slope) / (c.discs - a.discs);
    const auto value = [&](double x) {
        return a.mean + (x - a.discs) * (slope + (x - b.discs) * curvature);
    };
    double left = a.discs, right = b.discs;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (left + right);
        ((value(middle) < 0.0) == (a.mean < 0.0) ? left : right) = middle;
    }
    return 0.5 * (left + right);
}

/// The zero of a curve with its two errors.
struct CurveZero {
    double fraction;  // of the way from point k to point k + 1
    double discs;
    double statistical, interpolation;

    double error() const { return std::hypot(statistical, interpolation); }
};
/// Between the points k and k + 1.
inline CurveZero zero_of_curve(const std::vector<RotationPoint>& curve, std::size_t k) {
    const RotationPoint &a = curve[k], &b = curve[k + 1];
    const LineZero line = zero_of_line(a, b);
    const double step = b.discs - a.discs;
    double discs = line.discs, interpolation = step / std::sqrt(12.0);
    if (k > 0 && k + 2 < curve.size()) {
        const double left = zero_of_parabola(a, b, curve[k - 1]),
                     right = zero_of_parabola(a, b, curve[k + 2]);
        discs = 0.5 * (left + right);
        interpolation = 0.5 * std::fabs(right - left);
    } else if (curve.size() > 2) {
        discs = zero_of_parabola(a, b, k > 0 ? curve[k - 1] : curve[k + 2]);
        interpolation = std::fabs(discs - line.discs);
    }
    return {(discs - a.discs) / step, discs, line.error, interpolation};
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
    const CurveZero zero = zero_of_curve(curve, middle_zero(curve, change));
    return {zero.discs, zero.error(), change.to_counterrotation};
}

}  // namespace swirl
