// Positions and velocities of tracks with less noise.
//
// Camera positions are noisy, and differences between frames amplify the noise. With 26 pixels per
// radius and 511 frames per period, 0.2 pixels of noise add a quarter of the container's speed to
// every velocity. A fixed window would blur collisions, where velocities jump, so the window
// adapts.
//
//   path        Positions are smoothed relative to the container, which moves on its circle. So the
//               motion of the container itself is not smoothed away.
//   noise       Per coordinate, from the lower quartile of the second differences; those with a
//               collision lie above it. An offset that hardly changes from frame to frame, such as
//               the shading of a sphere, is not noise and does not affect velocities.
//   smoother    Kalman filter and de Jong's smoother (1989, doi:10.1080/01621459.1989.10478853) for
//               a disc that moves in a straight line and is kicked occasionally: at some time
//               between two frames its velocity changes by a normal vector of variance q.
//   kicks       q has two values: large for a rebound, small for a push that matches the curvature
//               of the path. For each pair of frames, the disturbance smoother's u/n, of variance
//               1/n − q, and the overall frequency of kicks give the probability of a kick. Kicks
//               and smoothing are iterated a few times.
//   energy      A smoothed velocity is the mean over the velocities that the positions allow. So
//               the mean square of velocities exceeds the square of the mean by the variance of
//               each coordinate. `missing_energy` is this excess; add it to any mean of squared
//               velocities.
//
// The standard errors are those of the smoother for a disc in flight; they take the kicks that were
// found as given. At a collision the velocity jumps within one frame, and the error is a part of
// the jump.
//
// Units: pixels, and pixels per unit of time for velocities, as in TrackFrame. Limits: below
// `min_frames_per_period` a disc collides about once per frame, which cannot be
// distinguished from noise. Then nothing is smoothed, nor if velocities are given or there are only
// a few hundred positions.
#pragma once

#include <cmath>

#include "swirl/io/tracks.hpp"

namespace swirl {

/// Tracks with fewer frames per period are not smoothed.
inline constexpr double min_frames_per_period = 100.0;

struct TrackSmoothing {
    bool done = false;
    // Per coordinate, over all discs and frames; pixels.
    double noise = 0.0, position_error = 0.0;
    /// Deviation of paths from a straight line between two frames, pixels. A lower noise estimate
    /// is replaced by this value.
    double bend = 0.0;
    double window = 1.0;          // frames whose mean would be as accurate as a smoothed position
    double kicks = 0.0;           // detected kicks per disc and frame
    double missing_energy = 0.0;  // excess of ½⟨u²⟩ over that of the velocities

    /// Standard error per coordinate, relative to the container's speed.
    double velocity_error() const { return std::sqrt(missing_energy); }
};

/// Replaces positions by smoothed ones and sets velocities with standard errors.
TrackSmoothing smooth(Tracks& tracks, const TrackScale& scale);

}  // namespace swirl
