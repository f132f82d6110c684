// The edge of a large circle as a lens and a tilted camera show it (lens.hpp).
//
// On rays from the circle's centre, the steepest ascent or descent near the predicted image of the
// circle is found to a fraction of a pixel. Each of these points, corrected by the lens, lies on
// the circle itself.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "track/video/circles.hpp"
#include "track/video/lens.hpp"

namespace swirl::tracking {

struct OutlineSettings {
    Polarity polarity = 1;
    double window = 3.0;   // pixels to either side of the predicted edge
    double minimum = 0.0;  // least slope of an edge, grey levels per pixel
};

/// Points of the edge in the image, at most one per ray. `circle` is the circle without lens and
/// tilt.
std::vector<Vec2> outline_edge(const cv::Mat& image, const Lens& lens, const Lens::Circle& circle,
                               const OutlineSettings& settings);

/// Fits the centre of `circle`; its radius is fixed. The centre and radius returned are those of
/// the circle that fits the image, from which Lens::ideal(Circle) restores the fitted circle.
CircleFit fit_outline(const cv::Mat& image, const Lens& lens, Lens::Circle circle,
                      const OutlineSettings& settings);

}  // namespace swirl::tracking
