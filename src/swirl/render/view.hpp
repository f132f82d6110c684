// From the plane of the discs to the page, in either frame of reference.
//
//   lab     the swirl centre S stands still in the middle; the dish is carried round it
//   M       the dish's centre C stands still in the middle; the picture is turned so that the
//           direction S→C points down, to the point M (paper, Fig. 1c). The dish, which does not
//           turn in the lab, turns clockwise here.
//
// Pages count y downwards, physics counts it upwards: the view turns one into the other.
#pragma once

#include <optional>

#include "swirl/math/vec2.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/render/canvas.hpp"

namespace swirl {

enum class Frame { lab, m };

/// The frame at one instant: the lab as it is, or the M-frame of measure/m_frame.hpp.
class FrameAt {
  public:
    FrameAt(const Snapshot& snapshot, Frame frame);

    Vec2 position(const Vec2& lab) const { return m_ ? m_->position(lab) : lab; }
    Vec2 turned(const Vec2& lab) const { return m_ ? m_->rotate(lab) : lab; }
    double orientation(double lab) const { return lab - angle_; }
    /// Of a disc, as seen in the frame.
    Vec2 velocity(const Vec2& lab_position, const Vec2& lab_velocity) const {
        return m_ ? m_->velocity(lab_position, lab_velocity) : lab_velocity;
    }

  private:
    std::optional<MFrame> m_;
    double angle_ = 0.0;
};

struct View {
    Frame frame;
    Vec2 centre;  // on the page: S in the lab frame, C in the M-frame
    double pixels_per_unit;
    double half_side = 0.0;  // of the square on the page that belongs to it; 0: no end

    Vec2 on_page(const Vec2& p) const {
        return {centre.x + pixels_per_unit * p.x, centre.y - pixels_per_unit * p.y};
    }
};

/// The largest view of a dish of the given radius and swirl amplitude that fits the rectangle, wall
/// and labels included; `around` is further room round the dish, in units of its radius.
View fitting_view(const Rectangle& rectangle, Frame frame, double container_radius,
                  double amplitude, double around = 0.0);

/// Thickness of the drawn wall, in units of the container's radius.
inline constexpr double wall_thickness = 0.045;

}  // namespace swirl
