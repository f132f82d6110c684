// Snapshots in order of time, as columns that numpy looks at without copying: [frame][disc][x, y].
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swirl/engine/simulation.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl::python {

/// Every frame has the same discs in the same order; everybody is held at the time of the frame.
struct Frames {
    std::size_t discs = 0;
    double period = 0.0, container_radius = 0.0;
    bool on_floor = false, are_spheres = false, lie_flat = false;
    std::vector<double> radius, mass, inertia;  // [disc]
    std::vector<std::int64_t> periods;          // [frame]
    std::vector<double> clock, time;
    std::vector<double> container_centre, container_velocity;            // [frame][x, y]
    std::vector<double> position, velocity, acceleration, rolling_spin;  // [frame][disc][x, y]
    std::vector<double> angle, spin;                                     // [frame][disc]

    std::size_t size() const { return clock.size(); }
    /// Whether it has the discs of the frames before it.
    bool fits(const Snapshot& snapshot) const { return size() == 0 || snapshot.size() == discs; }
    void reserve(std::size_t frames, std::size_t of_discs);
    void add(const Snapshot& snapshot);
    /// The same as of its snapshot, in less time.
    void add(const Simulation& simulation, const ContainerPath& path);
    void clear();
    Snapshot frame(std::size_t k) const;

  private:
    void begin(const Snapshot& snapshot);
    void add_moment(std::int64_t swirl, double now, const Vec2& centre, const Vec2& moves);
};

}  // namespace swirl::python
