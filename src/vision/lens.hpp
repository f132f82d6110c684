// What a lens does to circles, and how to undo it.
//
// Radial distortion of one term about the middle of the picture: with q the place of a pixel
// relative to it in half heights, what is seen there lies at q (1 + k |q|²) in an ideal picture;
// k > 0 is a barrel, as wide lenses have it. A small circle at q then appears smaller by 1/(1 +
// kq²) across and by 1/(1 + 3kq²) along q, 1 − 2kq² on the average: that is how k is found, from
// the apparent sizes of equal balls all over the dish. The rim is one large circle whose middle
// moves little, and says much less.
//
// The middle of a circle's image is not the image of its middle (for the rim of a dish that differs
// by 2kR² of its distance from the middle of the picture): centre_of() undoes that as well.
#pragma once

#include <vector>

#include "swirl/math/vec2.hpp"

namespace swirl {

struct Lens {
    Vec2 middle{0.0, 0.0};
    double half = 1.0;  // of the height, pixels
    double k = 0.0, k_error = 0.0;

    Vec2 ideal(const Vec2& seen) const;
    Vec2 seen(const Vec2& ideal) const;
    /// Of a circle of which the image was fitted by one.
    struct Circle {
        Vec2 centre{0.0, 0.0};
        double radius = 0.0;
    };
    Circle ideal(const Circle& seen) const;
    /// How large a small circle of that radius appears there.
    double seen_radius(const Vec2& seen, double radius) const;
};

/// A small circle that was seen: where, and how large compared with others of its kind.
struct SeenSize {
    Vec2 centre;
    double size;
};
/// k from sizes. Not more than the sizes show: 0 where it is within four standard errors.
Lens lens_of(const std::vector<SeenSize>& sizes, const Vec2& middle, double half);

}  // namespace swirl
