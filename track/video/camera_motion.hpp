// The motion of the camera, from the background, which is at rest.
//
// Patches of a reference frame that lie outside the circle swept by the container are searched in
// each frame, by normalised correlation: first in a reduced image, then to a fraction of a pixel.
// A similarity (shift, zoom, small turn) is fitted to those patches that agree. A time stamp, a
// hand or the container's own wall disagrees and is left out. Each frame is compared with the
// reference alone, so errors do not add up.
//
// stabilise() removes the motion from a frame. All later steps then see a camera at rest.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "swirl/math/vec2.hpp"

namespace swirl::tracking {

/// Maps positions of the reference frame (`fixed`) to those of another frame (`seen`).
struct CameraPose {
    Vec2 about{0.0, 0.0};     // the image centre, in pixels
    Vec2 shift{0.0, 0.0};     // shift of the image centre
    double a = 1.0, b = 0.0;  // zoom times cosine and sine of the turn

    Vec2 seen(const Vec2& fixed) const;
    Vec2 fixed(const Vec2& seen) const;
    double zoom() const;
};

/// Replaces the frame by the one that the reference camera would see.
void stabilise(cv::Mat& grey, const CameraPose& pose);

class StaticBackground {
  public:
    /// Patches of `reference` (8 bits) farther from `centre` than `swept`.
    StaticBackground(const cv::Mat& reference, const Vec2& centre, double swept);

    /// False if too little of the background has texture.
    bool usable() const { return patches_.size() >= min_patches; }
    /// None if too few patches agree.
    std::optional<CameraPose> pose(const cv::Mat& grey) const;

  private:
    static constexpr std::size_t min_patches = 6, max_patches = 24;
    struct Patch {
        cv::Point corner;  // corner in the reference frame
        cv::Mat coarse, fine;
        cv::Point coarse_corner;
    };
    struct Match {
        Vec2 from, to;  // positions of a patch relative to the image centre
    };

    std::optional<Vec2> find(const Patch& patch, const cv::Mat& coarse, const cv::Mat& fine) const;

    cv::Size size_;
    int reduction_ = 2;
    std::vector<Patch> patches_;
};

/// How the camera moved during a video.
struct CameraMotion {
    std::vector<CameraPose> poses;  // poses for each frame; empty: the camera was at rest
    bool from_rim = false;          // not from the background
    double shake = 0.0;             // shake from frame to frame, rms of a coordinate, pixels
    double drift = 0.0;             // greatest distance from the reference, smoothed, pixels
    double zoom = 0.0;              // largest relative change of the scale
};
/// Sets the sizes from the poses.
void measure_camera_motion(CameraMotion& motion);

}  // namespace swirl::tracking
