// Measured points next to curves of a model: χ², and the parameter of the model that fits best.
//
// A curve has points (N, m, s) for one value p of the parameter. Between two of its N the model is
// the straight line, with the variance of that line. A measured point (N, y, e) then contributes
//
//     (y − m(N))² / (e² + s(N)²)
//
// to χ². Points outside the range of N of a curve are left out of all curves, so that their χ² can
// be compared. Between two neighbouring values of p, m(N) and s(N) are straight lines as well. The
// best p has the least χ² in the range of the curves, and its interval contains every p with
//
//     χ²(p) ≤ χ²_min + max(1, χ²_min/f),   f = number of points − 1.
//
// One standard error is thus Δχ² = 1 if the model fits, and wider if it does not (the errors are
// scaled, as by the Particle Data Group). Limits: the least χ² of a coarse set of curves depends on
// the interpolation; an interval that reaches the end of the range is open there.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "swirl/statistics/zero_crossing.hpp"

namespace swirl {

/// The points of a curve are sorted by their number of discs.
struct ModelCurve {
    double parameter = not_available;
    std::vector<RotationPoint> points;
};

/// The line through the neighbours of N; nothing outside the range of the curve.
std::optional<RotationPoint> model_at(const ModelCurve& curve, double discs);

/// The measured points that lie in the range of all curves.
std::vector<RotationPoint> comparable_points(std::span<const ModelCurve> curves,
                                             std::span<const RotationPoint> measured);

/// Of points in the range of the curve.
double chi_square_of(const ModelCurve& curve, std::span<const RotationPoint> measured);

struct BestParameter {
    double value = not_available, lower = not_available, upper = not_available;
    double chi_square = not_available;
    std::size_t freedom = 0;
    bool open_below = false, open_above = false;  // the interval reaches the end of the range

    double error() const { return 0.5 * (upper - lower); }
};

/// Curves with ascending and different parameters. Nothing with fewer than two curves or two
/// points.
std::optional<BestParameter> best_parameter(std::span<const ModelCurve> curves,
                                            std::span<const RotationPoint> measured);

}  // namespace swirl
