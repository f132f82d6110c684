// Where the dish is at any time, as a camera found it: C(t) = S + A (cos φ, sin φ), φ = φ₀ ± Ωt.
//
// Pixels, y down; angles counter-clockwise from the right as one sees them in the picture. Errors
// are standard errors.
#pragma once

#include "swirl/math/vec2.hpp"

namespace swirl {

struct TrackedPath {
    Vec2 centre{0.0, 0.0};
    double amplitude = 0.0;
    double omega = 0.0;  // per unit of time, above 0
    double phase = 0.0;  // at time 0, rad
    bool clockwise = false;
    double centre_error = 0.0, amplitude_error = 0.0, omega_error = 0.0, phase_error = 0.0;
    double residual = 0.0;  // of a coordinate of the centres, standard deviation
    double used = 0.0;      // share of the pictures that agree with it

    double angle(double time) const { return phase + (clockwise ? -omega : omega) * time; }
    Vec2 at(double time) const;
};

/// Circle or polygon, as far as the path tells (dish.hpp).
struct PathPolygon {
    int sides = 0;         // 0: no polygon of up to most_sides
    int max_sides = 0;     // that would have been seen: 5 standard errors, twice a side
    double corners = 0.0;  // distance of the corners from the middle, pixels
};

}  // namespace swirl
