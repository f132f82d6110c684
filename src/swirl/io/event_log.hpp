// Every event of a run, from which the exact state at any time is rebuilt.
//
// HDF5. While it is being written it is called NAME.partial (see trajectory.hpp).
//   /initial     position, velocity f64[N][2]; angle, spin, radius, mass, moment_of_inertia f64[N]:
//                the state at time 0
//   /events      one entry per event, in order:
//     swirls     i64   whole periods before it
//     clock      f64   time since the start of the current swirl
//     kind       u8    0 disc–disc, 1 disc–wall, 2 path vertex, 3 a sphere begins to roll, or
//                      it or a coin comes to rest on the floor
//     i, j       u32   the discs, i < j; j = i for the wall; both 0 at a path vertex
//     normal_x, normal_y f64  unit vector from i to j, or from i outwards to the wall
//     normal_impulse     f64  on j (on the wall) along the normal; i gets the opposite
//     tangential_impulse f64  on j along (normal_y, −normal_x)
//     sticks     u8    1: the contact's slip was stopped, 0: it slid
//   Of spheres besides: /initial/rolling_spin f64[N][2]; /events/vertical_impulse f64; /floor
//                velocity f64[M][2] on each of the M legs of the path, attribute deceleration,
//                μ_f g; if it is not zero also the attribute rolling_resistance, μ_r g; of coins,
//                which are written likewise, also the attribute lie_flat
//   /parameters  attributes: format (1), period, swirl_end, container_radius, complete; texts of
//                the provenance
//
// Replaying. A disc moves uniformly between its events, from the state it got at its last one:
// x + (t − t₀) v, angle + (t − t₀) spin. An event brings its discs to its time in that form and
// adds
//
//     v_i −= (1/m_i) J,  v_j += (1/m_j) J,  J = J_n n + J_t (n_y, −n_x)
//     spin_i += R_i J_t (1/I_i), likewise j
//
// At the end of a swirl (a path vertex with clock = swirl_end, which is the period but for
// rounding) every disc is brought to that time, and clocks begin at 0. In that order of operations
// the replayed state is that of the engine, bit for bit.
//
// Spheres fly as physics/floor.hpp says, from the floor's velocity on the leg. A vertical impulse
// J_z changes (ω_x, ω_y) of both by −R J_z (1/I) (n_y, −n_x). One that begins to roll is brought to
// that moment and set rolling. At every path vertex, if there is a floor, all are brought to its
// time, and slide from the next leg's velocity on.
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

/// What spheres lie on, with its velocity on each leg of the path.
struct MovingFloor {
    Floor floor;
    std::vector<Vec2> velocity;
};
MovingFloor moving_floor(const Floor& floor, const ContainerPath& path);

class EventLogWriter {
  public:
    /// `initial` is the state before the first event; the floor is of spheres.
    EventLogWriter(const std::filesystem::path& path, const Snapshot& initial, double swirl_end,
                   const Provenance& provenance, int compression = default_compression,
                   const MovingFloor& floor = {});
    /// Carries on with an unfinished log, of which the first `events` count.
    static EventLogWriter resume(const std::filesystem::path& path, std::uint64_t events,
                                 const std::string& run = "");
    EventLogWriter(EventLogWriter&&) noexcept = default;
    EventLogWriter& operator=(EventLogWriter&&) noexcept = default;

    void write(const Event& event) {
        buffer_.push_back(event);
        ++events_;
        if (buffer_.size() == buffer_size) empty_buffer();
    }
    std::uint64_t events() const { return events_; }
    void flush();
    void finish();

  private:
    static constexpr std::size_t buffer_size = 4096;
    EventLogWriter(const std::filesystem::path& path, Hdf5File file);
    void open_columns();
    void empty_buffer();

    struct Columns {
        Column periods, clock, kind, i, j, normal_x, normal_y, normal_impulse, tangential_impulse;
        Column sticks, vertical_impulse;
    };
    std::filesystem::path path_;
    std::unique_ptr<Hdf5File> file_;
    Columns columns_;
    std::vector<Event> buffer_;
    std::uint64_t events_ = 0;
    std::chrono::steady_clock::time_point last_flush_;
};

/// Throws FileError if it is no HDF5 file.
bool is_event_log(const std::filesystem::path& path);

class EventLogReader {
  public:
    explicit EventLogReader(const std::filesystem::path& path);

    const std::vector<Disc>& initial() const { return initial_; }
    /// Of spheres alone.
    const std::optional<MovingFloor>& floor() const { return floor_; }
    double period() const { return period_; }
    double swirl_end() const { return swirl_end_; }
    double container_radius() const { return container_radius_; }
    std::uint64_t events() const { return events_; }
    bool complete() const { return complete_; }
    std::string provenance(const std::string& name) const;
    /// Entries first … first + count − 1. `overlap` is not recorded, and 0.
    std::vector<Event> read(std::uint64_t first, std::uint64_t count) const;

  private:
    std::unique_ptr<Hdf5File> file_;
    Column periods_, clock_, kind_, i_, j_, normal_x_, normal_y_, normal_impulse_;
    Column tangential_impulse_, sticks_, vertical_impulse_;
    std::vector<Disc> initial_;
    std::optional<MovingFloor> floor_;
    double period_ = 0.0, swirl_end_ = 0.0, container_radius_ = 0.0;
    std::uint64_t events_ = 0;
    bool complete_ = false;
};

/// The discs as the events leave them, each held at the time of its last event.
class Replay {
  public:
    /// With a floor, also one that does not rub, they are spheres.
    Replay(std::vector<Disc> initial, double swirl_end, std::optional<MovingFloor> floor = {});

    void apply(const Event& event);
    const std::vector<Disc>& discs() const { return discs_; }
    std::int64_t periods() const { return periods_; }

  private:
    void pass_vertex(const Event& event);
    void bring_to(std::size_t i, double t);
    void let_fly(std::size_t i);

    std::vector<Disc> discs_;
    double swirl_end_;
    std::optional<MovingFloor> floor_;
    std::vector<FloorMotion> motions_;  // of spheres, from the state that is held
    std::size_t segment_ = 0;
    std::int64_t periods_ = 0;
};

}  // namespace swirl
