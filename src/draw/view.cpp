#include "draw/view.hpp"

#include <algorithm>

namespace swirl {

FrameAt frame_at(const Snapshot& snapshot, Frame frame) {
    if (frame == Frame::lab) return {{0.0, 0.0}, 0.0, 1.0, 0.0};
    const Vec2 c = snapshot.container_centre;
    // A dish that stands still has no direction S→C; its clock turns the frame.
    const double phase = dot(c, c) > 0.0         ? std::atan2(c.y, c.x)
                         : snapshot.period > 0.0 ? 2.0 * pi * snapshot.clock / snapshot.period
                                                 : 0.0;
    const double angle = -0.5 * pi - phase;
    return {c, angle, std::cos(angle), std::sin(angle)};
}

Vec2 velocity_in(const Snapshot& snapshot, std::size_t disc, Frame frame) {
    if (frame == Frame::lab) return snapshot.velocity(disc);
    const FrameAt at = frame_at(snapshot, frame);
    const double omega = snapshot.period > 0.0 ? 2.0 * pi / snapshot.period : 0.0;
    const Vec2 relative = snapshot.velocity(disc) - snapshot.container_velocity;
    const Vec2 arm = snapshot.position(disc) - snapshot.container_centre;
    return at.turned(relative - omega * perpendicular(arm));
}

View fitting_view(const Rectangle& rectangle, Frame frame, double container_radius,
                  double amplitude) {
    const double wall = container_radius * (1.0 + wall_thickness);
    const double room_for_labels = frame == Frame::m ? 0.11 * container_radius : 0.0;
    const double reach =
        std::max(frame == Frame::lab ? wall + amplitude : wall + room_for_labels, 1e-300);
    const double half = 0.5 * std::min(rectangle.width, rectangle.height);
    return {frame,
            {rectangle.x + 0.5 * rectangle.width, rectangle.y + 0.5 * rectangle.height},
            half / (1.01 * reach)};
}

}  // namespace swirl
