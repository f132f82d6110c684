// Position of the container at any time: C(t) = S + A (cos φ, sin φ), φ = φ₀ ± Ωt.
//
// Pixels, y down. Angles are counter-clockwise from the right, as seen in the frame. Errors are
// standard errors. container_path_fit.hpp finds the parameters.
#pragma once

#include "swirl/math/vec2.hpp"

namespace swirl::tracking {

struct TrackedPath {
    Vec2 centre{0.0, 0.0};
    double amplitude = 0.0;
    double omega = 0.0;  // angle per unit of time, positive
    double phase = 0.0;  // phase at time 0, rad
    bool clockwise = false;
    double centre_error = 0.0, amplitude_error = 0.0, omega_error = 0.0, phase_error = 0.0;
    double residual = 0.0;  // residual of a coordinate of the centres, standard deviation
    double used = 0.0;      // share of the frames that agree with the path

    double angle(double time) const { return phase + (clockwise ? -omega : omega) * time; }
    Vec2 at(double time) const;
};

}  // namespace swirl::tracking
