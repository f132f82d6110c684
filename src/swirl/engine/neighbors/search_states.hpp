// The state of each neighbour search: EngineState and what this search adds to it. A search never
// reads the state of another one. search_setup.cpp fills these structs when a simulation starts.
#pragma once

#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/math/vec2.hpp"

namespace swirl {

// ---- Shared parts

/// The event queue: a tournament of eight (tournament.hpp).
struct EventQueue {
    std::uint32_t levels, top_rows;  // rows of the top level: 1, 2, 4, 6, 8
    bool prefetches;                 // the discs do not all fit into the nearest cache
    double* level_times[12];
    std::uint32_t* level_winners[12];
    double first_time;  // the earliest of all pending events, and its disc
    std::uint32_t first_disc;
};
/// A few more rows to scan at the top cost less than another level.
inline constexpr std::uint32_t max_top_rows = 8;

/// The frame in which skins and cells are at rest. It translates with the mean velocity of the
/// discs and rotates with them. Using complex numbers, a point at rest at Z moves uniformly from
/// `origin.position + turn Z`, with the velocity that the rotation gives it there. Such a velocity
/// field rotates all distances alike and stretches them alike, by √(1 + (turn_rate τ)²) in a time
/// τ, so distances never shrink.
struct ComovingFrame {
    Flight<double> origin{};
    Vec2 turn{1.0, 0.0};     // rotation and stretch at origin.time; its magnitude is at least 1
    double turn_rate = 0.0;  // angular velocity at origin.time
    double scale = 1.0;      // |turn|: the stretch of distances in the frame
    bool has_turned = false;

    template <class Real>
    SWIRL_INLINE Flight<Real> flight_of(const BasicVec2<Real>& Z) const {
        const BasicVec2<Real> c = complex_product(BasicVec2<Real>{Real(turn.x), Real(turn.y)}, Z);
        return {{Real(origin.position.x) + c.x, Real(origin.position.y) + c.y},
                {Real(origin.velocity.x) - Real(turn_rate) * c.y,
                 Real(origin.velocity.y) + Real(turn_rate) * c.x},
                Real(origin.time)};
    }
    SWIRL_INLINE Vec2 turn_at(double t) const {
        return turn + ((t - origin.time) * turn_rate) * perpendicular(turn);
    }
    /// Coordinates in this frame of the point that is at p at time t.
    SWIRL_INLINE Vec2 to_frame(const Vec2& p, double t) const {
        const Vec2 from_origin = p - origin.position_at(t);
        if (!has_turned) return from_origin;
        const Vec2 m = turn_at(t);
        return (1.0 / dot(m, m)) * complex_product(Vec2{m.x, -m.y}, from_origin);
    }
    /// At time t a point at rest at p has velocity origin.velocity + rate_at(t) (p − origin), as
    /// complex numbers.
    SWIRL_INLINE Vec2 rate_at(double t) const {
        if (turn_rate == 0.0) return {0.0, 0.0};
        const double angle = (t - origin.time) * turn_rate;
        const double share = turn_rate / (1.0 + angle * angle);
        return {share * angle, share};
    }
};

/// A disc's skin: the circle within which its neighbour list is complete (verlet_skin.hpp). The
/// search for many spheres uses it for the region that a sphere can reach (many_spheres.hpp).
struct Skin {
    float X, Y;                  // centre, in the frame of the search
    float radius;                // 0 while the disc has no skin
    std::uint32_t next_in_cell;  // linked list of a cell's discs; ends with EngineState::size

    SWIRL_INLINE Vec2 centre() const { return {X, Y}; }
};

/// Square cells over a square region whose lower left corner is (corner, corner).
struct CellGrid {
    std::uint32_t cells_per_side;
    double cells_per_length;
    double corner;

    SWIRL_INLINE double width() const { return 1.0 / cells_per_length; }
    /// Row of a y coordinate, or column of an x coordinate. A position outside the region maps to
    /// the nearest edge cell.
    SWIRL_INLINE std::uint32_t row_of(double y) const {
        const double k = (y - corner) * cells_per_length;
        if (!(k > 0.0)) return 0;
        const auto row = static_cast<std::uint32_t>(k);
        return row < cells_per_side ? row : cells_per_side - 1;
    }
    SWIRL_INLINE std::uint32_t cell_at(double x, double y) const {
        return row_of(y) * cells_per_side + row_of(x);
    }
    SWIRL_INLINE std::uint32_t cell_count() const { return cells_per_side * cells_per_side; }
};

/// The discs of one cell; further ones go to an overflow.
struct Cell {
    static constexpr std::uint32_t capacity = 7;
    std::uint32_t disc[capacity];
    std::uint32_t count;
};
static_assert(sizeof(Cell) == 32);  // copied as one piece of eight numbers

/// A grid that holds the discs of about one size: the largest is less than twice the smallest.
struct DiscGrid : CellGrid {
    double largest_radius;
    bool equal_radii;  // all discs of this grid have the same radius
    Cell* cells;       // null where memory matters more, and in grids of one size among several
    // Discs that do not fit into `cells`: for each cell the first disc of a linked list
    // (Skin::next_in_cell), or EngineState::size.
    std::uint32_t* heads;
};

// ---- The searches

/// A few discs as struct of arrays, for the loop that tests all pairs (all_pairs.hpp): a copy of
/// HotDisc, and the time of each disc's next contact with a disc and with the wall.
struct alignas(64) DiscColumns {
    static constexpr std::uint32_t maximum = max_discs_in_columns;
    double x[maximum], y[maximum], vx[maximum], vy[maximum], time[maximum], radius[maximum];
    double contact[maximum], wall[maximum];
    double padding[maximum];  // 0 for a disc, `never` for a lane without a disc (its position: NaN)
    PendingEvent next;        // the earliest of all
    // On an arc (wall_times.hpp): bit i is set where wall[i] is only a lower bound.
    std::uint64_t wall_is_bound;
    double walls_bounded_at;  // time when all bounds were computed
    // The container's centre at each disc's last collision, if it was computed for that time.
    Flight<double> centre[maximum];
};
struct AllPairsState : EngineState {
    DiscColumns columns;
};

/// The same for a few spheres (few_spheres.hpp), with their accelerations and the time at which
/// each begins to roll. That is an event, and it ends the parabola that is known.
struct alignas(64) SphereColumns {
    static constexpr std::uint32_t maximum = max_spheres_in_columns;
    double x[maximum], y[maximum], vx[maximum], vy[maximum], ax[maximum], ay[maximum],
        time[maximum], radius[maximum];
    double contact[maximum], wall[maximum], rolls[maximum], first[maximum];  // first: of the three
    // Where each sphere would be at time 0 if it moved with the floor, and how far from there, seen
    // from the floor, it can get within this segment.
    double X[maximum], Y[maximum], reach[maximum];
    PendingEvent next;  // the earliest of all
};
struct FewSpheresState : EngineState {
    SphereColumns columns;
};

struct ManySpheresState : EngineState {
    EventQueue queue;
    Skin* skins;
    DiscGrid grid;
    double largest_reach;  // the largest skin radius + sphere radius so far
};

/// What Verlet lists and linked cells share, because they can replace each other at run time
/// (lists_or_cells.hpp).
struct ListsOrCellsState : EngineState {
    EventQueue queue;
    double smallest_radius;

    ComovingFrame comoving_frame;

    bool chooses_search;         // false: do not replace cells by lists, nor these lists by cells
    double target_cell_width;    // cells that should take over; 0: lists should
    double max_cell_width;       // cells must not be wider than this from now on
    std::uint32_t failed_lists;  // times that lists took over and did not last
    std::uint64_t rebuilds_at_test, collisions_at_test;  // when the choice was last tested
};

/// The end of a neighbour list longer than VerletListsState::list_capacity. It is followed by
/// `capacity` disc numbers, a multiple of 8; unused ones are EngineState::size.
struct alignas(16) ListTail {
    std::uint32_t length, capacity, unused[2];

    std::uint32_t* neighbours() { return reinterpret_cast<std::uint32_t*>(this + 1); }
    const std::uint32_t* neighbours() const {
        return reinterpret_cast<const std::uint32_t*>(this + 1);
    }
};

/// Storage for the discs around one whose list is being rebuilt (verlet_skin.hpp).
struct CandidateColumns {
    std::uint32_t capacity;  // a multiple of 8
    double *gap, *reach;
    float *X, *Y;
    std::uint32_t *disc, *chosen, *rebuilt;
};

/// Data that the lists of one species need.
struct SpeciesLists {
    std::uint32_t grid;           // index into VerletListsState::grids
    std::uint32_t target_length;  // list length (verlet_skin.hpp)
};
inline constexpr std::uint32_t max_grids = 48;

/// Verlet lists. The list of disc i holds every disc k with |X_i − X_k| < r_i + r_k + h_i + h_k
/// (verlet_skin.hpp). A list longer than `list_capacity`, that of a disc much larger than others,
/// continues in a ListTail.
struct VerletListsState : ListsOrCellsState {
    std::uint32_t list_capacity;  // a multiple of 4
    Skin* skins;
    double largest_skin_radius;
    bool equal_radii;
    SpeciesLists* species_lists;
    CandidateColumns candidates;
    // Tails, in units of 16 bytes; the first is empty and shared by all discs without a tail. Null
    // if no disc has one.
    ListTail* tails;
    std::uint32_t* tail_index;
    std::uint64_t rebuilds_in_frame;         // list rebuilds since the frame was last tested
    std::uint64_t collisions_at_frame_test;  // collisions until then

    // One grid for each size of discs, from the smallest on; one for all if the discs are equal;
    // none if they are few.
    bool has_no_grid;
    std::uint32_t grid_count;
    DiscGrid grids[max_grids];

    SWIRL_INLINE ListTail& tail(std::uint32_t i) const { return tails[tail_index[i]]; }
};

/// The position of a disc in the grid of LinkedCellsState.
struct CellPosition {
    float X, Y;               // centre of its cell, in the co-moving frame
    std::uint32_t near_wall;  // its index in LinkedCellsState::near_wall, if it is there
    std::uint32_t cell;

    SWIRL_INLINE Vec2 centre() const { return {X, Y}; }
};
inline constexpr std::uint32_t max_overflow_capacity = 40;  // a multiple of 8

/// Linked cells (linked_cells.hpp).
struct LinkedCellsState : ListsOrCellsState {
    CellGrid grid;
    CellPosition* positions;
    Cell* cells;
    std::uint32_t* overflows_of_cells;  // `overflow_capacity` discs for each cell
    std::uint32_t overflow_capacity;    // a multiple of 8; 0 where cells rarely overflow
    Vec2 path_middle;
    double max_drift;             // drift of the cells within half a period
    double reach_of_far_cells;    // cells at rest nearer to the middle than this are far
    double far_from_wall_square;  // its square for the current drift
    std::uint32_t near_wall_count, unassigned_count;
    std::uint32_t *near_wall, *unassigned;  // discs that can reach the wall; discs without a cell
    double min_width;                       // smallest width of a cell
    // Counts since the width was last chosen, and the count at which lists are considered next.
    std::uint64_t candidates_tested, cell_changes_before, candidates_at_next_test;

    SWIRL_INLINE std::uint32_t* overflow(std::uint32_t cell) const {
        return overflows_of_cells + static_cast<std::uint64_t>(cell) * overflow_capacity;
    }
    SWIRL_INLINE std::uint32_t& disc_in_cell(std::uint32_t cell, std::uint32_t slot) const {
        return slot < Cell::capacity ? cells[cell].disc[slot]
                                     : overflow(cell)[slot - Cell::capacity];
    }
};

}  // namespace swirl
