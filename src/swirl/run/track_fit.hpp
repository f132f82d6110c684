// Whether a camera's tracks and what was said of the dish belong together
// (measure/container_fit.hpp).
#pragma once

#include <string>

#include "swirl/io/series.hpp"
#include "swirl/io/track_smoothing.hpp"
#include "swirl/io/tracks.hpp"

namespace swirl {

/// The share of frames that may contradict what was said of the dish.
inline constexpr double default_misfit = 0.05;

/// Of a few hundred frames spread over the series: the shares of frames that say so.
struct TrackFit {
    double outside = 0.0;      // a disc sticks out of the dish by more than a fifth of its radius
    double overlapping = 0.0;  // two discs lie in each other by more than 15 %
    bool pairs_known = false;  // there are enough discs for two to touch at all times
    bool never_at_wall = false, never_touching = false;  // in nine frames of ten, of many
    double wall_gap = 0.0;                               // radii, of the frames the median
    double closest_pair = 1.0;                // in sums of radii, of the frames the median
    double disc_radius = 1.0;                 // of one that is told with the places, the median
    double phase = 0.0, fitting_phase = 0.0;  // of the picture, degrees
    bool phase_fits = true;                   // hardly better with the fitting one
    std::string advice;                       // of the phase, where it does not fit
};

/// `y_down`: in the picture that the advice is for.
TrackFit fit_of(const SnapshotSeries& series, const TrackScale& scale, bool y_down);

struct FittedSeries {
    SnapshotSeries series;
    TrackFit fit;
    TrackSmoothing smoothing;
    std::string remarks;  // what was mended, smoothed and what does not quite fit, a line each
};

/// The tracks as frames of a dish, smoothed (io/track_smoothing.hpp).
SnapshotSeries smoothed_series(Tracks tracks, const TrackScale& scale, TrackSmoothing& smoothing);

/// The same, held against what was said of the dish. Throws Failure where more than the share
/// `misfit` of the frames contradicts what was said of the dish, and says what is likely to be
/// wrong.
FittedSeries fitted_series(const Tracks& tracks, const TrackScale& scale, double misfit);

}  // namespace swirl
