// A camera's tracks, read, mended, brought into our units, and held against what was said of the
// dish.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "swirl/cli/track_options.hpp"
#include "swirl/io/series.hpp"
#include "swirl/run/track_fit.hpp"

namespace swirl {

/// The frames, and what is to be said of them.
struct OpenedSeries {
    SnapshotSeries series;
    std::string remarks;            // a line each
    nlohmann::ordered_json camera;  // of tracks only
};

/// Throws WrongCall, Failure: also where more than the share `misfit` of the frames contradicts
/// what was said of the dish.
OpenedSeries open_tracks(const std::string& file, const TrackTexts& camera,
                         double misfit = default_misfit);

}  // namespace swirl
