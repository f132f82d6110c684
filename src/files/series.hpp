// Snapshots in order of time, asked for one by one: from a trajectory of ours, from a camera's
// tracks, from another program's dump. What exports and measurements take.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "swirl/physics/snapshot.hpp"

namespace swirl {

struct SnapshotSeries {
    std::uint64_t frames = 0;
    /// Half the width of a square about the swirl centre that holds the container at all times.
    double reach = 0.0;
    /// Every frame holds the same discs in the same order.
    bool same_discs = true;
    std::function<Snapshot(std::uint64_t)> frame;
};

class TrajectoryReader;

/// The frames of a trajectory; keeps the reader.
SnapshotSeries series_of(std::shared_ptr<TrajectoryReader> reader);

}  // namespace swirl
