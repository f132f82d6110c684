// A sphere seen from above, lit from the upper left. Its pattern shows how it rolls: the eight
// patches of a beach ball, alternately in the given colour and a paler one, and a dot on each pole.
#pragma once

#include "swirl/physics/orientation.hpp"
#include "swirl/render/canvas.hpp"
#include "swirl/render/color.hpp"

namespace swirl {

/// `centre` and `radius` are in pixels. `orientation` takes the sphere's axes to those of the
/// image: x to the right, y upwards, z towards the viewer. In vector files the ball is a small
/// embedded image. Throws DrawFailure.
void draw_ball(const Canvas& canvas, const Vec2& centre, double radius, const Color& color,
               const Quaternion& orientation);

}  // namespace swirl
