#include "swirl/render/view.hpp"

#include <algorithm>

namespace swirl {

FrameAt::FrameAt(const Snapshot& snapshot, Frame frame) {
    if (frame == Frame::lab) return;
    m_ = m_frame(snapshot);
    angle_ = m_->angle();
}

View fitting_view(const Rectangle& rectangle, Frame frame, double container_radius,
                  double amplitude, double around) {
    const double wall = container_radius * (1.0 + wall_thickness);
    // The letters at M and at the angles stand outside the wall.
    const double lab = wall + amplitude + around * container_radius;
    const double turning = wall + std::max(0.11, around) * container_radius;
    const double reach = std::max(frame == Frame::lab ? lab : turning, 1e-300);
    const double half = 0.5 * std::min(rectangle.width, rectangle.height);
    return {frame,
            {rectangle.x + 0.5 * rectangle.width, rectangle.y + 0.5 * rectangle.height},
            half / (1.01 * reach),
            half};
}

}  // namespace swirl
