// Dropped and duplicated frames, and a shaking camera, from the motion of the rim and the pixels.
#pragma once

#include <vector>

#include "swirl/math/vec2.hpp"
#include "track/video/tracked_path.hpp"

namespace swirl::tracking {

/// Two successive frames between which the container moved by an unusual angle.
struct FrameJump {
    std::size_t before = 0, after = 0;  // frame numbers
    double steps = 1.0;  // angle between them, relative to the steps around: 2 if one is missing
    bool duplicate = false;  // `after` has the pixels of `before`
    bool inserted = false;   // a duplicate that delays all later frames, and replaces no other
};

/// A dropped frame is detected by the angles of the centres about the path's centre, if these err
/// by less than a sixth of a step. A step is compared with its neighbours, since a hand does not
/// swirl at constant speed. A duplicate has nearly the same pixels as the frame before, and the rim
/// does not move. `frames` are the frame numbers of the centres, ascending. `changes`: for each
/// frame, how much its pixels differ from the frame before; empty or negative if unknown.
std::vector<FrameJump> find_frame_jumps(const std::vector<Vec2>& centres,
                                        const std::vector<std::size_t>& frames,
                                        const TrackedPath& path,
                                        const std::vector<double>& changes);

/// Displacement of the camera from frame to frame, rms of a coordinate, pixels. It follows from
/// second differences of the centres' distances from the path's centre, which change slowly on any
/// path.
double camera_shake(const std::vector<Vec2>& centres, const std::vector<std::size_t>& frames,
                    const TrackedPath& path);

}  // namespace swirl::tracking
