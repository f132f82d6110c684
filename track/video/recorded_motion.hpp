// One period of the container's motion, averaged over the periods of a video, on any closed path:
//
//     C(t) = S + Σ a_n cos nΩt + b_n sin nΩt,   n = 1 … H,
//
// fitted to the centres of the rim. Ω is the highest frequency at which the motion repeats. H is
// the highest harmonic that exceeds five standard errors, at most 12. Tukey's weights exclude
// outliers.
//
// Errors. If the residuals are noise, the variance of a coordinate of the path is (2H + 1) σ²/K for
// K frames. If the periods differ from each other by more than the noise, their scatter gives the
// error instead: every period is fitted alone, as P independent estimates.
//
// Pixels, y down.
#pragma once

#include <vector>

#include "swirl/math/vec2.hpp"

namespace swirl::tracking {

struct RecordedMotion {
    Vec2 centre{0.0, 0.0};           // S, the mean over a period
    std::vector<Vec2> cosine, sine;  // a_n and b_n
    double start = 0.0;              // time of the first frame, where the period begins
    double omega = 0.0, omega_error = 0.0;
    double periods = 0.0;      // that the frames cover
    double residual = 0.0;     // residual of a coordinate of the centres, standard deviation
    double scatter = 0.0;      // scatter of a coordinate between periods, rms
    double point_error = 0.0;  // error of a coordinate of the path, standard error
    double used = 0.0;         // share of the frames that agree with the path

    double period() const;
    double period_error() const;
    /// C − S at a share of the period.
    Vec2 offset(double share) const;
    /// C at a time.
    Vec2 at(double time) const;
    /// Largest distance from S.
    double amplitude() const;
};

/// Centres of the rim and the times of their frames, ascending. `frames` counts all frames, also
/// those without a rim. Throws Failure if the container rests, if the motion does not repeat, if
/// there are fewer than two periods, or if a part of the period has no frame.
RecordedMotion average_motion(const std::vector<Vec2>& centres, const std::vector<double>& times,
                              std::size_t frames);

}  // namespace swirl::tracking
