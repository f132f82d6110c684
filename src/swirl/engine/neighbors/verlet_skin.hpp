// Speed only, changes no bit: Verlet lists. Each disc has a skin: a circle of radius h_i about a
// point X_i that rests in a co-moving frame, which moves with the mean velocity of all discs and
// turns with them (comoving_frame.hpp). While every disc is within its own skin, only pairs with
//
//     |X_i − X_k| < r_i + r_k + h_i + h_k
//
// can touch, and these are on each other's lists. No distance in the frame ever shrinks. A disc
// about to leave its skin gets a new one where it stands, and its list is rebuilt. Lists change
// what is predicted, never what happens: a disc keeps the state it had, and a pair off the lists
// cannot meet.
//
// The skin radius adapts by itself: h_i is half the gap to the nearest disc but
// `wanted_neighbours`, so that a list fits in one vector. In a gas that is a long way, in the pack
// a short one; the dish has both at once. A disc much larger than the smallest has more of them, as
// many as fit around it. (Lists rebuilt one disc at a time: Smallenburg 2022,
// doi:10.1140/epje/s10189-022-00180-8, there with one skin radius for all.)
//
// Who may be on a list is found in square cells. Discs of about one size have a grid of their own:
// cells as wide as the largest disc would hold thousands of the smallest (Ogarko and Luding 2012,
// doi:10.1063/1.3692069, and Krijgsman, Ogarko and Luding 2014, doi:10.1007/s40571-014-0020-9, on
// hierarchical grids).
#pragma once

#include <cstring>

#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/math/lanes.hpp"
#include "swirl/physics/contact_time.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// Rounding errors of positions are 10⁻¹³; this keeps them out of the argument above.
inline constexpr double skin_margin = 1e-9;

/// How far a disc may go from the centre of its skin.
template <class Real>
SWIRL_INLINE Real inner_skin_radius(const Real& skin_radius) {
    return skin_radius * Real(1.0 - skin_margin);
}
SWIRL_INLINE double inner_skin_radius(const Skin& skin) {
    return inner_skin_radius<double>(skin.skin_radius);
}

/// Its centre is rounded to single precision, by less than this share of its distance from the
/// origin of the frame.
inline constexpr double rounding_of_centre = 0x1p-22;

/// A circle so narrow that the disc it was drawn about may be outside.
SWIRL_INLINE bool is_lost_in_rounding(const Skin& skin) {
    const double distance = magnitude(double(skin.X)) + magnitude(double(skin.Y));
    return skin.skin_radius < rounding_of_centre * distance;
}

/// How far from the centre of the container a disc may reach without touching the wall, with room
/// for the rounding of places to single precision.
SWIRL_INLINE double reach_short_of_wall(const EngineState& state) {
    return state.container_radius * (1.0 - 1e-6);
}
/// Who is far from the wall, from a time on: a disc with radius r whose skin has radius h and is at
/// s from the centre of the container cannot reach the wall before the leg ends, or a stretch of
/// it, if growth |s| < reach - h - r.
struct WallReach {
    double reach, growth;
};
/// The skin drifts against the container, as what is in the container's centre does, and away from
/// there as the frame stretches; and the container turns away from its course by no more than half
/// its acceleration times the square of the time.
SWIRL_INLINE WallReach reach_far_from_wall(const EngineState& state, double t) {
    const Segment& segment = state.segments[state.segment];
    const ComovingFrame& frame = state.comoving_frame;
    const double time = state.stretch_end - t;
    const Vec2 rate = frame.rate_at(t);
    const Vec2 centre = segment.position_at(t) - frame.origin.position_at(t);
    const Vec2 drift =
        time * (frame.origin.velocity + complex_product(rate, centre) - segment.velocity_at(t));
    const double turn = time * rate.y, growth = 1.0 + time * rate.x + 0.5 * turn * turn;
    const double reach = reach_short_of_wall(state) - square_root(dot(drift, drift));
    if (segment.turning == 0.0) return {reach, growth};
    const double speed = square_root(dot(segment.velocity, segment.velocity));
    return {reach - 0.5 * speed * magnitude(segment.turning) * time * time, growth};
}

/// Negative if a skin whose centre is at s from that of the container does not reach so far.
template <class Real>
SWIRL_INLINE Real beyond_reach(const Real& reach, const BasicVec2<Real>& s, const Real& skin_radius,
                               const Real& radius) {
    const Real room = larger(reach - skin_radius - radius, Real(0.0));
    return dot(s, s) - room * room;
}

static void note_far_from_wall(EngineState& state, std::uint32_t i, double t) {
    const Skin& mine = state.skins[i];
    const Vec2 centre = state.comoving_frame.flight_of(mine).position_at(t);
    const Vec2 s = centre - state.segments[state.segment].position_at(t);
    const double skin_radius = mine.skin_radius;
    const WallReach far = reach_far_from_wall(state, t);
    state.discs[i].far_from_wall =
        beyond_reach(far.reach, far.growth * s, skin_radius, state.discs[i].radius) < 0.0;
}

SWIRL_INLINE std::uint32_t cell_row(const EngineState& state, const Grid& grid, double x) {
    const double k = (x - state.cell_origin) * grid.cells_per_length;
    if (!(k > 0.0)) return 0;
    const auto row = static_cast<std::uint32_t>(k);
    return row < grid.cells_per_side ? row : grid.cells_per_side - 1;
}
SWIRL_INLINE std::uint32_t cell_number(const EngineState& state, const Grid& grid, double x,
                                       double y) {
    return cell_row(state, grid, y) * grid.cells_per_side + cell_row(state, grid, x);
}
SWIRL_INLINE const Grid& grid_of(const EngineState& state, std::uint32_t i) {
    return state.grids[state.grid_count == 1 ? 0 : state.kinds[state.discs[i].kind].grid];
}
SWIRL_INLINE std::uint32_t cell_of(const EngineState& state, const Grid& grid, std::uint32_t i) {
    return cell_number(state, grid, state.skins[i].X, state.skins[i].Y);
}
SWIRL_INLINE void enter_cell(EngineState& state, std::uint32_t i) {
    const Grid& grid = grid_of(state, i);
    const std::uint32_t number = cell_of(state, grid, i);
    if (grid.cells != nullptr && grid.cells[number].count < Cell::room) {
        Cell& cell = grid.cells[number];
        cell.disc[cell.count++] = i;
        return;
    }
    std::uint32_t& head = grid.heads[number];
    state.skins[i].next_in_cell = head;
    head = i;
}
SWIRL_INLINE bool leave_room(const Grid& grid, std::uint32_t number, std::uint32_t i) {
    if (grid.cells == nullptr) return false;
    Cell& cell = grid.cells[number];
    // The eighth of its numbers is how many there are, and those from there on are none of them.
    const std::uint32_t slot = place_in_list(cell.disc, 8, i);
    if (slot >= cell.count || cell.disc[slot] != i) return false;
    cell.disc[slot] = cell.disc[--cell.count];
    return true;
}
SWIRL_INLINE void leave_cell(EngineState& state, std::uint32_t i) {
    const Grid& grid = grid_of(state, i);
    const std::uint32_t number = cell_of(state, grid, i);
    if (leave_room(grid, number, i)) return;
    std::uint32_t* link = &grid.heads[number];
    while (*link != i) link = &state.skins[*link].next_in_cell;
    *link = state.skins[i].next_in_cell;
}
static void empty_cells(EngineState& state, const Grid& grid) {
    const std::uint32_t cells = grid.cells_per_side * grid.cells_per_side;
    for (std::uint32_t c = 0; c < cells; ++c) grid.heads[c] = state.size;
    if (grid.cells == nullptr) return;
    for (std::uint32_t c = 0; c < cells; ++c) grid.cells[c].count = 0;
}

SWIRL_INLINE bool is_full(const EngineState& state, std::uint32_t i) {
    if (state.discs[i].neighbours != state.capacity) return false;
    return state.tails == nullptr || state.tail(i).length == state.tail(i).room;
}
SWIRL_INLINE void add_neighbour(EngineState& state, std::uint32_t i, std::uint32_t k) {
    const std::uint32_t length = state.discs[i].neighbours;
    if (length == state.capacity) {
        ListTail& tail = state.tail(i);
        tail.neighbours()[tail.length++] = k;
        return;
    }
    state.cold(i).neighbours()[length] = k;
    state.discs[i].neighbours = (length + 1) & 127u;
}
/// From a list that has a tail, whose last takes the place of k.
[[gnu::noinline]] static void remove_from_tailed_list(EngineState& state, std::uint32_t i,
                                                      std::uint32_t k) {
    ListTail& tail = state.tail(i);
    const std::uint32_t last = tail.neighbours()[--tail.length];
    tail.neighbours()[tail.length] = state.size;
    if (last == k) return;
    std::uint32_t* const list = state.cold(i).neighbours();
    const std::uint32_t slot = place_in_list(list, state.capacity, k);
    if (list[slot] == k)
        list[slot] = last;
    else
        tail.neighbours()[place_in_list(tail.neighbours(), tail.room, k)] = last;
}
SWIRL_INLINE void remove_neighbour(EngineState& state, std::uint32_t i, std::uint32_t k) {
    if (state.tails != nullptr && state.tail(i).length > 0)
        return remove_from_tailed_list(state, i, k);
    std::uint32_t* const list = state.cold(i).neighbours();
    const std::uint32_t last = state.discs[i].neighbours - 1;
    const std::uint32_t slot = place_in_list(list, state.capacity, k);
    list[slot] = list[last];
    list[last] = state.size;
    state.discs[i].neighbours = last & 127u;
}
SWIRL_INLINE void clear_list(EngineState& state, std::uint32_t i) {
    std::uint32_t* const list = state.cold(i).neighbours();
    const std::uint32_t length = state.discs[i].neighbours;
    for (std::uint32_t slot = 0; slot < length; ++slot) {
        remove_neighbour(state, list[slot], i);
        list[slot] = state.size;
    }
    state.discs[i].neighbours = 0;
    if (state.tails == nullptr) return;
    ListTail& tail = state.tail(i);
    for (std::uint32_t slot = 0; slot < tail.length; ++slot) {
        remove_neighbour(state, tail.neighbours()[slot], i);
        tail.neighbours()[slot] = state.size;
    }
    tail.length = 0;
}

/// The bounds of h_i; below `least` there is no room for a disc on the lists of those around it.
struct SkinRadiusRange {
    double minimum, largest;
};

/// The discs around one of them: `gap` is |X_i − X_k| − r_i − r_k and `reach` is h_k. Both are
/// padded to a multiple of eight with discs that are infinitely far. Who is not among them is
/// beyond the reach of a skin of radius `farthest`, and farther away than twice that.
struct Candidates : CandidateColumns {
    explicit Candidates(const EngineState& state) : CandidateColumns(state.candidates) {}
    std::uint32_t count, padded;
    double farthest;
};

/// Writes down disc k as candidate n.
SWIRL_INLINE void note(const EngineState& state, const CandidateColumns& candidates,
                       std::uint32_t n, std::uint32_t k) {
    const Skin& other = state.skins[k];
    candidates.disc[n] = k;
    candidates.X[n] = other.X;
    candidates.Y[n] = other.Y;
    candidates.reach[n] = other.skin_radius;
}

SWIRL_INLINE void pad(const EngineState& state, Candidates& candidates) {
    candidates.padded = (candidates.count + 7u) & ~7u;
    // Eight of them, however many it takes: there is room, and no branch to be guessed wrong.
    for (std::uint32_t n = 0; n < 8; ++n) {
        candidates.gap[candidates.count + n] = never;
        candidates.reach[candidates.count + n] = 0.0;
        candidates.disc[candidates.count + n] = state.size;
    }
}

/// Everybody within so much of disc i, whatever their sizes. False if there are too many to hold.
static bool collect_within(const EngineState& state, std::uint32_t i, double scale, double farthest,
                           Candidates& candidates) {
    const Skin& mine = state.skins[i];
    const double X = mine.X, Y = mine.Y, radius = state.discs[i].radius;
    candidates.farthest = farthest;
    candidates.count = 0;
    for (std::uint32_t g = 0; g < state.grid_count; ++g) {
        const Grid& grid = state.grids[g];
        const double width = 1.0 / grid.cells_per_length;
        const double way =
            (radius + grid.largest_radius + farthest + state.largest_skin_radius) * (1.0 + 1e-6);
        const std::uint32_t bottom = cell_row(state, grid, Y - way);
        const std::uint32_t top = cell_row(state, grid, Y + way);
        for (std::uint32_t y = bottom; y <= top; ++y) {
            // In a row the circle is narrower; the outermost rows go on beyond the grid.
            const double low = state.cell_origin + y * width;
            const double up = y == 0 || y + 1 == grid.cells_per_side
                                  ? 0.0
                                  : larger(larger(low - Y, Y - (low + width)), 0.0);
            const double across = square_root(larger(way * way - up * up, 0.0)) + 1e-6 * width;
            const std::uint32_t left = cell_row(state, grid, X - across);
            const std::uint32_t right = cell_row(state, grid, X + across);
            const auto look_at = [&](std::uint32_t k) {
                if (candidates.count == candidates.room) return false;
                const Skin& other = state.skins[k];
                const double dx = other.X - X, dy = other.Y - Y;
                const double theirs =
                    grid.equal_radii ? grid.largest_radius : state.discs[k].radius;
                const double gap = scale * square_root(dx * dx + dy * dy) - (radius + theirs);
                // Half of them are too far, in no order: a branch would be mispredicted.
                note(state, candidates, candidates.count, k);
                candidates.gap[candidates.count] = gap;
                const bool near = gap < farthest + larger(farthest, double(other.skin_radius));
                candidates.count += near & (k != i);
                return true;
            };
            for (std::uint32_t x = left; x <= right; ++x) {
                const std::uint32_t number = y * grid.cells_per_side + x;
                if (grid.cells != nullptr)
                    for (std::uint32_t n = 0; n < grid.cells[number].count; ++n)
                        if (!look_at(grid.cells[number].disc[n])) return false;
                for (std::uint32_t k = grid.heads[number]; k != state.size;
                     k = state.skins[k].next_in_cell)
                    if (!look_at(k)) return false;
            }
        }
    }
    pad(state, candidates);
    return true;
}
/// So far as there is room for. False if even the narrowest skin reaches too many.
[[gnu::noinline]] static bool collect_within(const EngineState& state, std::uint32_t i,
                                             double scale, const SkinRadiusRange& range,
                                             Candidates& candidates) {
    for (double farthest = range.largest;; farthest = larger(0.5 * farthest, range.minimum)) {
        if (collect_within(state, i, scale, farthest, candidates)) return true;
        if (!(farthest > range.minimum)) return false;
    }
}

/// Those in the cell of disc i and in the eight around, where one grid holds all; without a grid
/// everybody. Returns how many, or more than there is room for.
SWIRL_INLINE std::uint32_t collect_next_door(const EngineState& state, std::uint32_t i,
                                             const CandidateColumns& candidates) {
    const std::uint32_t nobody = state.size;
    if (state.has_no_grid) {
        for (std::uint32_t k = 0; k < nobody; ++k) note(state, candidates, k, k);
        note(state, candidates, i, nobody - 1);  // the last one takes our place
        return nobody - 1;
    }
    const Grid& grid = state.grids[0];
    const Skin& mine = state.skins[i];
    const std::uint32_t cx = cell_row(state, grid, mine.X), cy = cell_row(state, grid, mine.Y);
    const std::uint32_t last = grid.cells_per_side - 1;
    const auto for_nine_cells = [&](auto look_at) {
        for (std::uint32_t y = cy - (cy > 0); y <= cy + (cy < last); ++y)
            for (std::uint32_t x = cx - (cx > 0); x <= cx + (cx < last); ++x)
                look_at(y * grid.cells_per_side + x);
    };
    std::uint32_t count = 0;
    bool some_have_no_room = true;
    if (grid.cells != nullptr) {
        // Whole cells, as in linked_cells.hpp.
        std::uint32_t found[9 * Cell::room + 1], all = 0;
        some_have_no_room = false;
        for_nine_cells([&](std::uint32_t number) {
            std::memcpy(found + all, &grid.cells[number], sizeof(Cell));
            all += grid.cells[number].count;
            some_have_no_room |= grid.heads[number] != nobody;
        });
        for (std::uint32_t n = 0; n < all; ++n) {
            note(state, candidates, count, found[n]);
            count += found[n] != i;
        }
    }
    if (some_have_no_room)
        for_nine_cells([&](std::uint32_t number) {
            for (std::uint32_t k = grid.heads[number]; k != nobody && count <= candidates.room;
                 k = state.skins[k].next_in_cell) {
                if (count < candidates.room) note(state, candidates, count, k);
                count += k != i;
            }
        });
    return count;
}

/// Collects every disc that two skins may reach across to. False if there are too many to hold.
SWIRL_INLINE bool collect_candidates(const EngineState& state, std::uint32_t i,
                                     const SkinRadiusRange& range, Candidates& candidates) {
    const double scale = state.comoving_frame.scale;
    if (state.grid_count > 1) return collect_within(state, i, scale, range, candidates);
    const CandidateColumns columns = state.candidates;
    const std::uint32_t count = collect_next_door(state, i, columns);
    if (count > columns.room) return collect_within(state, i, scale, range, candidates);
    const Skin& mine = state.skins[i];
    const std::uint32_t padded = (count + 7u) & ~7u;
    const double X = mine.X, Y = mine.Y, radii = state.discs[i].radius + state.smallest_radius;
    for (std::uint32_t n = 0; n < padded; ++n) {
        const double dx = static_cast<double>(columns.X[n]) - X;
        const double dy = static_cast<double>(columns.Y[n]) - Y;
        columns.gap[n] = scale * square_root(dx * dx + dy * dy) - radii;
    }
    candidates.count = count;
    // Where all are alike, nobody's disc is looked at: in a large dish each is far away in memory.
    if (!state.equal_radii)
        for (std::uint32_t n = 0; n < candidates.count; ++n)
            candidates.gap[n] -= state.discs[candidates.disc[n]].radius - state.smallest_radius;
    pad(state, candidates);
    candidates.farthest = range.largest;
    return true;
}

/// Half the gap to the nearest disc that is to stay off the list, to a fifth: if everybody does the
/// same, no one's skin is at the cost of the others'. Starts from the skin radius the disc had.
SWIRL_INLINE double fair_skin_radius(const Candidates& candidates, std::uint32_t wanted,
                                     double before, const SkinRadiusRange& range) {
    if (candidates.count <= wanted) return range.largest;
    const auto too_many = [&](double skin_radius) {
        return count_below(candidates.gap, candidates.padded, 2.0 * skin_radius) > wanted;
    };
    double skin_radius = smaller(larger(before, 2.0 * range.minimum), range.largest);
    if (too_many(skin_radius)) {
        do skin_radius *= 0.8;
        while (skin_radius > range.minimum && too_many(skin_radius));
        return larger(skin_radius, range.minimum);
    }
    while (skin_radius < range.largest && !too_many(1.25 * skin_radius)) skin_radius *= 1.25;
    return smaller(skin_radius, range.largest);
}

/// Sets X_i where the disc is at time t, with a skin radius of 0 for now.
static void centre_skin(EngineState& state, std::uint32_t i, double t) {
    const Vec2 at = state.comoving_frame.place_of(state.discs[i].flight().position_at(t), t);
    state.skins[i] = {static_cast<float>(at.x), static_cast<float>(at.y), {0.0f}, {state.size}};
    if (!state.has_no_grid) enter_cell(state, i);
}

/// Takes disc i off all lists and centres its skin on it. Returns the skin radius it had.
static double recentre_skin(EngineState& state, std::uint32_t i, double t) {
    const double before = state.skins[i].skin_radius;
    clear_list(state, i);
    if (!state.has_no_grid) leave_cell(state, i);
    centre_skin(state, i, t);
    return before;
}

/// Of 64 candidates those whose skins a skin of this radius reaches. All at once: how many of eight
/// there are would be guessed wrong every time.
SWIRL_INLINE std::uint64_t closer_of_64(const Candidates& candidates, std::uint32_t begin,
                                        double skin_radius) {
    const std::uint32_t end = candidates.padded - begin < 64 ? candidates.padded : begin + 64;
    std::uint64_t bits = 0;
    for (std::uint32_t k = begin; k < end; k += 8)
        bits |= static_cast<std::uint64_t>(
                    lanes_closer(candidates.gap + k, candidates.reach + k, skin_radius))
                << (k - begin);
    return bits;
}

/// Gives disc i, whose skin was just recentred, its skin radius and its list. Discs that have no
/// skin radius are passed over: they find i when they build theirs. False if a list overflows.
static bool build_list(EngineState& state, std::uint32_t i, double t, double before,
                       const SkinRadiusRange& range) {
    Candidates candidates(state);
    if (!collect_candidates(state, i, range, candidates)) return false;
    const DiscKind& kind = state.kinds[state.equal_radii ? 0 : state.discs[i].kind];
    double skin_radius = fair_skin_radius(candidates, kind.wanted_neighbours, before,
                                          {range.minimum, candidates.farthest});
    const std::uint32_t maximum =
        state.capacity + (state.tails == nullptr ? 0 : state.tail(i).room);
    for (;;) {
        std::uint32_t count = 0;
        bool room = true;
        for (std::uint32_t begin = 0; begin < candidates.padded && room; begin += 64) {
            std::uint64_t bits = closer_of_64(candidates, begin, skin_radius);
            for (; bits != 0; bits &= bits - 1) {
                const std::uint32_t n = begin + static_cast<std::uint32_t>(__builtin_ctzll(bits));
                if (candidates.reach[n] == 0.0) continue;
                if (count == maximum || is_full(state, candidates.disc[n])) {
                    room = false;
                    break;
                }
                candidates.chosen[count++] = candidates.disc[n];
            }
        }
        if (room) {
            for (std::uint32_t k = 0; k < count; ++k) {
                add_neighbour(state, i, candidates.chosen[k]);
                add_neighbour(state, candidates.chosen[k], i);
            }
            break;
        }
        skin_radius *= 0.7;
        if (skin_radius < range.minimum) return false;
    }
    // Rounded down, so that the single-precision number is on the safe side.
    Skin& mine = state.skins[i];
    mine.skin_radius = static_cast<float>(skin_radius * (1.0 - 0x1p-22));
    note_far_from_wall(state, i, t);
    return true;
}

/// Makes room for the list of disc i, which overflowed: whoever's skin reaches it is recentred and
/// its list rebuilt. Writes the numbers of all discs whose lists have changed into
/// EngineState::candidates.rebuilt; returns how many, 0 if it is all of them.
static std::uint32_t resolve_overflow(EngineState& state, std::uint32_t i, double t,
                                      const SkinRadiusRange& range) {
    const std::uint32_t room = state.candidates.room;
    std::uint32_t* const rebuilt = state.candidates.rebuilt;
    rebuilt[0] = i;
    std::uint32_t count = 1;
    for (std::uint32_t next = 0; next < count; ++next) {
        const std::uint32_t k = rebuilt[next];
        // Who was recentred again after its list was built is among them twice.
        if (state.skins[k].skin_radius != 0.0f || build_list(state, k, t, 0.0, range)) continue;
        Candidates candidates(state);
        if (!collect_candidates(state, k, range, candidates)) return 0;
        for (std::uint32_t n = 0; n < candidates.count; ++n) {
            if (candidates.reach[n] == 0.0 ||
                candidates.gap[n] - candidates.reach[n] >= range.minimum)
                continue;
            if (count + 1 >= room) return 0;
            recentre_skin(state, candidates.disc[n], t);
            rebuilt[count++] = candidates.disc[n];
        }
        if (!build_list(state, k, t, 0.0, range)) return 0;
    }
    return count;
}

/// Everybody's list anew, with skins about as wide as told. False if one overflows.
static bool rebuild_all_lists(EngineState& state, double t, double skin_radius,
                              const SkinRadiusRange& range) {
    for (std::uint32_t g = 0; g < state.grid_count; ++g) empty_cells(state, state.grids[g]);
    for (std::uint32_t i = 0; i < state.size; ++i) {
        if (state.stops_at(i)) return true;
        for (std::uint32_t slot = 0; slot < state.capacity; ++slot)
            state.cold(i).neighbours()[slot] = state.size;
        state.discs[i].neighbours = 0;
        if (state.tails != nullptr) {
            ListTail& tail = state.tail(i);
            for (std::uint32_t slot = 0; slot < tail.room; ++slot)
                tail.neighbours()[slot] = state.size;
            tail.length = 0;
        }
        centre_skin(state, i, t);
    }
    for (std::uint32_t i = 0; i < state.size; ++i) {
        if (state.stops_at(i)) return true;
        if (!build_list(state, i, t, skin_radius, range)) return false;
    }
    return true;
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
