// The engine's interface: executes one event after the other, and lets you observe the discs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "swirl/math/cpu_width.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/initial_state.hpp"
#include "swirl/physics/rotation_follower.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

struct EventCounts {
    std::uint64_t disc_disc = 0, disc_wall = 0, path_vertex = 0;
    std::uint64_t elastic_by_tc = 0;   // collisions that the TC model made elastic
    std::uint64_t begins_to_roll = 0;  // a sphere begins to roll, or a coin stops
    std::uint64_t total() const { return disc_disc + disc_wall + path_vertex + begins_to_roll; }
};

/// The state of a run besides its discs. Together with the discs, each at its own time, this is all
/// that must be saved: a simulation resumed from it continues with bitwise identical results.
struct Progress {
    std::int64_t periods = 0;
    double clock = 0.0;
    std::uint32_t segment = 0;
    EventCounts events;
};

/// How the engine finds the discs that a disc can collide with: all pairs, neighbour lists
/// (Verlet), or the cell of the disc and those around it (linked cells). `best` chooses the fastest
/// method for the scene. Spheres have no lists.
enum class SearchMethod : std::uint8_t { best, all_pairs, lists, cells };

inline constexpr int max_cells_per_side = 30000;

/// Settings that change the speed, never a result.
struct Tuning {
    /// The grid in which neighbours for the lists are found: 1 is no grid, 0 chooses by density.
    /// At most `max_cells_per_side`.
    int cells_per_side = 0;
    Width width = Width::best;
    /// If the scene does not allow the method, lists replace it, or cells for spheres. All pairs
    /// are not allowed for many discs, and cells are not allowed on a path with several arcs.
    SearchMethod search = SearchMethod::best;
    /// Polled now and then while a simulation is constructed, which takes seconds for millions of
    /// discs. Once it has returned true it must continue to do so. The simulation then has no
    /// discs, and no event may be requested from it.
    std::function<bool()> is_stopped = {};
};

/// Work of the event loop besides the events themselves.
struct LoopCounts {
    std::uint64_t invalidated = 0;    // events whose partner had collided; predicted again
    std::uint64_t list_rebuilds = 0;  // neighbour lists rebuilt, or cells entered
    std::uint64_t overflows = 0;      // those that had to rebuild other lists, too
    std::uint64_t full_rebuilds = 0;  // times that all lists or all cells were rebuilt
    std::uint64_t bytes = 0;          // memory of the arrays
    const char* width = "";
};

/// A function that stops the program does so with a sentence on standard error. The functions of
/// validate.hpp return the same sentences. Nothing is checked in two cases, in which the behaviour
/// is undefined: a simulation that was moved from, or stopped while it was constructed, can only be
/// destroyed or assigned to; and two threads may not use one simulation at the same time, except
/// that both call functions which are const.
class Simulation {
  public:
    /// Stops the program if validate() reports a problem with the scene and progress, or the
    /// tuning.
    explicit Simulation(const InitialState& scene, const Progress& progress = {},
                        const Tuning& tuning = {});
    ~Simulation();
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;

    /// Executes the next event and returns it.
    Event step();

    /// Executes `count` events.
    void run(std::uint64_t count);

    /// Executes all events up to and including the given time and sets the clock to it. Discs keep
    /// their stored states, so the time of an observation never affects results. Stops the program
    /// if the time is past or the clock is not from 0 to the period (problem_with_time()).
    void advance_to(std::int64_t periods, double clock);
    /// The same, but executes at most `maximum` events. Returns whether the time was reached.
    bool advance_to(std::int64_t periods, double clock, std::uint64_t maximum);
    /// Why advance_to() cannot reach this time, as a sentence; nothing if it can.
    std::optional<std::string> problem_with_time(std::int64_t periods, double clock) const;

    /// At the start of a period: replaces path, surfaces and floor by those of `scene`, whose discs
    /// are ignored. Time and counts of events continue. Discs keep their velocities, and their
    /// positions relative to the container: they are shifted by the difference of the two paths'
    /// starting points. Stops the program in the middle of a period, if the new path has another
    /// number of segments, or if validate() reports a problem with the new scene.
    void change_surroundings(InitialState scene, const Tuning& tuning = {});
    /// Executes at most `maximum` events, all before this time of the present period and before its
    /// end, and adds them to the span. Stops the program if the clock is NaN.
    void run_before(double clock, std::uint64_t maximum, EventSpan& span);
    /// The same up to and including the end of the period, and the loop samples the rotation.
    /// Stores the last event in `last` if it is not null. Also stops the program if the rotation is
    /// that of another number of discs.
    void observe_before(double clock, std::uint64_t maximum, RotationSampling& sampling,
                        EventSpan& span, Event* last = nullptr);

    std::int64_t periods() const;
    double clock() const;
    EventCounts events() const;
    Progress progress() const;
    LoopCounts loop_counts() const;
    std::size_t size() const;
    /// Disc i as stored: its state after its last collision, at its own time. Stops the program if
    /// there is no disc i.
    Disc disc(std::size_t i) const;

    /// All discs, the container, and the time, now.
    Snapshot snapshot() const;
    /// Updates an earlier snapshot of this simulation after one step. Touches only the discs of
    /// that event; or all discs, if a new period has begun. After skipped steps, the other discs of
    /// the snapshot are those before them. Stops the program if the snapshot has another number of
    /// discs, or the event names a disc that does not exist.
    void refresh(Snapshot& snapshot, const Event& event) const;
    /// The same after a span of events, but without the angles, which few observers need. It does
    /// not follow orientations. The span is one that run_before() or observe_before() filled.
    void refresh(Snapshot& snapshot, const EventSpan& span) const;
    /// Updates the angles of all discs.
    void refresh_angles(Snapshot& snapshot) const;

    /// 64-bit hash of every disc's state, the segment and the time. Equal states have equal hashes.
    std::uint64_t state_hash() const;

  private:
    struct Storage;
    void run(EventSpan& span, std::uint64_t count, std::int64_t periods, double clock);
    void observe(RotationSampling* sampling, Event* last, EventSpan& span, std::uint64_t count,
                 std::int64_t periods, double clock);
    void require_same_discs(const Snapshot& snapshot) const;
    void copy(Snapshot& snapshot, std::uint32_t i, double clock) const;
    void copy_flight(Snapshot& snapshot, std::uint32_t i, double clock) const;
    void copy_sphere(Snapshot& snapshot, std::uint32_t i, double clock) const;
    void set_time(Snapshot& snapshot) const;
    void switch_search();
    std::unique_ptr<Storage> storage_;
};

}  // namespace swirl
