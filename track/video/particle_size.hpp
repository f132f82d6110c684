// The approximate size of the discs in a video, from votes.
//
// For every radius and both polarities, the best circles that do not overlap get a score: the
// length of edges that they explain. The radius with the highest score is that of the discs, unless
// the frames contradict it:
//
//   fill      many circles that fill almost nothing of the container are noise or texture
//   flicker   the number of discs is constant
//   end       the score still grows towards smaller radii: edges have no size of their own
//
// If circles never touch each other, but their distances pile up at a larger value, they are a part
// of each disc, such as its lit side. That value is then the contact distance.
//
// Low contrast and strong compression produce such sizes. Then the other maxima of the score are
// tried, the best first.
#pragma once

#include <algorithm>
#include <vector>

#include "track/video/particle_detection.hpp"

namespace swirl::tracking {

/// Two circles nearer than this fraction of the sum of radii overlap.
inline constexpr double min_distance = 0.8;

/// The circles that do not overlap a better one; `circles` holds the best first.
template <typename Circle>
std::vector<Circle> without_overlaps(const std::vector<Circle>& circles, double spacing = 1.0) {
    std::vector<Circle> separate;
    for (const Circle& c : circles)
        if (std::none_of(separate.begin(), separate.end(), [&](const Circle& s) {
                return length(s.centre - c.centre) < min_distance * spacing * (s.radius + c.radius);
            }))
            separate.push_back(c);
    return separate;
}
/// `spacing`: contact distance relative to the sum of radii.
std::vector<CircleCandidate> best_candidates(std::vector<CircleCandidate> all,
                                             double spacing = 1.0);

/// True if a disc at `centre` is inside the container.
bool within(const CircleFit& rim, const Vec2& centre, double radius);

/// The survey frames with their rims and the edges inside.
struct ParticleSurvey {
    const std::vector<PreparedFrame>& frames;
    const std::vector<CircleFit>& rims;
    std::vector<std::vector<EdgePixel>> edges = {};
};

struct CommonCircle {
    double score = 0.0, radius = 0.0;  // radius in the small images
    Polarity polarity = 1;
    double spacing = 1.0;  // contact distance relative to the diameter
};

/// The radius and polarity whose circles explain the greatest length of edges, among those that the
/// frames do not contradict. Score 0 if there are no circles. Throws Failure if all sizes are
/// contradicted.
CommonCircle find_common_circle(const ParticleSurvey& survey, const KnownDiscs& known);

}  // namespace swirl::tracking
