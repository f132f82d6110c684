// The rim of the container in a video: a circle of constant size that goes round a circle.
//
//   survey   the circle with the most votes in a few frames spread over the video, among those that
//            move as a swirled container does; the edge of a table does not
//   find     in each frame: votes for the known radius, then a fit to the edge
//
// Pixels, y down.
#pragma once

#include <optional>
#include <vector>

#include "track/video/circles.hpp"
#include "track/video/lens.hpp"

namespace swirl::tracking {

/// For errors about a container whose centre does not go round a circle.
inline constexpr const char* no_circle_hint =
    "hint: move the container on a circle, which may drift, and not on a polygon of few sides; "
    "--motion-out without --out records the motion on any path that repeats";

struct ContainerRim {
    double radius = 0.0;  // corrected by `lens`, if there is one
    Polarity polarity = 1;
    double support = 0.0;
    Vec2 path_centre{0.0, 0.0};
    double amplitude = 0.0;         // amplitude of the path, approximately; 0: it is not a circle
    bool rough = false;             // its centres are far from a circle, as if the camera shook
    bool second_container = false;  // another circle of this size moves as well
    std::optional<Lens> lens;       // set if the camera is tilted, or its shutter rolls
};

/// Blur of frames in which the rim is searched, pixels, against noise: its edge is broader.
inline constexpr double rim_blur = 1.0;

/// `frames` spread over the video. Throws Failure with the likely cause if no rim is found.
ContainerRim survey_container_rim(const std::vector<PreparedFrame>& frames);
/// The same, but returns none if no rim moves along a circle. If `shaken`, a rough path is better
/// than none.
std::optional<ContainerRim> find_moving_rim(const std::vector<PreparedFrame>& frames, bool shaken);

/// The same for a rim that moves on any path; its amplitude is 0. Throws Failure if none moves.
ContainerRim find_rim_on_any_path(const std::vector<PreparedFrame>& frames);

/// The rim in one frame; `good` is false if it was not found.
CircleFit find_container_rim(const PreparedFrame& frame, const ContainerRim& rim);

// The edge of a large circle as a lens and a tilted camera show it (lens.hpp).
//
// On rays from the circle's centre, the steepest ascent or descent near the predicted image of the
// circle is found to a fraction of a pixel. Each of these points, corrected by the lens, lies on
// the circle itself.

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
