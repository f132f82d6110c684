// What recorded frames tell: a run's measurements (measure/observation.hpp) taken frame by frame.
// The frames of one swirl make a block, from which the errors come.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "swirl/files/series.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/run/measurements.hpp"

namespace swirl {

/// Whether the same discs are seen long enough for their tracks to say anything.
bool holds_tracks(const SnapshotSeries& series);

struct MeasuredSeries {
    MeasurementReports reports;
    RotationEstimates rotation;
    std::uint64_t used = 0;  // frames
    std::size_t discs = 0;   // the most in a frame
};

/// Without the swirls to `skip`. `next(k)` is called before frame k is read; at the first false
/// what was measured until then is returned. The series holds at least one frame.
MeasuredSeries measure_series(const SnapshotSeries& series, std::vector<std::string> names,
                              double skip, const std::function<bool(std::uint64_t)>& next);

}  // namespace swirl
