// Storage layout for speed; it never affects results. This header holds the state that the event
// loop and every neighbour search share. Each search adds its own state (search_states.hpp).
//
// The types a reader should know are Disc, Segment and Event; these structs are how they are stored
// while the loop runs, in the order in which the loop touches them.
#pragma once

#include <cstdint>

#include "swirl/engine/pending_event.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/floor.hpp"
#include "swirl/physics/rotation_follower.hpp"

namespace swirl {

/// What a prediction reads of a disc. It fills one cache line; position and velocity, and time and
/// radius, are each loaded and stored by one vector instruction.
struct alignas(64) HotDisc {
    Vec2 position;
    Vec2 velocity;
    double time, radius;
    double spin;
    std::uint32_t collisions;         // counter mod 2³²; a change invalidates predictions
    std::uint32_t species : 24;       // index into EngineState::species
    std::uint32_t list_length : 7;    // Verlet lists only: entries in ColdDisc::neighbours
    std::uint32_t far_from_wall : 1;  // lists and cells: its skin or cell does not reach the wall

    SWIRL_INLINE Flight<double> flight() const { return {position, velocity, time}; }
};
static_assert(sizeof(HotDisc) == 64);

/// Additional state of a sphere: the motion that the floor imposes, the spin about the horizontal
/// axes, and the time of the last collision.
struct alignas(64) SphereState {
    FloorMotion motion;
    Vec2 rolling_spin;
    double last_collision;
};

/// Properties that all discs of one species share.
struct Species {
    double radius, mass, inertia;
    double inverse_mass;
    double inverse_inertia;  // 1/I of a disc's spin, or of a sphere's rolling
    double can_spin;         // Disc::can_spin
};

/// The data that only a disc's own events read: the partner of its pending event, and its angle. In
/// the search with Verlet lists the disc's neighbour list follows in memory (verlet_skin.hpp).
struct ColdDisc {
    std::uint32_t partner;             // a disc; the disc itself for the wall; or a mark, see below
    std::uint32_t partner_collisions;  // the partner's HotDisc::collisions at the prediction
    double angle;                      // value at HotDisc::time
    // Followed by VerletListsState::list_capacity disc numbers; unused ones are EngineState::size.
    std::uint32_t* neighbours() { return reinterpret_cast<std::uint32_t*>(this + 1); }
    const std::uint32_t* neighbours() const {
        return reinterpret_cast<const std::uint32_t*>(this + 1);
    }
};
static_assert(sizeof(ColdDisc) == 16);

/// Marks in ColdDisc::partner, larger than any disc number. None of these events changes a disc.
inline constexpr std::uint32_t no_event = 0xffffff00u;  // the wall event stored here is void
/// The disc leaves its skin (Verlet lists); or its cell (linked cells), and then the edge is added:
/// 0 to 3 for right, left, up, down.
inline constexpr std::uint32_t leaves_skin = 0xffffff01u;
/// On an arc: the disc does not reach the wall before this time; then the wall contact must be
/// predicted again (wall_times.hpp).
inline constexpr std::uint32_t approaches_wall = 0xffffff05u;

/// A bound on the container's motion along an arc of its path, from which a lower bound of the time
/// of a wall contact follows (wall_times.hpp). It is renewed now and then.
struct ArcBound {
    Flight<double> centre;  // the container at the last renewal
    double turn_rate, inverse_turn_rate;
    double horizon;         // duration for which the bounding parabola holds
    double valid_for;       // time before and after centre.time
    double search_at_once;  // a wall contact expected within this time usually happens
    double L, L_of_u2, L_of_square;
    double margin;  // allowance for rounding, a fraction
};

/// Copies of all discs' flights in columns, for an observer within the loop of a search that has no
/// columns (rotation_observer.hpp). Null until there is one.
struct CopiedFlights {
    double *x, *y, *vx, *vy, *time;
    double *ax, *ay;       // null for discs
    std::uint64_t events;  // copied after this number of events
};

/// The state of a simulation, as far as every neighbour search needs it.
struct EngineState {
    // The particles.
    std::uint32_t size;        // N; index N is a sentinel with position NaN, which never collides
    std::uint32_t cold_bytes;  // distance in memory from one ColdDisc to the next
    HotDisc* discs;
    unsigned char* cold_discs;
    const Species* species;
    SphereState* spheres;  // null for discs
    Floor floor;           // used by spheres

    // The container.
    const Segment* segments;
    std::uint32_t segment, segment_count;
    /// End of the segment; or an earlier time at which the search renews its predictions
    /// (RenewsWithinSegment).
    double interval_end;
    ArcBound arc_bound;         // used on an arc
    double horizons_per_turn;   // sets ArcBound::horizon
    Flight<double> arc_centre;  // container's centre on an arc, at the time last requested
    double period, container_radius;
    Surface disc_surface, wall_surface;

    // The time and what has happened.
    std::int64_t periods;
    double clock;
    std::uint64_t disc_disc, disc_wall, path_vertex, begun_to_roll;
    std::uint64_t elastic_by_tc;  // collisions that the TC model made elastic
    std::uint64_t invalidated, list_rebuilds, overflows, full_rebuilds;  // LoopCounts

    // The search asks to be replaced by another one (lists_or_cells.hpp).
    bool should_switch_search;

    // For invariant checks (invariant.hpp): whether discs overlapped each other or the wall at the
    // start, and the largest overlap that rounding can have caused in a contact so far. Such an
    // overlap remains until the two separate (collision_checks.hpp).
    bool overlapped_at_start;
    double largest_rounding;

    CopiedFlights copies;

    // While the first predictions are made: the caller's request to stop.
    bool (*is_stopped)(const void* caller);
    const void* caller;

    // Only the loops of a law of your own (own_law.hpp) use it.
    const void* law;

    SWIRL_INLINE ColdDisc& cold(std::uint32_t i) const {
        return *reinterpret_cast<ColdDisc*>(cold_discs +
                                            static_cast<std::uint64_t>(i) * cold_bytes);
    }
    SWIRL_INLINE std::uint64_t events() const {
        return disc_disc + disc_wall + path_vertex + begun_to_roll;
    }
    SWIRL_INLINE bool on_arc() const { return segments[segment].turn_rate != 0.0; }
    /// For loops over all discs: polls the request to stop at every 1024th disc.
    SWIRL_INLINE bool stops_at(std::uint32_t i) const {
        return i % 1024 == 0 && is_stopped != nullptr && is_stopped(caller);
    }
    /// The disc number; the sentinel if `partner` is a mark.
    SWIRL_INLINE std::uint32_t disc_or_sentinel(std::uint32_t partner) const {
        return partner < size ? partner : size;
    }
    /// True if a pending event happens: its partner has not collided since the prediction. A wall
    /// contact always happens. A disc that leaves its skin is not an event.
    SWIRL_INLINE bool is_valid(const PendingEvent& event) const {
        if (event.is_with_wall()) return true;
        return event.partner < size &&
               discs[event.partner].collisions == cold(event.disc).partner_collisions;
    }
};

/// The event loop of one search, compiled for one vector width. Every width gives bitwise identical
/// results.
struct EventLoop {
    const char* width;
    /// Builds the search's data and predicts all events. If the caller asks to stop, the work is
    /// left unfinished.
    void (*start)(EngineState&);
    /// Adds events to the span until it has `count` events or all up to and including the time
    /// (periods, clock). Returns early if the search asks to be replaced.
    void (*run)(EngineState&, EventSpan& span, std::uint64_t count, std::int64_t periods,
                double clock);
    /// The same, observed: stores the last event in `last` and follows the rotation, unless they
    /// are null. Also returns early after a sample by time, if the sampling pauses there.
    void (*observe)(EngineState&, RotationSampling* sampling, Event* last, EventSpan& span,
                    std::uint64_t count, std::int64_t periods, double clock);
};

/// The columns of AllPairsState and FewSpheresState have this capacity.
inline constexpr std::uint32_t max_discs_in_columns = 40, max_spheres_in_columns = 64;

/// The event loops of all searches for one vector width. The loops of searches that store particles
/// in columns are compiled for several sizes. Without the other loops, `lists` run all discs and
/// `many_spheres` all spheres.
struct EventLoops {
    EventLoop lists, cells;
    EventLoop all_pairs[max_discs_in_columns / 8];  // one for up to 8, 16, 24 … discs
    // Up to these packing fractions, all pairs are faster than lists (bench/NOTES.md). All
    // pairs take as long at any density, but lists last longer in a dense system. 0: no loop.
    double all_pairs_up_to_packing[max_discs_in_columns / 8];
    EventLoop few_spheres[max_spheres_in_columns / 16];  // one for up to 16, 32 … spheres
    EventLoop many_spheres;
};

extern const EventLoops event_loops_baseline;
extern const EventLoops event_loops_avx2;
extern const EventLoops event_loops_avx512;

}  // namespace swirl
