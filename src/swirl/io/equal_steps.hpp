// Tracks at equal steps of time, from frames at uneven ones.
//
// `swirl track` gives every frame a time if the frame rate varies, or if the container moves
// unevenly: a hand swirls faster and slower, and stops. For an uneven motion the time is that of
// the phase of the container: φ/Ω with the mean Ω. Measurements relative to Ω need only the phase,
// and equal steps of it.
//
// Frame n of the result is at time n/fps. Positions relative to the container follow a cubic
// through the two frames before and after, with slopes from the neighbouring frames (Hermite,
// Catmull–Rom). Values that are not positions are those of the nearer frame. Limits: a disc that
// one of the two frames lacks is missing in the result; a container at rest adds no frames.
#pragma once

#include "swirl/io/tracks.hpp"

namespace swirl {

/// Unchanged if the frames have no times.
Tracks at_equal_steps(Tracks tracks, const TrackScale& scale);

}  // namespace swirl
