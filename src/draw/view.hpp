// From the plane of the discs to the page, in either frame of reference.
//
//   lab     the swirl centre S stands still in the middle; the dish is carried round it
//   M       the dish's centre C stands still in the middle; the picture is turned so that the
//           direction S→C points down, to the point M (paper, Fig. 1c). The dish, which does not
//           turn in the lab, turns clockwise here.
//
// Pages count y downwards, physics counts it upwards: the view turns one into the other.
#pragma once

#include <cmath>

#include "draw/canvas.hpp"
#include "physics/snapshot.hpp"
#include "physics/unit_circle.hpp"
#include "physics/vec2.hpp"

namespace swirl {

enum class Frame { lab, m };

/// The frame at one instant: p ↦ turned by `angle` about `origin`.
struct FrameAt {
    Vec2 origin;
    double angle, cosine, sine;

    Vec2 position(const Vec2& p) const { return turned(p - origin); }
    Vec2 turned(const Vec2& v) const {
        return {cosine * v.x - sine * v.y, sine * v.x + cosine * v.y};
    }
    double orientation(double lab_angle) const { return lab_angle + angle; }
};

FrameAt frame_at(const Snapshot& snapshot, Frame frame);

/// Velocity as seen in the frame: in the M-frame without the frame's own rotation Ω.
Vec2 velocity_in(const Snapshot& snapshot, std::size_t disc, Frame frame);

struct View {
    Frame frame;
    Vec2 centre;  // on the page: S in the lab frame, C in the M-frame
    double pixels_per_unit;

    Vec2 on_page(const Vec2& p) const {
        return {centre.x + pixels_per_unit * p.x, centre.y - pixels_per_unit * p.y};
    }
};

/// The largest view of a dish of the given radius and swirl amplitude that fits the rectangle, wall
/// and labels included.
View fitting_view(const Rectangle& rectangle, Frame frame, double container_radius,
                  double amplitude);

/// Thickness of the drawn wall, in units of the container's radius.
inline constexpr double wall_thickness = 0.045;

}  // namespace swirl
