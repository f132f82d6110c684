// The rotation of each disc from its texture.
//
// The disc is modelled as a sphere seen from above. Gauss–Newton over all its pixels finds the
// rotation about all three axes that maps the texture of one frame to that of another, together
// with a shift of the centre within its error.
//
// The texture is the deviation from the mean image of all discs. Shading and highlights do not turn
// with a sphere and would bias the rotation towards zero. Rotations are measured over `step`
// frames, about 1/32 of a period but at least one frame. The spin at a frame is the mean over the
// steps before and after it.
//
// x points right, y up, z to the camera: ω_z > 0 is counter-clockwise in the image.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <vector>

#include "track/video/tracking.hpp"

namespace swirl::tracking {

struct DiscSpin {
    std::array<double, 3> turn{};  // radians per frame
    double match = 0.0;            // correlation of the two textures after registration
    bool known = false;            // false: interpolated, or NaN if the disc was never measured
};

struct VideoSpins {
    int step = 1;  // frames
    /// For each disc of each frame of the tracks; gaps are interpolated in time.
    std::vector<std::vector<DiscSpin>> discs;
    double measured = 0.0;  // fraction of steps that could be measured
    double match = 0.0;     // median
};

/// Reads the video again. Throws Failure and Interrupted.
VideoSpins measure_spins(const TrackedVideo& video, const TrackingSettings& settings);

}  // namespace swirl::tracking
