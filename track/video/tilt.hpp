// The tilt of the camera, from the rim: a circle of constant size in one plane, wherever the
// container is.
//
// Seen at an angle (lens.hpp), the rim is an ellipse, squeezed by e. It grows and is sheared as
// the container comes nearer. With C its centre, relative to the image centre, and n the direction
// of a point on it,
//
//     Δr = ½ e R (1 − cos 2(φ − ε)) − R p·C − R (p·n)(n·C)     and a shift of its centre
//
// A few dozen frames of one period thus determine e and p separately: e is constant, and the effect
// of p goes round with C. Both are fitted together with the radius and the centre in every frame,
// by Gauss–Newton with Tukey's weights. A known distortion k is corrected first.
//
// θ follows from e, and the side on which the camera stands from p.
//
// A rolling shutter makes Δr = (s·n) R (n·v). This has the period of p's effect, but its ellipse
// has another phase relative to its size. If s stands out, it is fitted together with the others.
//
// Errors have two parts: the scatter between frames; and what no tilt explains, the harmonics 3 … 8
// of the rim's mean outline. e may err by as much as these, and p by as much per amplitude of the
// path. A container that is not round looks like a squeeze, which p contradicts (`oval`).
//
// Limits: the discs lie in another plane than the rim, lower or higher by h. There everything is
// shifted by h sin θ and larger by h/F. The shift is determined from where the wall stops discs
// (wall_fit.cpp), the change of size is not.
#pragma once

#include <optional>
#include <vector>

#include "track/video/container_rim.hpp"
#include "track/video/lens.hpp"

namespace swirl::tracking {

/// Angles in radians; directions as phases, counter-clockwise from the right.
struct Tilt {
    double angle = 0.0, angle_error = 0.0;      // that of the camera's axis; 0: not detected
    double below = 0.0;                         // upper limit: two standard errors more
    double towards = 0.0, towards_error = 0.0;  // direction where the camera stands
    double squeeze_error = 0.0, perspective_error = 0.0;
    bool oval = false;  // squeeze and perspective have different directions
};

/// What the user knows of the camera; radians.
struct KnownCamera {
    std::optional<double> tilt, towards;
};

/// Sets squeeze, perspective and shutter of `lens`, if they exceed their errors by a factor of
/// four, and the distortion that follows. `rim` gets this lens, with which it is found from then
/// on.
Tilt find_tilt(const std::vector<PreparedFrame>& frames, const KnownCamera& known,
               ContainerRim& rim, Lens& lens);

}  // namespace swirl::tracking
