// Snapshots in order of time with random access: from a trajectory, from a camera's tracks, or from
// another program's dump. Input of exports and measurements.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "swirl/math/real.hpp"
#include "swirl/measure/quantity.hpp"
#include "swirl/physics/mirrored.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

/// The states of the discs of one frame: 1 if the disc is pinned or resident at the wall, 0 if not,
/// NaN if that is unknown (run/pinned_series.hpp).
struct PinnedColumns {
    std::vector<double> pinned, resident;
};

struct SnapshotSeries {
    std::uint64_t frames = 0;
    /// Half the width of a square about the origin that contains the container at all times.
    double reach = 0.0;
    std::function<Snapshot(std::uint64_t)> frame;
    /// Frames whose discs differ from those of the frame before, ascending.
    std::vector<std::uint64_t> breaks = {};
    /// Smoothing reduces velocities (swirl/io/track_smoothing.hpp). The mean of ½u² per disc, with
    /// u relative to the container, is larger by this value than that of the smoothed velocities.
    double missing_energy = 0.0;
    /// False if the path of the container is known to have no M-frame.
    bool has_m_frame = true;
    /// The container goes round clockwise.
    bool clockwise = false;
    /// Velocities are differences of positions.
    bool velocities_are_differences = false;
    /// r, v and m of the frames.
    MeasuredUnits units = {};

    /// Null if these states are known in no frame. The result is valid until the next call.
    std::function<const PinnedColumns&(std::uint64_t frame)> pinned = nullptr;

    /// The frame as measurements see it: a clockwise dish in its mirror image.
    Snapshot observed(std::uint64_t k) const { return clockwise ? mirrored(frame(k)) : frame(k); }

    /// True if frames are not at equal steps of time: after every n-th event.
    bool has_uneven_times() const;

    /// True if every frame has the same discs in the same order.
    bool same_discs() const { return breaks.empty(); }
};

/// True if the container goes round the swirl centre clockwise, nearly on a circle. For frames
/// whose configuration is unknown.
inline bool moves_clockwise(const Snapshot& s) {
    const Vec2 C = s.container_centre, V = s.container_velocity;
    return cross(C, V) < -0.9 * square_root(dot(C, C) * dot(V, V));
}

/// r, v and m of frames whose configuration is unknown: those of their first disc, and the speed of
/// the container with 24 bits (run/config.hpp).
inline MeasuredUnits units_in(const Snapshot& s) {
    const double speed = square_root(dot(s.container_velocity, s.container_velocity));
    MeasuredUnits units;
    if (speed > 0.0) units.v = static_cast<double>(static_cast<float>(speed));
    if (s.size() == 0) return units;
    units.r = s.radius.front();
    units.m = s.mass.front();
    return units;
}

inline bool SnapshotSeries::has_uneven_times() const {
    constexpr std::uint64_t compared = 8;
    if (frames < compared || !same_discs()) return false;
    double shortest = std::numeric_limits<double>::infinity(), longest = 0.0;
    for (std::uint64_t k = 1; k < compared; ++k) {
        const double step = frame(k).time() - frame(k - 1).time();
        shortest = std::min(shortest, step);
        longest = std::max(longest, step);
    }
    return longest > 1.01 * shortest;
}

class TrajectoryReader;

/// The frames of a trajectory. The series shares ownership of the reader.
SnapshotSeries series_of(std::shared_ptr<TrajectoryReader> reader);

}  // namespace swirl
