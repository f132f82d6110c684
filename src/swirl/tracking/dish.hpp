// The dish in a film: a circle of constant size that runs round a circle.
//
//   rim     the circle with the best votes over a few pictures spread over the film, that moves as
//           a dish does and a table's edge does not; then in every picture, through its edge points
//   path    C(t) = S + A (cos φ, sin φ), φ = ±Ωt + φ₀, fitted to the centres of all pictures:
//           first a circle through them, then the angles about its middle, unwrapped from picture
//           to picture, against the time; then all five numbers together by Gauss–Newton with
//           Tukey's weights. Errors from the residuals
//
// Pixels, y down; angles counter-clockwise from the right as one sees them in the picture.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "swirl/tracking/circles.hpp"
#include "swirl/tracking/lens.hpp"
#include "swirl/tracking/tracked_path.hpp"

namespace swirl {

/// A picture made ready: floats, a little blurred; and a smaller one, in which votes are counted.
struct Picture {
    Picture(const cv::Mat& grey, double shrunk_to, double blur);

    cv::Mat sharp, small;
    double shrink;                 // length in the small one / length in the sharp one
    std::vector<EdgePixel> edges;  // of the small one
    double noise;                  // of a derivative in the sharp one

    Vec2 to_sharp(const Vec2& p) const;
    Vec2 to_small(const Vec2& p) const;
};

/// What the rim looks like, and about where it goes.
struct Rim {
    double radius = 0.0;  // with a lens: without it
    Polarity polarity = 1;
    double support = 0.0;
    Vec2 swirl_centre{0.0, 0.0};
    double amplitude = 0.0;
    bool second_container = false;  // another circle of that size moves as well
    std::optional<Lens> lens;       // where what it does to the rim is worth knowing
};

/// From pictures spread over the film; throws Failure with the likely cause.
Rim survey_rim(const std::vector<Picture>& pictures);

/// The rim in one picture.
CircleFit find_rim(const Picture& picture, const Rim& rim);

/// Nothing where the centres do not run round a circle.
std::optional<TrackedPath> fit_path(const std::vector<Vec2>& centres,
                                    const std::vector<double>& times);

/// How far the camera shakes from frame to frame, rms of a coordinate: from the second differences
/// of the centres' distances from the path's middle, which change slowly on any path.
double shake_of(const std::vector<Vec2>& centres, const std::vector<std::size_t>& numbers,
                const TrackedPath& path);

/// Where the dish went another way between two pictures than between those around them: pictures
/// that are lost, or are there twice. Angles about the path's middle, picture by picture, tell
/// where they err by less than a sixth of a step; nothing is told where they do not.
struct Leap {
    std::size_t before = 0, after = 0;  // pictures, as `numbers` has them
    double steps = 1.0;                 // of the usual way between two
};
std::vector<Leap> leaps_of(const std::vector<Vec2>& centres,
                           const std::vector<std::size_t>& numbers, const TrackedPath& path);

/// Run through at constant speed, a regular polygon of n sides departs from the circle of the same
/// mean radius by (2A/n²) cos n(φ − φ_corner), and by less at multiples of n: the one harmonic of
/// the centres' distances from the middle that has this size and stands out from the noise is the
/// number of sides. Where two numbers would do, or one of more sides than two pictures a side tell,
/// which looks like one of fewer, none is told.
PathPolygon polygon_of(const std::vector<Vec2>& centres, const std::vector<double>& times,
                       const TrackedPath& path);

}  // namespace swirl
