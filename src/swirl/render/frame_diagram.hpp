// The diagram that explains the M-frame (paper, Fig. 1c), in three parts:
//   - the container in the lab, with S, C and M;
//   - the same container in the M-frame, where the wall turns clockwise;
//   - the two inertial forces of the M-frame. The centrifugal force points away from S. The
//     Coriolis force points to the right of a disc's velocity.
#pragma once

#include "swirl/physics/snapshot.hpp"
#include "swirl/render/canvas.hpp"
#include "swirl/render/theme.hpp"

namespace swirl {

/// `now` gives the period and the container's size and position. The only disc drawn is number
/// `disc`. It is in the third part, with its velocity in the M-frame and its Coriolis force.
void draw_frame_diagram(const Canvas& canvas, const Theme& theme, const Snapshot& now,
                        std::size_t disc);

}  // namespace swirl
