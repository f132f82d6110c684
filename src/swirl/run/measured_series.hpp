// What is measured on recorded frames: of a trajectory of ours, of a camera's tracks, of a run that
// is seen as a camera would see it. Blocks are whole swirls, as in a run.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "swirl/io/series.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/run/measurements.hpp"

namespace swirl {

struct MeasuredSeries {
    RotationEstimates rotation;  // by time; nothing is known by event
    MeasurementReports reports;
    std::uint64_t frames = 0;  // that count
    std::size_t discs = 0;     // at most
    double periods = 0.0;

    double frames_per_swirl() const { return periods > 0.0 ? double(frames) / periods : 0.0; }
};

struct MeasuringControl {
    const std::atomic<bool>* stop = nullptr;
    std::function<void(std::uint64_t frame, std::uint64_t frames)> progress;
};

/// Whether the same discs are seen long enough for their tracks to say anything.
bool holds_tracks(const SnapshotSeries& series);

/// Those of the names that such frames can tell: nothing that is made of the collisions themselves,
/// and, without tracks, nothing that follows a disc.
std::vector<std::string> measurable(const std::vector<std::string>& names, bool tracked);

/// The names must be measurable(); the first `skip` swirls do not count. Throws Failure where there
/// is no frame left, Interrupted.
MeasuredSeries measure_series(const SnapshotSeries& series, const std::vector<std::string>& names,
                              double skip = 0.0, const MeasuringControl& control = {});

/// There are as many frames per swirl as the criteria for pinned discs are made for.
bool fits_criteria(double frames_per_swirl);

}  // namespace swirl
