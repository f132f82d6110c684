#include "track/video/prepared_frame.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace swirl::tracking {

namespace {

constexpr double kernel_reach = 2.5;  // standard deviations; OpenCV's default for floats is 4
constexpr double full_size =
    0.999;                   // sizes from this reduction on, `small` has the size of the frame
constexpr int min_side = 8;  // side of `small`, pixels: less has no edges to vote
constexpr double reduced_blur = 1.0;  // blur of `small`, pixels: averaging has smoothed it already
constexpr double unreduced_blur =
    1.4;  // blur of `small` at full size, pixels: nothing was averaged

void smooth(const cv::Mat& from, cv::Mat& to, double deviation) {
    const int side = 2 * static_cast<int>(std::ceil(kernel_reach * deviation)) + 1;
    cv::GaussianBlur(from, to, cv::Size(side, side), deviation, deviation, cv::BORDER_REPLICATE);
}

}  // namespace

PreparedFrame::PreparedFrame(const cv::Mat& grey, double reduction, double blur)
    : shrink(reduction) {
    grey.convertTo(sharp, CV_32F);
    if (shrink < full_size) {
        const cv::Size size(std::max(min_side, cvRound(grey.cols * shrink)),
                            std::max(min_side, cvRound(grey.rows * shrink)));
        cv::Mat reduced;
        cv::resize(grey, reduced, size, 0, 0, cv::INTER_AREA);
        shrink = double(size.width) / grey.cols;
        reduced.convertTo(reduced, CV_32F);
        smooth(reduced, small, reduced_blur);
    } else {
        shrink = 1.0;
        smooth(sharp, small, unreduced_blur);
    }
    smooth(sharp, sharp, blur);
    edges = edge_pixels(small);
    noise = gradient_noise(sharp);
}

// The centre of pixel k of `small` lies at (k + ½)/shrink − ½ in `sharp`.
Vec2 PreparedFrame::to_sharp(const Vec2& p) const {
    return {(p.x + 0.5) / shrink - 0.5, (p.y + 0.5) / shrink - 0.5};
}
Vec2 PreparedFrame::to_small(const Vec2& p) const {
    return {(p.x + 0.5) * shrink - 0.5, (p.y + 0.5) * shrink - 0.5};
}

}  // namespace swirl::tracking
