// An event log: every event of a run, from which the exact state at any time can be rebuilt.
//
// HDF5. While it is being written its name is NAME.partial (see trajectory.hpp).
//   /initial     position, velocity f64[N][2]; angle, spin, radius, mass, moment_of_inertia f64[N]:
//                the state at time 0
//   /events      one entry per event, in order:
//     swirls     i64   whole periods before it
//     clock      f64   time since the start of the current period
//     kind       u8    0 disc–disc, 1 disc–wall, 2 path vertex, 3 a sphere begins to roll, or a
//                      sphere or coin stops on the floor
//     i, j       u32   the discs, i < j; j = i for the wall; both 0 at a path vertex
//     normal_x, normal_y f64  unit vector from i to j, or from i outwards to the wall
//     normal_impulse     f64  on j (on the wall) along the normal; i receives the opposite
//     tangential_impulse f64  on j along (normal_y, −normal_x)
//     sticks     u8    1: the contact sticks, 0: it slides
//   For spheres and coins in addition: /initial/rolling_spin f64[N][2]; /events/vertical_impulse
//                f64; /floor: velocity f64[M][2] on each of the M path segments, attribute
//                deceleration, μ_f g; attribute rolling_resistance, μ_r g, if it is not zero; for
//                coins the attribute lie_flat
//   /parameters  attributes: format (1), period, swirl_end, container_radius, complete; one text
//                dataset for each entry of the provenance
//
// Replay. A disc moves uniformly between its events, from its state after the last one:
// x + (t − t₀) v, angle + (t − t₀) spin. An event moves its discs to its time by these formulas and
// adds
//
//     v_i −= (1/m_i) J,  v_j += (1/m_j) J,  J = J_n n + J_t (n_y, −n_x)
//     spin_i += R_i J_t (1/I_i), likewise j
//
// The last path vertex of a period has clock = swirl_end, which differs from the period by rounding
// only. There every disc is moved to that time, and clocks restart at 0. In this order of
// operations the replayed state is bitwise identical to that of the engine.
//
// Spheres move as physics/floor.hpp says, with the floor's velocity on the segment. A vertical
// impulse J_z changes (ω_x, ω_y) of both by −R J_z (1/I) (n_y, −n_x). A sphere that begins to roll
// is moved to that time and set rolling. If there is friction against the floor, all spheres are
// moved to the time of every path vertex, and continue to slide with the next segment's velocity.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "swirl/io/hdf5.hpp"
#include "swirl/io/trajectory.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/floor.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

/// The floor, with its velocity on each segment of the path.
struct MovingFloor {
    Floor floor;
    std::vector<Vec2> velocity;
};
MovingFloor moving_floor(const Floor& floor, const ContainerPath& path);

class EventLogWriter {
  public:
    /// `initial` is the state before the first event. `period_end` is the clock at the last path
    /// vertex of a period. `floor` is used for spheres and coins only.
    EventLogWriter(const std::filesystem::path& path, const Snapshot& initial, double period_end,
                   const Provenance& provenance, int compression = default_compression,
                   const MovingFloor& floor = {});
    /// Continues an unfinished log after its first `events` events and drops the others. Throws
    /// FileError if it has fewer events, or belongs to another run (recording.hpp).
    static EventLogWriter resume(const std::filesystem::path& path, std::uint64_t events,
                                 const std::string& run = "");
    EventLogWriter(EventLogWriter&&) noexcept = default;
    EventLogWriter& operator=(EventLogWriter&&) noexcept = default;

    void write(const Event& event) {
        buffer_.push_back(event);
        ++events_;
        if (buffer_.size() == buffer_size) write_buffer();
    }
    std::uint64_t events() const { return events_; }
    /// After this call all events written so far survive a kill and a power cut.
    void flush();
    /// Completes the file and publishes it under its final name.
    void finish();

  private:
    static constexpr std::size_t buffer_size = 4096;
    EventLogWriter(const std::filesystem::path& path, Hdf5File file);
    void write_buffer();
    void flush_file();

    std::filesystem::path path_;
    std::unique_ptr<Hdf5File> file_;
    bool are_spheres_ = false;
    std::vector<Column> columns_;
    std::vector<Event> buffer_;
    std::uint64_t events_ = 0;
    std::chrono::steady_clock::time_point last_flush_;
};

/// Throws FileError if the file is not an HDF5 file.
bool is_event_log(const std::filesystem::path& path);

class EventLogReader {
  public:
    explicit EventLogReader(const std::filesystem::path& path);

    const std::vector<Disc>& initial() const { return initial_; }
    /// Only for spheres and coins.
    const std::optional<MovingFloor>& floor() const { return floor_; }
    double period() const { return period_; }
    double period_end() const { return period_end_; }
    double container_radius() const { return container_radius_; }
    std::uint64_t events() const { return events_; }
    bool complete() const { return complete_; }
    std::string provenance(const std::string& name) const;
    /// Events first … first + count − 1. `overlap` is not recorded and reads as 0.
    std::vector<Event> read(std::uint64_t first, std::uint64_t count) const;

  private:
    void read_floor();
    void read_initial_state();

    std::filesystem::path path_;
    std::unique_ptr<Hdf5File> file_;
    std::vector<Column> columns_;
    std::vector<Disc> initial_;
    std::optional<MovingFloor> floor_;
    double period_ = 0.0, period_end_ = 0.0, container_radius_ = 0.0;
    std::uint64_t events_ = 0;
    bool complete_ = false;
};

/// The states of all discs after each event; each is held at the time of its last event.
class Replay {
  public:
    /// With a floor, also one without friction, the discs are spheres or coins.
    Replay(std::vector<Disc> initial, double period_end, std::optional<MovingFloor> floor = {});

    void apply(const Event& event);
    const std::vector<Disc>& discs() const { return discs_; }
    std::int64_t periods() const { return periods_; }

  private:
    void pass_vertex(const Event& event);
    void move_to(std::size_t i, double t);
    void update_motion(std::size_t i);

    std::vector<Disc> discs_;
    double period_end_;
    std::optional<MovingFloor> floor_;
    std::vector<FloorMotion> motions_;  // motions of spheres, from the stored states
    std::size_t segment_ = 0;
    std::int64_t periods_ = 0;
};

}  // namespace swirl
