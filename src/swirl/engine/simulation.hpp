// The engine as its users see it: which event comes next, and what it does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "swirl/math/cpu_width.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/initial_state.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

struct EventCounts {
    std::uint64_t disc_disc = 0, disc_wall = 0, path_vertex = 0;
    std::uint64_t elastic_by_tc = 0;   // of the collisions, those made elastic by the TC model
    std::uint64_t begins_to_roll = 0;  // of spheres on a floor; or comes to rest on it
    std::uint64_t total() const { return disc_disc + disc_wall + path_vertex + begins_to_roll; }
};

/// How far a trajectory has come. Together with the discs, each at its own time, this is all there
/// is to save: a simulation resumed from it continues bit for bit.
struct Progress {
    std::int64_t periods = 0;
    double clock = 0.0;
    std::uint32_t segment = 0;
    EventCounts events;
};

/// How the discs are found that a disc may meet: all of them; those on its list; those in its cell
/// and in the cells around. `best` is what is fastest for the scene. Spheres have no lists.
enum class NeighbourSearch : std::uint8_t { best, all_pairs, lists, cells };

/// Changes the speed, never a bit.
struct Tuning {
    /// Of the grid in which neighbours for the lists are found; 1 is no grid, 0 chooses by density.
    int cells_per_side = 0;
    Width width = Width::best;
    /// A search that the scene does not allow (all pairs for many, cells on a path with several
    /// turning legs) gives way to lists; of spheres, to cells.
    NeighbourSearch neighbours = NeighbourSearch::best;
    /// Asked now and then while a simulation is made, which takes seconds where there are millions
    /// of discs. Once it has said yes it must go on saying so; the simulation is left without
    /// discs, and no event may be asked of it.
    std::function<bool()> is_stopped = {};
};

/// Work of the loop besides the events themselves.
struct LoopCounts {
    std::uint64_t invalidated = 0;    // events whose partner had collided, predicted again
    std::uint64_t list_rebuilds = 0;  // neighbour lists rebuilt, or cells entered
    std::uint64_t overflows = 0;      // of these, with lists around rebuilt to make room
    std::uint64_t full_rebuilds = 0;  // times all lists were rebuilt for lack of room, or all cells
    std::uint64_t bytes = 0;          // memory of the loop
    const char* width = "";
};

class Simulation {
  public:
    /// Spheres on a polygon only.
    explicit Simulation(const InitialState& scene, const Progress& progress = {},
                        const Tuning& tuning = {});
    ~Simulation();
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;

    /// Executes the next event and says what it was.
    Event step();

    /// Executes `count` events.
    void run(std::uint64_t count);

    /// Executes every event up to and including the given moment, and stands there. Discs are not
    /// touched, so looking never changes a bit.
    void advance_to(std::int64_t periods, double clock);
    /// The same, but no more than `most` events; says whether it stands there.
    bool advance_to(std::int64_t periods, double clock, std::uint64_t maximum);

    std::int64_t periods() const;
    double clock() const;
    EventCounts events() const;
    Progress progress() const;
    LoopCounts loop_counts() const;
    std::size_t size() const;
    /// Disc i as it is kept: the state after its last collision, at its own time.
    Disc disc(std::size_t i) const;

    /// All discs, the container, and the time, now.
    Snapshot snapshot() const;
    /// Brings a snapshot taken earlier from this simulation up to date after one step: touches only
    /// the discs of that event (all of them when a new swirl began).
    void refresh(Snapshot& snapshot, const Event& event) const;

    /// 64-bit hash of every disc's state, the leg and the time. Equal states, equal hash.
    std::uint64_t state_hash() const;

  private:
    struct Storage;
    std::uint64_t run(std::uint64_t count, std::int64_t periods, double clock);
    void switch_search();
    std::unique_ptr<Storage> storage_;
};

}  // namespace swirl
