// A sphere seen from above, lit from the upper left, with a pattern on it that is seen to roll: a
// beach ball's eight patches, in its colour and in a paler one, and a dot on each pole.
#pragma once

#include "swirl/physics/orientation.hpp"
#include "swirl/render/canvas.hpp"
#include "swirl/render/color.hpp"

namespace swirl {

/// `centre` and `radius` on the page; `turned` takes the sphere's axes to those of the picture,
/// x to the right, y upwards, z towards the eye. In vector files the ball is a small image.
void draw_ball(const Canvas& canvas, const Vec2& centre, double radius, const Color& color,
               const Quaternion& turned);

}  // namespace swirl
