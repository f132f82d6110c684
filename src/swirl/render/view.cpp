#include "swirl/render/view.hpp"

#include <algorithm>

namespace swirl {

View fitting_view(const Rectangle& rectangle, Frame frame, double container_radius,
                  double amplitude, double margin) {
    const double wall = container_radius * (1.0 + wall_thickness);
    // In the M-frame the letter M and the angles stand outside the wall, within this margin.
    constexpr double label_margin = 0.11;
    const double lab = wall + amplitude + margin * container_radius;
    const double m_frame = wall + std::max(label_margin, margin) * container_radius;
    const double reach = std::max(frame == Frame::lab ? lab : m_frame, 1e-300);
    const double half = 0.5 * std::min(rectangle.width, rectangle.height);
    return {frame,
            {rectangle.x + 0.5 * rectangle.width, rectangle.y + 0.5 * rectangle.height},
            half / (1.01 * reach),
            half};
}

}  // namespace swirl
