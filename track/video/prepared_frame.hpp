// A video frame, prepared for the search of circles: smoothed, and reduced for counting votes.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "track/video/circles.hpp"

namespace swirl::tracking {

struct PreparedFrame {
    /// `grey` has 8 bits a pixel. `reduction` (at most 1) is the target for `shrink`; `blur` is the
    /// standard deviation of the smoothing of `sharp`, pixels.
    PreparedFrame(const cv::Mat& grey, double reduction, double blur);

    cv::Mat sharp, small;          // 32-bit floats
    double shrink;                 // length in `small` / length in `sharp`
    std::vector<EdgePixel> edges;  // edges of `small`
    double noise;                  // standard deviation of a derivative of `sharp`

    Vec2 to_sharp(const Vec2& p) const;
    Vec2 to_small(const Vec2& p) const;
};

}  // namespace swirl::tracking
