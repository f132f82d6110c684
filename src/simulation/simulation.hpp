// The event machine: which event comes next, and what it does.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "physics/collision_law.hpp"
#include "physics/container_path.hpp"
#include "physics/disc.hpp"
#include "physics/snapshot.hpp"
#include "simulation/event.hpp"

namespace swirl {

/// Everything that determines a trajectory. Disc times count from the start of the first swirl.
struct Scene {
    std::vector<Disc> discs;
    ContainerPath path;
    double container_radius;
    Surface disc_surface, wall_surface;
};

struct EventCounts {
    std::uint64_t disc_disc = 0, disc_wall = 0, path_vertex = 0;
    std::uint64_t total() const { return disc_disc + disc_wall + path_vertex; }
};

class Simulation {
  public:
    explicit Simulation(const Scene& scene);
    ~Simulation();
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;

    /// Executes the next event and says what it was.
    Event step();

    /// Executes every event up to the given moment, and stands there. Discs are not touched, so
    /// looking never changes a bit.
    void advance_to(std::int64_t swirls, double clock);

    std::int64_t swirls() const;
    double clock() const;
    const EventCounts& events() const;

    /// All discs, the container, and the time, now.
    Snapshot snapshot() const;
    /// Brings a snapshot taken earlier from this simulation up to date after one step: touches only
    /// the discs of that event (all of them when a new swirl began).
    void refresh(Snapshot& snapshot, const Event& event) const;

    /// 64-bit hash of every disc's state, the leg and the time. Equal states, equal hash.
    std::uint64_t state_hash() const;

  private:
    struct Machine;
    std::unique_ptr<Machine> machine_;
};

}  // namespace swirl
