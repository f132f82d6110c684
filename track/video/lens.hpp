// The effect of a lens and a tilted camera on circles, and its correction.
//
// Radial distortion has one term about the centre of the image. With q the position of a pixel
// relative to that centre, in half heights of the image, an ideal camera would show the same point
// at q (1 + k |q|²); k > 0 is a barrel distortion, as wide lenses have it.
//
// k from sizes: a small circle at q appears smaller by 1/(1 + kq²) across q and by 1/(1 + 3kq²)
// along q, on average by 1 − 2kq². The apparent sizes of equal balls all over the container thus
// give k. The rim is one large circle whose centre moves little, and determines k much worse.
//
// Two effects bias these sizes. A ball seen at an angle ψ to the camera's axis looks longer by
// 1/cos ψ away from the axis, larger by 1 + ψ²/4 on average. This makes k too small by tan²(v/2)/8,
// with v the view angle of the image's height. Balls lit from one side look smaller where the wall
// is dark, too.
//
// k from contacts: distances of discs in contact have neither bias (contact_distance.hpp). If
// contacts determine k, the sizes get only the weight that the image resolution of the balls
// permits. If sizes and contacts contradict each other, the sizes get no weight.
//
// Tilt: a camera whose axis is tilted by θ sees a point P of the plane of the discs (pixels,
// relative to the image centre) at
//
//     q = S P / (1 + p·P)
//
// with S a squeeze by e = 1 − cos θ along the tilt and p of length sin θ / F along it, F the focal
// length in pixels (tilt.hpp finds both).
//
// Rolling shutter: while rows are read, the container moves on. In one frame it shows a point at
//
//     q + a (cos α − 1) + b sin α,   α = s·(q − c)
//
// with c the container's centre, a the way to it from the path's centre, b this arm turned by 90
// degrees clockwise in the image, and s the angle per pixel by which it goes round meanwhile.
//
// The centre of a circle's image is not the image of its centre: for the rim of a container of
// radius R they differ by 2kR² times its distance from the image centre, and by pR².
// ideal(Circle) corrects that, too.
#pragma once

#include <vector>

#include "swirl/math/vec2.hpp"

namespace swirl::tracking {

struct Lens {
    Vec2 image_centre{0.0, 0.0};
    double half_height = 1.0;  // height of the image, pixels
    double k = 0.0, k_error = 0.0;
    // From sizes, even if the values are not significantly different from zero.
    double size_k = 0.0, size_k_error = 0.0;
    Vec2 size_perspective{0.0, 0.0};
    double size_perspective_error = 0.0;
    double ball_radius = 0.0;  // radius of the balls that were measured, pixels
    // From discs in contact; an error of 0: not determined.
    double contact_k = 0.0, contact_k_error = 0.0;
    Vec2 squeeze{0.0, 0.0};      // e (cos 2ε, sin 2ε), ε its direction, y down
    Vec2 perspective{0.0, 0.0};  // p, per pixel
    Vec2 shutter{0.0, 0.0};      // s, rad per pixel; 0: all rows are read at once
    double shutter_error = 0.0;
    Vec2 arm{0.0, 0.0}, pivot{0.0, 0.0};  // a and c; set for one frame

    bool tilted() const { return dot(squeeze, squeeze) + dot(perspective, perspective) > 0.0; }
    bool rolls() const { return dot(shutter, shutter) > 0.0; }
    /// For the frame with the container at `centre`, `way` from the path's centre.
    Lens in_frame(const Vec2& centre, const Vec2& way) const;
    /// By how much the shutter displaces what it shows at `seen`.
    Vec2 rolled(const Vec2& seen) const;
    /// Position in the image of an ideal camera that looks straight down.
    Vec2 ideal(const Vec2& seen) const;
    Vec2 seen(const Vec2& ideal) const;
    struct Circle {
        Vec2 centre{0.0, 0.0};
        double radius = 0.0;
    };
    /// The circle whose image `seen` fits.
    Circle ideal(const Circle& seen) const;
    /// The circle that fits the image of `ideal`.
    Circle image(const Circle& ideal) const;
    /// Sets k and k_error from sizes and contacts; k is 0 if it does not stand out from its error.
    void combine_distortions();
    /// Apparent radius of a ball of this radius.
    double seen_radius(const Vec2& seen, double radius) const;
};

struct ApparentSize {
    Vec2 centre;
    double size;  // radius, relative to that of its species
};
/// Determines size_k, size_perspective and their errors, and k from them.
Lens fit_lens(const std::vector<ApparentSize>& sizes, const Vec2& image_centre, double half_height);

}  // namespace swirl::tracking
