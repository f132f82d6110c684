// The measurements on recorded frames: of a trajectory, of a camera's tracks, or of a run sampled
// as a camera would. Blocks are whole periods, as in a run. Recordings are often short, so errors
// are corrected for few blocks (few_blocks.hpp).
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
    RotationEstimates rotation;  // those by event are NaN
    MeasurementReports reports;
    std::uint64_t frames = 0;  // number after the skipped periods
    std::size_t discs = 0;     // maximum over the frames
    double periods = 0.0;
    double frames_per_period = 0.0;
    /// Values missing for the frame rate or the length: a warning without "warning:"; "" if none.
    std::string remark;
};

struct MeasuringControl {
    const std::atomic<bool>* stop = nullptr;
    std::function<void(std::uint64_t frame, std::uint64_t frames)> progress;
};

/// 0 for a single frame.
double frames_per_period(const SnapshotSeries& series);

/// True if the same discs are seen in enough frames in a row to determine which are pinned.
bool holds_tracks(const SnapshotSeries& series);

/// The frames of a recorded run, with what its parameters say about the path of the container.
SnapshotSeries series_of_run(const std::shared_ptr<TrajectoryReader>& reader);

/// The measurements among `names` that frames allow: none that needs every collision; without
/// tracks, none that follows a disc; without an M-frame, none that is defined in it.
std::vector<std::string> measurable(const std::vector<std::string>& names, bool tracked,
                                    bool has_m_frame = true);

/// The names must be measurable(). The first `skip` periods do not count. Throws Failure if no
/// frame remains, and Interrupted.
MeasuredSeries measure_series(const SnapshotSeries& series, const std::vector<std::string>& names,
                              double skip = 0.0, const MeasuringControl& control = {});

}  // namespace swirl
