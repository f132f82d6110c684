// Places and velocities of tracks freed from the noise of places, as far as the tracks let one.
//
// A camera's places scatter, and differences between pictures blow that up: at 26 pixels a radius
// and 511 pictures a swirl 0.2 pixels of noise are a quarter of the dish's speed in every velocity.
// A fixed window would blunt the collisions, at which velocities jump, so the window follows them.
//
//   course      what is smoothed is a place relative to the dish, which rides on its circle; so the
//               swirl itself is not smoothed away
//   noise       of a coordinate, from the lower quartile of the second differences: those with a
//               collision in them are the upper ones. What hardly changes from picture to picture,
//               as the shade of a ball does, is none, and does not hurt velocities
//   smoother    Kalman's filter and de Jong's smoother (1989, doi:10.1080/01621459.1989.10478853)
//               for a disc that goes straight on and is kicked now and then: at some moment between
//               two pictures its velocity changes by a normal vector of variance q
//   kicks       q is large or small, of a rebound or of a push as the swirl's curvature asks for.
//               Which it was, between each two pictures, is told by how much of a kick all places
//               ask for there (the disturbance smoother's u/n, of variance 1/n − q), and how
//               often kicks are by all tracks; a few rounds of both
//   energy      a smoothed velocity is the mean of those that the places allow, so the mean square
//               of velocities is larger than the square of the mean, by the variance of each
//               coordinate: `missing_energy`, which belongs to whatever is made of squares of
//               velocities
//
// The standard errors are those of the smoother, for the kicks as they were found: of a disc in
// flight. At a collision the velocity jumps within one picture, and is off by a part of the jump.
//
// Units: pixels, and velocities in pixels per unit of time, as in TrackFrame. Limits: below
// `fewest_pictures` per swirl a disc collides about as often as it is seen, noise cannot be told
// from that, and nothing is done; nor where velocities are given, or places are fewer than some
// hundred.
#pragma once

#include <cmath>

#include "swirl/io/tracks.hpp"

namespace swirl {

inline constexpr double min_pictures = 100.0;

struct TrackSmoothing {
    bool done = false;
    // Of a coordinate, over all discs and pictures; pixels.
    double noise = 0.0, place_error = 0.0;
    /// By which courses bend between two pictures, pixels: a noise below that is taken to be that.
    double bend = 0.0;
    double window = 1.0;          // pictures whose mean would be as good as a smoothed place
    double kicks = 0.0;           // per disc and picture, those that could be told
    double missing_energy = 0.0;  // ½⟨u²⟩ is so much more than that of the velocities, in our units

    /// Of a coordinate, in the container's speed.
    double velocity_error() const { return std::sqrt(missing_energy); }
};

/// Puts smoothed places and velocities with errors into the tracks.
TrackSmoothing smooth(Tracks& tracks, const TrackScale& scale);

}  // namespace swirl
