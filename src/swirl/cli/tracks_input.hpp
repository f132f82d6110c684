// Reads the tracks of a camera: repairs them, converts units and checks them against the container.
#pragma once

#include <optional>
#include <string>

#include "swirl/cli/track_options.hpp"
#include "swirl/io/series.hpp"
#include "swirl/run/track_fit.hpp"

namespace swirl {

/// Frames, with remarks on them.
struct OpenedSeries {
    SnapshotSeries series;
    std::string remarks;          // one per line
    std::string camera = "null";  // JSON: repairs, fit and smoothing; tracks only
    /// The tracks cut at the likeliest swaps of IDs that `swirl track` has named, if there are any.
    std::optional<SnapshotSeries> without_swaps;
    std::size_t swaps = 0;  // their number
};

/// Throws UsageError and Failure, also if more than the fraction `misfit` of the frames contradicts
/// the given container.
OpenedSeries open_tracks(const std::string& file, const TrackTexts& camera,
                         double misfit = default_misfit);

}  // namespace swirl
