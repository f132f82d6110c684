// Detects balls by their shading, for videos whose edges are too poor.
//
// A ball that is lit from one side is brighter than the floor on that side and darker on the other.
// At low contrast, compression leaves little of its outline, but the brightness falls in the same
// direction across every ball. The response is the derivative of the blurred frame in that
// direction t, with a Gaussian whose width is a fixed part of the radius a:
//
//     D(x) = a t·∇(G ∗ I)(x)
//
// It is largest near the centre of each ball. It is negative where the floor ends on the lit side.
//
//   direction   Balls are compact: D has high maxima and shallow minima. The direction is the one
//               with the largest third moment of D, which is a cubic form of t.
//   radius      The radius whose maxima explain the greatest sum of squares, with the filter
//               normalised.
//   number      The maxima of balls have similar heights. Their number must hardly change between
//               frames.
//
// The positions are starting points for the appearance template (appearance_template.hpp). Both
// have a common shift, which the wall shows (wall_fit.cpp).
#pragma once

#include <optional>
#include <vector>

#include "track/video/particle_detection.hpp"

namespace swirl::tracking {

/// The appearance of balls of one size in these frames; none if their number is not consistent.
std::optional<ParticleAppearance> survey_shading(const std::vector<PreparedFrame>& frames,
                                                 const std::vector<CircleFit>& rims,
                                                 const KnownDiscs& known, unsigned threads);

/// The maxima of the response in one frame, the highest first, as sure particles.
std::vector<DetectedParticle> find_by_shading(const cv::Mat& sharp, const CircleFit& rim,
                                              const ShadingFilter& filter, std::size_t max_count);

}  // namespace swirl::tracking
