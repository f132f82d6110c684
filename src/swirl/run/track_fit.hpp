// Test whether a camera's tracks fit the container with the given parameters
// (measure/container_fit.hpp).
#pragma once

#include <string>

#include "swirl/io/series.hpp"
#include "swirl/io/track_smoothing.hpp"
#include "swirl/io/tracks.hpp"

namespace swirl {

/// The share of frames that may contradict the given parameters.
inline constexpr double default_misfit = 0.05;

/// Results from a few hundred frames spread over the series.
struct TrackFit {
    double outside = 0.0;      // share of frames: a disc protrudes by more than a fifth of a radius
    double overlapping = 0.0;  // share of frames: two discs overlap by more than 15 %
    bool pairs_known = false;  // there are enough discs for two of them to touch at all times
    // In nine of ten frames, of many, no disc is near the wall, or no two discs are near each
    // other.
    bool never_at_wall = false, never_touching = false;
    double wall_gap = 0.0;                    // radii, median over frames
    double closest_pair = 1.0;                // distance in sums of radii, median over frames
    double disc_radius = 1.0;                 // median over frames, if the tracks give radii
    double phase = 0.0, fitting_phase = 0.0;  // given and best, in the image, degrees
    bool phase_fits = true;                   // the given phase fits about as well as the best one
    std::string advice;                       // how to correct the parameters, if they misfit
};

/// `y_down`: the direction of y in the image to which the advice refers.
TrackFit fit_of(const SnapshotSeries& series, const TrackScale& scale, bool y_down);

struct FittedSeries {
    SnapshotSeries series;
    TrackFit fit;
    TrackSmoothing smoothing;
    std::string
        remarks;  // what was repaired and smoothed, and what does not quite fit; one line each
};

/// The tracks as snapshots of a container, smoothed (track_smoothing.hpp).
SnapshotSeries smoothed_series(Tracks tracks, const TrackScale& scale, TrackSmoothing& smoothing);

/// The same, compared with the given parameters. Throws Failure, with a hint at the likely error,
/// if more than the share `misfit` of the frames contradicts them.
FittedSeries fitted_series(const Tracks& tracks, const TrackScale& scale, double misfit);

}  // namespace swirl
