// Snapshots in order of time, asked for one by one: from a trajectory of ours, from a camera's
// tracks, from another program's dump. What exports and measurements take.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "swirl/physics/snapshot.hpp"

namespace swirl {

struct SnapshotSeries {
    std::uint64_t frames = 0;
    /// Half the width of a square about the swirl centre that holds the container at all times.
    double reach = 0.0;
    std::function<Snapshot(std::uint64_t)> frame;
    /// Frames whose discs are not those of the frame before, ascending.
    std::vector<std::uint64_t> breaks = {};
    /// ½⟨u²⟩ of a disc, u relative to the container, is so much more than that of the velocities,
    /// where they are smoothed (track_smoothing.hpp).
    double missing_energy = 0.0;

    /// Every frame holds the same discs in the same order.
    bool same_discs() const { return breaks.empty(); }
};

class TrajectoryReader;

/// The frames of a trajectory; keeps the reader.
SnapshotSeries series_of(std::shared_ptr<TrajectoryReader> reader);

}  // namespace swirl
