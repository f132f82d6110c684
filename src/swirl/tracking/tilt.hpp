// A tilted camera, from the rim: a circle of constant size in a plane, wherever the dish is.
//
// Seen at an angle (lens.hpp) the rim is an ellipse, squeezed by e, and it grows and is sheared as
// the dish comes nearer: with C its middle and n the direction of a place on it, relative to the
// middle of the picture,
//
//     Δr = ½ e R (1 − cos 2(φ − ε)) − R p·C − R (p·n)(n·C)     and what shifts its middle
//
// So a few dozen pictures of one swirl tell e and p apart: one is the same in all of them, the
// other goes round with C. Both are found together with the radius and every picture's middle, by
// Gauss–Newton with Tukey's weights, with the distortion as given (a given k is undone first).
//
// θ follows from e, and with p the focal length; if that is given, θ from p too, and better.
//
// Errors: how far pictures scatter; and what no tilt explains, the harmonics 3 … 8 of the rim's
// mean outline, since e may err by as much, and p by as much over the way of the dish. A dish that
// is not round looks like a squeeze, which p does not share: `oval`.
//
// Limits: the rim lies in one plane, and discs in another, lower or higher by h, where everything
// is shifted by h sin θ and larger by h/F than it says. The shift is found from where discs are
// stopped (tracking.cpp), what is larger is not.
#pragma once

#include <optional>
#include <vector>

#include "swirl/tracking/dish.hpp"
#include "swirl/tracking/lens.hpp"

namespace swirl {

struct Tilt {
    double angle = 0.0, angle_error = 0.0;            // of the camera's axis, rad; 0: not seen
    double below = 0.0;                               // two standard errors more than was seen, rad
    double towards = 0.0, towards_error = 0.0;        // where the camera stands, rad as phases are
    double view_angle = 0.0, view_angle_error = 0.0;  // of the picture's height, rad; 0: not known
    double squeeze_error = 0.0, perspective_error = 0.0;
    bool oval = false;  // the rim is squeezed elsewhere than nearness says
};

/// What somebody knows of a camera; radians.
struct KnownCamera {
    std::optional<double> tilt, towards, view_angle;
};

/// Squeeze and perspective of the lens, as far as they stand out from their errors by a factor of
/// four, and the distortion that this leaves; the rim is found with that lens from then on.
Tilt find_tilt(const std::vector<Picture>& pictures, const KnownCamera& known, Rim& rim,
               Lens& lens);

}  // namespace swirl
