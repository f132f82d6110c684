// What a lens and a tilted camera do to circles, and how to undo it.
//
// Radial distortion of one term about the middle of the picture: with q the place of a pixel
// relative to it in half heights, what is seen there lies at q (1 + k |q|²) in an ideal picture;
// k > 0 is a barrel, as wide lenses have it. A small circle at q then appears smaller by 1/(1 +
// kq²) across and by 1/(1 + 3kq²) along q, 1 − 2kq² on the average: that is how k is found, from
// the apparent sizes of equal balls all over the dish. The rim is one large circle whose middle
// moves little, and says much less. A ball that is seen at an angle ψ to the camera's axis looks
// longer by 1/cos ψ away from it, larger by 1 + ψ²/4 on the average, which hides a k of tan²(v/2)/8
// with v the view angle of the picture's height; with v not known k is too small by that. Shade
// does the same: balls that are lit from one side look smaller where the wall is dark. Discs in
// contact know nothing of it (contact.hpp): where they tell a distortion, sizes count only as far
// as balls of so few pixels can be trusted, and not at all where the two contradict each other.
//
// A camera whose axis leans by θ sees what lies in the plane of the discs at P, in pixels relative
// to the middle, at
//
//     q = S P / (1 + p·P)
//
// with S a squeeze by e = 1 − cos θ along the lean and p of length sin θ / F along it, F the focal
// length in pixels (tilt.hpp finds both).
//
// The middle of a circle's image is not the image of its middle (for the rim of a dish that differs
// by 2kR² of its distance from the middle of the picture, and by pR²): ideal(Circle) undoes that as
// well.
#pragma once

#include <vector>

#include "swirl/math/vec2.hpp"

namespace swirl {

struct Lens {
    Vec2 middle{0.0, 0.0};
    double half = 1.0;  // of the height, pixels
    double k = 0.0, k_error = 0.0;
    // As sizes say it, whatever the error: k, and a perspective with its error.
    double apparent_k = 0.0, apparent_k_error = 0.0;
    double ball = 0.0;  // radius of the balls whose sizes these are, pixels
    // As distances of discs in contact say it; without an error: they do not.
    double contact_k = 0.0, contact_error = 0.0;
    Vec2 apparent_perspective{0.0, 0.0};
    double apparent_error = 0.0;
    double nearness = 0.0;       // 1/F, per pixel; 0: not known
    Vec2 squeeze{0.0, 0.0};      // e (cos 2ε, sin 2ε), ε its direction, y down
    Vec2 perspective{0.0, 0.0};  // p, per pixel

    bool tilted() const { return dot(squeeze, squeeze) + dot(perspective, perspective) > 0.0; }
    Vec2 ideal(const Vec2& seen) const;
    Vec2 seen(const Vec2& ideal) const;
    /// Of a circle of which the image was fitted by one.
    struct Circle {
        Vec2 centre{0.0, 0.0};
        double radius = 0.0;
    };
    Circle ideal(const Circle& seen) const;
    /// The circle that fits the image of one.
    Circle image(const Circle& ideal) const;
    /// k from sizes and nearness, and from contacts: 0 where it does not stand out from its error.
    void settle_distortion();
    /// How large a ball of that radius appears there.
    double seen_radius(const Vec2& seen, double radius) const;
};

/// A small circle that was seen: where, and how large compared with others of its kind.
struct SeenSize {
    Vec2 centre;
    double size;
};
/// k from sizes.
Lens lens_of(const std::vector<SeenSize>& sizes, const Vec2& middle, double half);

}  // namespace swirl
