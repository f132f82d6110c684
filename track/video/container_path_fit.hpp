// The path of the container, C(t) = S + A (cos φ, sin φ) with φ = φ₀ ± Ωt, fitted to the centres of
// the rim in all frames.
//
// First a circle through the centres, then a straight line through their unwrapped angles. From
// there all five parameters together by Gauss–Newton with Tukey's weights. Errors are standard
// errors from the residuals.
#pragma once

#include <optional>
#include <vector>

#include "swirl/math/vec2.hpp"
#include "track/video/tracked_path.hpp"

namespace swirl::tracking {

/// Least amplitude of a container that moves, pixels: noise and vibrations stay below it.
inline constexpr double min_path_amplitude = 1.0;

struct PathCircle {
    Vec2 centre{0.0, 0.0};
    double radius = 0.0;
    double scatter = 0.0;  // median distance of the points from the circle
};

/// The circle x² + y² = 2 p·x + q through `points` by least squares (Kåsa 1976,
/// doi:10.1109/TIM.1976.6312298), reweighted so that outliers have no weight.
PathCircle circle_through(const std::vector<Vec2>& points);

/// `times` ascending, one for each centre. Nothing if the centres do not go round a circle.
std::optional<TrackedPath> fit_container_path(const std::vector<Vec2>& centres,
                                              const std::vector<double>& times);

}  // namespace swirl::tracking
