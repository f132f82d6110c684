// Speed only, changes no bit: all the state the event loop works on, as plain columns. The types a
// reader meets are Disc, Leg and Event; this is how they are stored while the loop runs, in the
// order in which it touches them.
#pragma once

#include <cstdint>

#include "swirl/engine/pending_event.hpp"
#include "swirl/physics/collision_law.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/floor.hpp"

namespace swirl {

/// What a prediction reads of a disc: one cache line, in pairs that are stored and loaded whole.
struct alignas(64) HotDisc {
    Vec2 position;
    Vec2 velocity;
    double time, radius;
    double spin;
    std::uint32_t collisions;         // counter, mod 2³²: tells that a prediction is invalidated
    std::uint32_t kind : 24;          // row of EngineState::kinds
    std::uint32_t neighbours : 7;     // length of its list
    std::uint32_t far_from_wall : 1;  // its skin does not reach the wall

    SWIRL_INLINE Flight<double> flight() const { return {position, velocity, time}; }
};
static_assert(sizeof(HotDisc) == 64);

/// What spheres have besides: what the floor does to them, and the rest of their state.
struct alignas(64) SphereState {
    FloorMotion motion;
    Vec2 rolling_spin;
    double last_collision;
};

/// What discs of one kind share.
struct DiscKind {
    double radius, mass, inertia;
    double inverse_mass, inverse_inertia;
    std::uint32_t grid;               // row of EngineState::grids
    std::uint32_t wanted_neighbours;  // verlet_skin.hpp
};

/// What only a disc's own events read: the partner of its pending event, its angle, and its
/// neighbour list, every disc k with |X_i − X_k| < r_i + r_k + h_i + h_k (verlet_skin.hpp). There
/// are no lists where all pairs are looked at, or cells. A list longer than `capacity`, that of a
/// disc much larger than others, goes on in a ListTail.
struct ColdDisc {
    std::uint32_t partner;             // a disc; itself for the wall; or one of the marks below
    std::uint32_t partner_collisions;  // HotDisc::collisions of the partner when this was predicted
    double angle;                      // at HotDisc::time
    // followed by `capacity` disc numbers, unused ones being `EngineState::size`
    std::uint32_t* neighbours() { return reinterpret_cast<std::uint32_t*>(this + 1); }
    const std::uint32_t* neighbours() const {
        return reinterpret_cast<const std::uint32_t*>(this + 1);
    }
};
static_assert(sizeof(ColdDisc) == 16);

/// Marks in ColdDisc::partner, larger than any disc's number. None changes a disc.
inline constexpr std::uint32_t no_event = 0xffffff00u;  // the wall event that was here is void
/// Its skin; or its cell, and then by which edge: + 0 to 3 is right, left, up, down.
inline constexpr std::uint32_t leaves_skin = 0xffffff01u;
/// On a turning leg: it is not at the wall before then, and has to be asked again (wall_times.hpp).
inline constexpr std::uint32_t approaches_wall = 0xffffff05u;

/// Where those a disc may meet were looked up: a circle (verlet_skin.hpp), or a cell
/// (linked_cells.hpp).
struct Skin {
    float X, Y;  // its centre, in the co-moving frame (ComovingFrame)
    union {
        float skin_radius;        // h, the circle's radius, 0 while it has none
        std::uint32_t near_wall;  // of a disc in a cell: its place in EngineState::near_wall
    };
    union {
        std::uint32_t next_in_cell;  // the number of a disc, or EngineState::size
        std::uint32_t cell;          // its number
    };
};

/// Where skins and cells rest. It moves with the discs' mean velocity and turns with them: what is
/// at Z in it moves uniformly, from `origin.position + turn Z` on, as complex numbers, with the
/// velocity that the rotation has there. A field of velocities like that turns all distances alike
/// and stretches them alike, by √(1 + (turning τ)²) in a time τ, so they never shrink.
struct ComovingFrame {
    Flight<double> origin{};
    Vec2 turn{1.0, 0.0};   // at origin.time; of magnitude 1 or more
    double turning = 0.0;  // angular velocity then
    double scale = 1.0;    // of places in the frame: |turn|
    bool has_turned = false;

    template <class Real>
    SWIRL_INLINE Flight<Real> flight_of(const BasicVec2<Real>& Z) const {
        const BasicVec2<Real> c = complex_product(BasicVec2<Real>{Real(turn.x), Real(turn.y)}, Z);
        return {{Real(origin.position.x) + c.x, Real(origin.position.y) + c.y},
                {Real(origin.velocity.x) - Real(turning) * c.y,
                 Real(origin.velocity.y) + Real(turning) * c.x},
                Real(origin.time)};
    }
    SWIRL_INLINE Flight<double> flight_of(const Skin& skin) const {
        return flight_of(Vec2{skin.X, skin.Y});
    }
    SWIRL_INLINE Vec2 turn_at(double t) const {
        return turn + ((t - origin.time) * turning) * perpendicular(turn);
    }
    /// Of what is at p at time t.
    SWIRL_INLINE Vec2 place_of(const Vec2& p, double t) const {
        const Vec2 from_origin = p - origin.position_at(t);
        if (!has_turned) return from_origin;
        const Vec2 m = turn_at(t);
        return (1.0 / dot(m, m)) * complex_product(Vec2{m.x, -m.y}, from_origin);
    }
    /// At time t the velocity at p is origin.velocity + rate_at(t) (p - origin), as complex
    /// numbers.
    SWIRL_INLINE Vec2 rate_at(double t) const {
        if (turning == 0.0) return {0.0, 0.0};
        const double angle = (t - origin.time) * turning;
        const double share = turning / (1.0 + angle * angle);
        return {share * angle, share};
    }
};

/// The discs in a cell. In a thin gas those beyond its room are in its annex.
struct Cell {
    static constexpr std::uint32_t room = 7;
    std::uint32_t disc[room];
    std::uint32_t count;
};
static_assert(sizeof(Cell) == 32);  // read and written as one piece of eight numbers
inline constexpr std::uint32_t max_overflow_capacity = 40;  // a multiple of 8

/// Followed by `room` disc numbers, a multiple of 8, unused ones being `EngineState::size`.
struct alignas(16) ListTail {
    std::uint32_t length, room, unused[2];

    std::uint32_t* neighbours() { return reinterpret_cast<std::uint32_t*>(this + 1); }
    const std::uint32_t* neighbours() const {
        return reinterpret_cast<const std::uint32_t*>(this + 1);
    }
};

/// Square cells over the dish, in the co-moving frame, for discs of about one size: the largest of
/// them is less than twice as large as the smallest.
struct Grid {
    std::uint32_t cells_per_side;
    double cells_per_length;
    double largest_radius;
    bool equal_radii;  // that of all
    // The discs of each cell that it has no room for: the first, or EngineState::size. There is
    // room for seven, but not where memory counts, nor in grids for each size.
    std::uint32_t* heads;
    Cell* cells;
};
inline constexpr std::uint32_t max_grids = 48;

/// Room for the discs around one whose list is being rebuilt (verlet_skin.hpp).
struct CandidateColumns {
    std::uint32_t room;  // a multiple of 8
    double *gap, *reach;
    float *X, *Y;
    std::uint32_t *disc, *chosen, *rebuilt;
};

/// The discs of a small dish in columns, for the loop that looks at all of them at once
/// (all_pairs.hpp): a copy of what HotDisc holds, and when each disc meets another, and the wall.
struct alignas(64) Columns {
    static constexpr std::uint32_t maximum = 40;
    double x[maximum], y[maximum], vx[maximum], vy[maximum], time[maximum], radius[maximum];
    double meeting[maximum], wall[maximum];
    double nobody[maximum];  // 0; `never` where there is no disc, and no position either (NaN)
    PendingEvent next;       // the first of all
    // On a turning leg (wall_times.hpp): bit i is set where wall[i] is the earliest time possible.
    std::uint64_t wall_is_earliest;
    double walls_asked_at;
    // The container's when each disc collided last, if that is its time.
    Flight<double> centre[maximum];
};

/// The same of a few spheres (few_spheres.hpp), with their accelerations and when they begin to
/// roll, which is an event of theirs and ends what is known of their flight.
struct alignas(64) SphereColumns {
    static constexpr std::uint32_t maximum = 64;
    double x[maximum], y[maximum], vx[maximum], vy[maximum], ax[maximum], ay[maximum],
        time[maximum], radius[maximum];
    double meeting[maximum], wall[maximum], rolls[maximum], first[maximum];  // first: of the three
    // Where each would be at time 0 if it moved with the floor, and how far from there, seen from
    // the floor, it can come in this leg.
    double X[maximum], Y[maximum], reach[maximum];
    PendingEvent next;  // the first of all
};

/// On a turning leg: a course of the container's that is near enough to the true one
/// (wall_times.hpp), from a time on that is renewed now and then, and what limits how it goes on.
struct TurningBound {
    Flight<double> centre;
    double turning, per_turning;
    double horizon;  // a time for which the parabolas hold
    double lasts;    // before and after centre.time
    double soon;     // who comes to the wall so soon is mostly there before it meets somebody
    double L, L_of_u2, L_of_square;
    double margin;  // against rounding errors, as a fraction
};

/// Of the tournament: a few rows more to look at take less than another level.
inline constexpr std::uint32_t max_top_rows = 8;

struct EngineState {
    std::uint32_t size;      // N; disc N is nobody: its position is NaN, so it never meets anyone
    std::uint32_t capacity;  // of a neighbour list; a multiple of 4
    std::uint32_t cold_bytes;
    HotDisc* discs;
    unsigned char* cold_discs;
    Skin* skins;
    Columns* columns;
    const DiscKind* kinds;

    // The tournament (tournament.hpp).
    std::uint32_t levels, top_rows;  // of the topmost level: 1, 2, 4, 6 or 8
    bool prefetches;                 // the discs do not all fit into the nearest cache
    double* level_times[12];
    std::uint32_t* level_winners[12];
    double first_time;  // of all pending events, the first
    std::uint32_t first_disc;

    ComovingFrame comoving_frame;     // renewed with every leg, and when the discs have left it
    std::uint64_t rebuilds_in_frame;  // of lists, since it was last asked whether they have
    std::uint64_t events_when_asked;  // collisions until the frame was last held against the discs

    // A grid for each size of disc that there is (verlet_skin.hpp), from the smallest on; or one
    // for all, if the discs are few or equal; or that of a thin gas (linked_cells.hpp).
    Grid grids[max_grids];
    std::uint32_t grid_count;
    bool has_no_grid;  // few enough to look at all of them when a list is rebuilt
    double cell_origin;

    // Of cells alone (linked_cells.hpp).
    Cell* cells;
    std::uint32_t* annexes;           // of each cell; there are none where cells are not full
    std::uint32_t overflow_capacity;  // of each, in discs: a multiple of 8
    Vec2 middle_of_path;
    double max_drift;             // from there, of the cells in half a swirl
    double reach_of_far_cells;    // if they do not drift: how far they are from the middle, at most
    double far_from_wall_square;  // of this, if they do
    std::uint32_t near_wall_count, unassigned_count;
    std::uint32_t *near_wall, *unassigned;  // those who may reach the wall; those without a place
    double narrowest_cell, widest_cell;
    // Since the width was last asked about; and when lists are asked about again.
    std::uint64_t candidates_looked_at, entered_before, candidates_till_asked;

    // Whether lists or cells (lists_or_cells.hpp), and how wide cells are to be; 0: lists.
    bool should_switch_search;  // another search is to take over
    bool chooses_search;        // or cells stay cells as long as they have room
    double wanted_cell;
    std::uint32_t returns_to_cells;  // from lists that did not last
    std::uint64_t rebuilds_when_asked, collisions_when_asked;

    // The ends of lists that are longer than `capacity`, in units of 16 bytes from the first, which
    // has no room and belongs to all whose list has no tail. Null where nobody's has.
    ListTail* tails;
    std::uint32_t* tail_places;
    CandidateColumns candidates;
    bool overlapped_at_start;  // anybody, or with the wall; asked where invariants are checked
    double smallest_radius;
    bool equal_radii;
    double largest_skin_radius;

    // While all lists and predictions are made for the first time: whether to leave it at that.
    bool (*is_stopped)(const void* caller);
    const void* caller;

    const Segment* segments;
    std::uint32_t segment, segment_count;
    // Of the leg; or sooner, if the search has something to do by then that is no event.
    double stretch_end;
    TurningBound turning_bound;     // of a turning leg
    Flight<double> turning_centre;  // there: of the container, when it was asked for last
    double period, container_radius;
    Surface disc_surface, wall_surface;

    std::int64_t periods;
    double clock;
    std::uint64_t disc_disc, disc_wall, path_vertex;
    std::uint64_t elastic_by_tc;  // collisions made elastic by the TC model
    std::uint64_t invalidated, list_rebuilds, overflows,
        full_rebuilds;  // bookkeeping of the loop, for docs/performance.md

    // Of spheres alone.
    SphereState* spheres;
    SphereColumns* sphere_columns;
    Floor floor;
    std::uint64_t begun_to_roll;

    // Of contacts so far, the most that rounding can have put two bodies into each other, where
    // they stay until they part (collision_checks.hpp); asked where invariants are checked.
    double largest_rounding;

    SWIRL_INLINE ColdDisc& cold(std::uint32_t i) const {
        return *reinterpret_cast<ColdDisc*>(cold_discs +
                                            static_cast<std::uint64_t>(i) * cold_bytes);
    }
    SWIRL_INLINE bool on_turning_segment() const { return segments[segment].turning != 0.0; }
    /// Asked in loops over all discs, every thousand of them.
    SWIRL_INLINE bool stops_at(std::uint32_t i) const {
        return i % 1024 == 0 && is_stopped != nullptr && is_stopped(caller);
    }
    SWIRL_INLINE std::uint32_t* overflow(std::uint32_t cell) const {
        return annexes + static_cast<std::uint64_t>(cell) * overflow_capacity;
    }
    SWIRL_INLINE std::uint32_t& disc_in_cell(std::uint32_t cell, std::uint32_t slot) const {
        return slot < Cell::room ? cells[cell].disc[slot] : overflow(cell)[slot - Cell::room];
    }
    SWIRL_INLINE ListTail& tail(std::uint32_t i) const { return tails[tail_places[i]]; }
    /// A disc's number; that of nobody in the place of a mark.
    SWIRL_INLINE std::uint32_t disc_or_nobody(std::uint32_t partner) const {
        return partner < size ? partner : size;
    }
    /// Whether a pending event happens: its partner has not collided since it was predicted. The
    /// wall's always does; that of a disc which leaves its skin is none.
    SWIRL_INLINE bool is_valid(const PendingEvent& event) const {
        if (event.is_with_wall()) return true;
        return event.partner < size &&
               discs[event.partner].collisions == cold(event.disc).partner_collisions;
    }
};

/// The event loop, compiled for one vector width; all of them give the same bits.
struct EventLoop {
    const char* width;
    /// Makes all lists and all predictions from the discs as they stand; some of them only, if it
    /// is stopped.
    void (*start)(EngineState&);
    /// Executes the next event.
    Event (*step)(EngineState&);
    /// Executes `count` events, or as many as come before (swirls, clock]; says how many.
    std::uint64_t (*run)(EngineState&, std::uint64_t count, std::int64_t periods, double clock);
};

/// The loops for one vector width: with neighbour lists, with cells, and all pairs for up to
/// 8, 16, 24 … discs (all_pairs.hpp).
struct EventLoops {
    EventLoop lists, cells;
    EventLoop all_pairs[Columns::maximum / 8];
    std::uint32_t few;  // up to this many discs, all pairs are the faster (docs/performance.md)
    EventLoop few_spheres[SphereColumns::maximum / 16];  // for up to 16, 32 … spheres
    EventLoop many_spheres;
};

extern const EventLoops event_loops_baseline;
extern const EventLoops event_loops_avx2;
extern const EventLoops event_loops_avx512;

}  // namespace swirl
