// The edge of a large circle as a lens and a tilted camera show it (lens.hpp).
//
// On rays from its middle the place of the steepest ascent or descent near where the image of the
// circle should be, to a fraction of a pixel; each undone by the lens lies on the circle itself.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "swirl/tracking/circles.hpp"
#include "swirl/tracking/lens.hpp"

namespace swirl {

struct OutlineSettings {
    Polarity polarity = 1;
    double window = 3.0;   // pixels to either side
    double minimum = 0.0;  // slope that is an edge
};

/// As seen, of the circle with this middle and radius without lens and tilt.
std::vector<Vec2> outline_edge(const cv::Mat& picture, const Lens& lens, const Lens::Circle& circle,
                               const OutlineSettings& settings);

/// That circle with its middle fitted, its radius kept; centre and radius are those of a circle
/// through its image, from which Lens::ideal(Circle) comes back to it.
CircleFit fit_outline(const cv::Mat& picture, const Lens& lens, Lens::Circle circle,
                      const OutlineSettings& settings);

}  // namespace swirl
