// Dropped and duplicated frames, and a shaking camera, from the motion of the rim.
#pragma once

#include <vector>

#include "swirl/math/vec2.hpp"
#include "swirl/tracking/tracked_path.hpp"

namespace swirl {

/// Two successive frames between which the container moved by an unusual angle.
struct FrameJump {
    std::size_t before = 0, after = 0;  // frame numbers
    double steps = 1.0;  // angle between them, relative to the steps around: 2 if one is missing
};

/// Jumps are detected by the angles of the centres about the path's centre, if these err by less
/// than a sixth of a step. A step is compared with its neighbours, since a hand does not swirl at
/// constant speed. `frames` are the frame numbers of the centres, ascending.
std::vector<FrameJump> find_frame_jumps(const std::vector<Vec2>& centres,
                                        const std::vector<std::size_t>& frames,
                                        const TrackedPath& path);

/// Displacement of the camera from frame to frame, rms of a coordinate, pixels. It follows from
/// second differences of the centres' distances from the path's centre, which change slowly on any
/// path.
double camera_shake(const std::vector<Vec2>& centres, const std::vector<std::size_t>& frames,
                    const TrackedPath& path);

}  // namespace swirl
