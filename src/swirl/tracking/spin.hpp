// How fast each disc turns, from its texture, by two estimators.
//
// PIV, as in the paper (SI, "Particle spin"): 16 interrogation windows on a 4 × 4 grid within the
// disc, each with the velocity v_i of its texture relative to the disc's centre: the peak of the
// normalised correlation to a pixel, then the shift of least squares (as in iterative PIV), so
// peaks are not locked to pixels. With ρ_i the place of window i relative to the centre and e_i its
// azimuthal direction,
//
//     average velocity = mean |v_i|             rolling included
//     average spin     = mean v_i · e_i         about the vertical alone
//
// (the paper writes sums), and the angular velocity about the vertical is Σ v_i·e_i / Σ ρ_i.
//
// Registration: the disc is a ball of its radius seen from above, and the turn about all three
// axes that takes one picture's texture to the next one's is found by Gauss and Newton over all of
// its pixels, a shift of the centre (by its error) found along.
//
// Texture is what differs from the mean picture of all discs: shading and highlights stay where
// they are when a ball turns, and would tell that it does not. Turns are measured over `step`
// pictures, a 32nd of a swirl or one picture; the spin at a picture is the mean of the steps
// before and after it.
//
// x to the right, y up, z to the camera: ω_z > 0 is counter-clockwise in the picture.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <vector>

#include "swirl/tracking/tracking.hpp"

namespace swirl {

struct DiscSpin {
    std::array<double, 3> turn{};  // registration: radians per picture
    double piv_turn = 0.0;         // about the vertical
    double piv_velocity = 0.0;     // mean |v_i|, pixels per picture
    double match = 0.0;            // correlation of the texture with the turned one
    bool known = false;
};

struct VideoSpins {
    int step = 1;  // pictures
    /// For each disc of each frame of the film's tracks. Where a step could not be measured it is
    /// what the disc had before and after.
    std::vector<std::vector<DiscSpin>> discs;
    double measured = 0.0;  // share of the steps that could be
    double match = 0.0;     // median
};

/// Reads the film once more. Throws Failure, Interrupted.
VideoSpins spins_of(const TrackedVideo& video, const TrackingSettings& settings);

}  // namespace swirl
