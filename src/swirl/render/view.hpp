// From the plane of the discs to the page, in one of two frames of reference.
//
//   lab     The swirl centre S rests in the middle, and the container is carried around it.
//   M       The container's centre C rests in the middle. The image is turned so that S→C points
//           down, to the point M (paper, Fig. 1c). The container does not rotate in the lab, so it
//           turns clockwise here.
//
// y points down on the page and up in physics: the view converts.
#pragma once

#include <optional>

#include "swirl/math/unit_circle.hpp"
#include "swirl/math/vec2.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/render/canvas.hpp"

namespace swirl {

enum class Frame { lab, m };

/// Takes lab-frame quantities at one instant to the frame shown (measure/m_frame.hpp).
class FrameTransform {
  public:
    FrameTransform(const Snapshot& snapshot, Frame frame) {
        if (frame == Frame::lab) return;
        m_ = m_frame(snapshot);
        angle_ = m_->angle();
    }

    Vec2 position(const Vec2& lab) const { return m_ ? m_->position(lab) : lab; }
    Vec2 direction(const Vec2& lab) const { return m_ ? m_->rotate(lab) : lab; }
    double orientation(double lab) const { return lab - angle_; }
    /// The velocity of a disc in the frame shown.
    Vec2 velocity(const Vec2& lab_position, const Vec2& lab_velocity) const {
        return m_ ? m_->velocity(lab_position, lab_velocity) : lab_velocity;
    }

  private:
    std::optional<MFrame> m_;
    double angle_ = 0.0;
};

struct View {
    Frame frame;
    Vec2 centre;  // position of S (lab frame) or C (M-frame) on the page
    double pixels_per_unit;
    double half_side = 0.0;  // half of the view's square on the page; 0: unlimited

    Vec2 on_page(const Vec2& p) const {
        return {centre.x + pixels_per_unit * p.x, centre.y - pixels_per_unit * p.y};
    }
};

/// The largest view of a container that fits the rectangle, including wall and labels. `margin` is
/// additional space around the container, in units of its radius.
View fitting_view(const Rectangle& rectangle, Frame frame, double container_radius,
                  double amplitude, double margin = 0.0);

inline constexpr double full_turn = 2.0 * pi;
/// Thickness of the drawn wall, in units of the container's radius.
inline constexpr double wall_thickness = 0.045;

}  // namespace swirl
