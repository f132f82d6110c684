// Snapshots in order of time, as columns that numpy reads without copying: [frame][disc][x, y].
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "swirl/engine/simulation.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/run/pinned_series.hpp"
#include "swirl/run/ramp.hpp"

namespace swirl::python {

/// Every frame has the same discs in the same order, at the time of the frame.
struct Frames {
    std::size_t discs = 0;
    double period = 0.0, container_radius = 0.0;
    bool on_floor = false, are_spheres = false, lie_flat = false;
    std::vector<double> radius, mass, inertia, can_spin;                 // [disc]
    std::vector<std::int64_t> periods;                                   // [frame], whole periods
    std::vector<double> clock, time;                                     // [frame]
    std::vector<double> container_centre, container_velocity;            // [frame][x, y]
    std::vector<double> position, velocity, acceleration, rolling_spin;  // [frame][disc][x, y]
    std::vector<double> angle, spin;                                     // [frame][disc]

    /// Where the frames come from, and their numbers there. Without a recording they are one.
    std::shared_ptr<PinnedSeries> recording;
    std::vector<std::uint64_t> numbers;
    /// The frames in the lab, of which these are a transformation; null for others.
    std::shared_ptr<const Frames> in_lab;

    std::size_t size() const { return clock.size(); }
    /// True if the snapshot has as many discs as the frames.
    bool fits(const Snapshot& snapshot) const { return size() == 0 || snapshot.size() == discs; }
    void reserve(std::size_t frames, std::size_t of_discs);
    void add(const Snapshot& snapshot);
    /// Adds the present state. Equals add(simulation.snapshot()), but is faster.
    void add(const Simulation& simulation, const ContainerPath& path,
             const PeriodChange& since = {});
    Snapshot frame(std::size_t k) const;
    /// The states of the discs in all frames, frame by frame.
    PinnedColumns pinned() const;

  private:
    void begin(const Snapshot& snapshot);
    void add_time(std::int64_t whole_periods, double clock_now, const PeriodChange& since,
                  const Vec2& centre, const Vec2& centre_velocity);
};

/// A single snapshot, in the same columns.
struct SingleFrame {
    Frames frames;
    // The frames that it was taken from, and its number there; null for others.
    std::shared_ptr<const Frames> taken_from = nullptr;
    std::size_t number = 0;

    explicit SingleFrame(const Snapshot& snapshot) {
        frames.reserve(1, snapshot.size());
        frames.add(snapshot);
    }
    Snapshot snapshot() const { return frames.frame(0); }
    /// NaN for all discs of a simulation, since it takes later frames.
    PinnedColumns pinned() const;
};

}  // namespace swirl::python
