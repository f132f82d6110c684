// The drawing that explains the M-frame (paper, Fig. 1c): the dish in the lab with S, C and M; the
// same dish in the M-frame, where the wall turns clockwise; and the two forces that the M-frame
// brings: the centrifugal force, away from S everywhere, and the Coriolis force, to the right of a
// disc's velocity.
#pragma once

#include "swirl/physics/snapshot.hpp"
#include "swirl/render/canvas.hpp"
#include "swirl/render/theme.hpp"

namespace swirl {

/// `now` gives the container's size and place and the period; of its discs only `disc` is drawn, in
/// the third part, with its velocity in the M-frame and its Coriolis force.
void draw_frame_diagram(const Canvas& canvas, const Theme& theme, const Snapshot& now,
                        std::size_t disc);

}  // namespace swirl
