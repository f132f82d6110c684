// Speed only; results stay bitwise identical. Verlet lists. Each disc has a skin: a circle of
// radius h_i about a point X_i that is at rest in a co-moving frame. The frame moves with the mean
// velocity of all discs and turns with them (comoving_frame.hpp). While every disc is within its
// own skin, only pairs with
//
//     |X_i − X_k| < r_i + r_k + h_i + h_k
//
// can touch, and these are on each other's lists. Distances in the frame never shrink. A disc about
// to leave its skin gets a new one around its current position, and its list is rebuilt. Lists
// change what is predicted, never what happens: a disc keeps its stored state, and a pair that is
// not on the lists cannot collide.
//
// The skin radius adapts itself. h_i is half the gap to the nearest disc beyond the first
// `target_length`, so that a list fits in one vector. In a gas that gap is wide, in a cluster
// narrow, and a container has both at once. A disc much larger than the smallest has a longer list,
// with as many discs as fit around it. (Rebuilding one list at a time: Smallenburg 2022,
// doi:10.1140/epje/s10189-022-00180-8, with one skin radius for all discs.)
//
// Candidates for a list are found in square cells. Discs of about one size have a grid of their
// own: cells as wide as the largest disc would hold thousands of the smallest (hierarchical grids:
// Ogarko and Luding 2012, doi:10.1063/1.3692069; Krijgsman, Ogarko and Luding 2014,
// doi:10.1007/s40571-014-0020-9).
#pragma once

#include <cstring>

#include "swirl/engine/neighbors/disc_grid.hpp"
#include "swirl/engine/neighbors/search_states.hpp"
#include "swirl/math/lanes.hpp"
#include "swirl/physics/contact_time.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// Keeps rounding errors of positions, about 10⁻¹³, out of the argument above.
inline constexpr double skin_margin = 1e-9;

/// How far a disc may be from the centre of its skin.
template <class Real>
SWIRL_INLINE Real inner_skin_radius(const Real& skin_radius) {
    return skin_radius * Real(1.0 - skin_margin);
}
SWIRL_INLINE double inner_skin_radius(const Skin& skin) {
    return inner_skin_radius<double>(skin.radius);
}

/// The centre is rounded to single precision. The error is below this fraction of its distance from
/// the origin of the frame.
inline constexpr double rounding_of_centre = 0x1p-22;

/// True if the skin is so narrow that the disc may be outside after this rounding.
SWIRL_INLINE bool is_lost_in_rounding(const Skin& skin) {
    const double distance = magnitude(double(skin.X)) + magnitude(double(skin.Y));
    return skin.radius < rounding_of_centre * distance;
}

/// How far from the centre of the container a disc may reach without touching the wall, with a
/// margin for positions in single precision.
SWIRL_INLINE double reach_short_of_wall(const VerletListsState& state) {
    return state.container_radius * (1.0 - 1e-6);
}
/// A test for discs far from the wall. A disc of radius r has a skin of radius h, centred at s from
/// the container's centre. It cannot reach the wall before EngineState::interval_end if
/// growth |s| < reach − h − r.
struct WallReach {
    double reach, growth;
};
/// Three motions bring a skin nearer to the wall: its drift against the container, as at the
/// container's centre; the stretch of the frame; and on an arc the container's turn away from its
/// course, by at most half its acceleration times the square of the time.
SWIRL_INLINE WallReach reach_far_from_wall(const VerletListsState& state, double t) {
    const Segment& segment = state.segments[state.segment];
    const ComovingFrame& frame = state.comoving_frame;
    const double time = state.interval_end - t;
    const Vec2 rate = frame.rate_at(t);
    const Vec2 centre = segment.position_at(t) - frame.origin.position_at(t);
    const Vec2 drift =
        time * (frame.origin.velocity + complex_product(rate, centre) - segment.velocity_at(t));
    const double turn = time * rate.y, growth = 1.0 + time * rate.x + 0.5 * turn * turn;
    const double reach = reach_short_of_wall(state) - square_root(dot(drift, drift));
    if (segment.turn_rate == 0.0) return {reach, growth};
    const double speed = square_root(dot(segment.velocity, segment.velocity));
    return {reach - 0.5 * speed * magnitude(segment.turn_rate) * time * time, growth};
}

/// Negative if a skin centred at s from the container's centre is within the reach.
template <class Real>
SWIRL_INLINE Real beyond_reach(const Real& reach, const BasicVec2<Real>& s, const Real& skin_radius,
                               const Real& radius) {
    const Real limit = larger(reach - skin_radius - radius, Real(0.0));
    return dot(s, s) - limit * limit;
}

static void update_far_from_wall(VerletListsState& state, std::uint32_t i, double t) {
    const Skin& mine = state.skins[i];
    const Vec2 centre = state.comoving_frame.flight_of(mine.centre()).position_at(t);
    const Vec2 s = centre - state.segments[state.segment].position_at(t);
    const double skin_radius = mine.radius;
    const WallReach far = reach_far_from_wall(state, t);
    state.discs[i].far_from_wall =
        beyond_reach(far.reach, far.growth * s, skin_radius, state.discs[i].radius) < 0.0;
}

SWIRL_INLINE const DiscGrid& grid_of(const VerletListsState& state, std::uint32_t i) {
    const bool single = state.grid_count == 1;
    return state.grids[single ? 0 : state.species_lists[state.discs[i].species].grid];
}

SWIRL_INLINE bool is_full(const VerletListsState& state, std::uint32_t i) {
    if (state.discs[i].list_length != state.list_capacity) return false;
    return state.tails == nullptr || state.tail(i).length == state.tail(i).capacity;
}
SWIRL_INLINE void add_neighbour(VerletListsState& state, std::uint32_t i, std::uint32_t k) {
    const std::uint32_t length = state.discs[i].list_length;
    if (length == state.list_capacity) {
        ListTail& tail = state.tail(i);
        tail.neighbours()[tail.length++] = k;
        return;
    }
    state.cold(i).neighbours()[length] = k;
    state.discs[i].list_length = (length + 1) & 127u;
}
/// Removes k from a list that has a tail; the last entry takes its slot.
[[gnu::noinline]] static void remove_from_tailed_list(VerletListsState& state, std::uint32_t i,
                                                      std::uint32_t k) {
    ListTail& tail = state.tail(i);
    const std::uint32_t last = tail.neighbours()[--tail.length];
    tail.neighbours()[tail.length] = state.size;
    if (last == k) return;
    std::uint32_t* const list = state.cold(i).neighbours();
    const std::uint32_t slot = index_in_list(list, state.list_capacity, k);
    if (list[slot] == k)
        list[slot] = last;
    else
        tail.neighbours()[index_in_list(tail.neighbours(), tail.capacity, k)] = last;
}
SWIRL_INLINE void remove_neighbour(VerletListsState& state, std::uint32_t i, std::uint32_t k) {
    if (state.tails != nullptr && state.tail(i).length > 0)
        return remove_from_tailed_list(state, i, k);
    std::uint32_t* const list = state.cold(i).neighbours();
    const std::uint32_t last = state.discs[i].list_length - 1;
    const std::uint32_t slot = index_in_list(list, state.list_capacity, k);
    list[slot] = list[last];
    list[last] = state.size;
    state.discs[i].list_length = last & 127u;
}
SWIRL_INLINE void clear_list(VerletListsState& state, std::uint32_t i) {
    std::uint32_t* const list = state.cold(i).neighbours();
    const std::uint32_t length = state.discs[i].list_length;
    for (std::uint32_t slot = 0; slot < length; ++slot) {
        remove_neighbour(state, list[slot], i);
        list[slot] = state.size;
    }
    state.discs[i].list_length = 0;
    if (state.tails == nullptr) return;
    ListTail& tail = state.tail(i);
    for (std::uint32_t slot = 0; slot < tail.length; ++slot) {
        remove_neighbour(state, tail.neighbours()[slot], i);
        tail.neighbours()[slot] = state.size;
    }
    tail.length = 0;
}

/// The bounds of h_i. Below `minimum`, the lists of the discs around would have no capacity left.
struct SkinRadiusRange {
    double minimum, largest;
};

/// The discs around one of them: `gap` is |X_i − X_k| − r_i − r_k and `reach` is h_k. Both columns
/// are padded to a multiple of eight with infinitely distant discs. A disc that is not among the
/// candidates is beyond the reach of a skin of radius `farthest`, and farther away than twice that.
struct Candidates : CandidateColumns {
    explicit Candidates(const VerletListsState& state) : CandidateColumns(state.candidates) {}
    std::uint32_t count, padded;
    double farthest;
};

/// Stores disc k as candidate n.
SWIRL_INLINE void set_candidate(const VerletListsState& state, const CandidateColumns& candidates,
                                std::uint32_t n, std::uint32_t k) {
    const Skin& other = state.skins[k];
    candidates.disc[n] = k;
    candidates.X[n] = other.X;
    candidates.Y[n] = other.Y;
    candidates.reach[n] = other.radius;
}

SWIRL_INLINE void pad(const VerletListsState& state, Candidates& candidates) {
    candidates.padded = (candidates.count + 7u) & ~7u;
    // Always writes eight sentinels: there is capacity, and a loop of fixed length has no branch.
    for (std::uint32_t n = 0; n < 8; ++n) {
        candidates.gap[candidates.count + n] = never;
        candidates.reach[candidates.count + n] = 0.0;
        candidates.disc[candidates.count + n] = state.size;
    }
}

/// Collects all discs of any size whose skins a skin of radius `farthest` about disc i can reach.
/// Returns false if there are more than the capacity.
static bool collect_within(const VerletListsState& state, std::uint32_t i, double scale,
                           double farthest, Candidates& candidates) {
    const Skin& mine = state.skins[i];
    const double X = mine.X, Y = mine.Y, radius = state.discs[i].radius;
    candidates.farthest = farthest;
    candidates.count = 0;
    for (std::uint32_t g = 0; g < state.grid_count; ++g) {
        const DiscGrid& grid = state.grids[g];
        const double width = grid.width();
        const double distance =
            (radius + grid.largest_radius + farthest + state.largest_skin_radius) * (1.0 + 1e-6);
        const std::uint32_t bottom = grid.row_of(Y - distance);
        const std::uint32_t top = grid.row_of(Y + distance);
        for (std::uint32_t y = bottom; y <= top; ++y) {
            // Away from the middle the circle is narrower. The outermost
            // rows extend beyond the grid.
            const double low = grid.corner + y * width;
            const double up = y == 0 || y + 1 == grid.cells_per_side
                                  ? 0.0
                                  : larger(larger(low - Y, Y - (low + width)), 0.0);
            const double across =
                square_root(larger(distance * distance - up * up, 0.0)) + 1e-6 * width;
            const std::uint32_t left = grid.row_of(X - across);
            const std::uint32_t right = grid.row_of(X + across);
            const auto add = [&](std::uint32_t k) {
                if (candidates.count == candidates.capacity) return false;
                const Skin& other = state.skins[k];
                const double dx = other.X - X, dy = other.Y - Y;
                const double theirs =
                    grid.equal_radii ? grid.largest_radius : state.discs[k].radius;
                const double gap = scale * square_root(dx * dx + dy * dy) - (radius + theirs);
                // Half of them are too far, in no order, so a branch
                // would be mispredicted.
                set_candidate(state, candidates, candidates.count, k);
                candidates.gap[candidates.count] = gap;
                const bool near = gap < farthest + larger(farthest, double(other.radius));
                candidates.count += near & (k != i);
                return true;
            };
            for (std::uint32_t x = left; x <= right; ++x) {
                const std::uint32_t number = y * grid.cells_per_side + x;
                if (grid.cells != nullptr)
                    for (std::uint32_t n = 0; n < grid.cells[number].count; ++n)
                        if (!add(grid.cells[number].disc[n])) return false;
                for (std::uint32_t k = grid.heads[number]; k != state.size;
                     k = state.skins[k].next_in_cell)
                    if (!add(k)) return false;
            }
        }
    }
    pad(state, candidates);
    return true;
}
/// The same as far as the capacity allows. Returns false if even the
/// narrowest skin reaches too many.
[[gnu::noinline]] static bool collect_within(const VerletListsState& state, std::uint32_t i,
                                             double scale, const SkinRadiusRange& range,
                                             Candidates& candidates) {
    for (double farthest = range.largest;; farthest = larger(0.5 * farthest, range.minimum)) {
        if (collect_within(state, i, scale, farthest, candidates)) return true;
        if (!(farthest > range.minimum)) return false;
    }
}

/// Collects the discs in the cell of disc i and in the eight around it,
/// if one grid holds all discs; without a grid, all discs. Returns their
/// number, or a number above the capacity.
SWIRL_INLINE std::uint32_t collect_adjacent(const VerletListsState& state, std::uint32_t i,
                                            const CandidateColumns& candidates) {
    const std::uint32_t none = state.size;
    if (state.has_no_grid) {
        for (std::uint32_t k = 0; k < none; ++k) set_candidate(state, candidates, k, k);
        set_candidate(state, candidates, i,
                      none - 1);  // the last disc takes the slot of disc i
        return none - 1;
    }
    const DiscGrid& grid = state.grids[0];
    const Skin& mine = state.skins[i];
    const std::uint32_t cx = grid.row_of(mine.X), cy = grid.row_of(mine.Y);
    const std::uint32_t last = grid.cells_per_side - 1;
    const auto for_nine_cells = [&](auto add) {
        for (std::uint32_t y = cy - (cy > 0); y <= cy + (cy < last); ++y)
            for (std::uint32_t x = cx - (cx > 0); x <= cx + (cx < last); ++x)
                add(y * grid.cells_per_side + x);
    };
    std::uint32_t count = 0;
    bool have_overflow = true;
    if (grid.cells != nullptr) {
        // Copies whole cells, as in linked_cells.hpp.
        std::uint32_t found[9 * Cell::capacity + 1], all = 0;
        have_overflow = false;
        for_nine_cells([&](std::uint32_t number) {
            std::memcpy(found + all, &grid.cells[number], sizeof(Cell));
            all += grid.cells[number].count;
            have_overflow |= grid.heads[number] != none;
        });
        for (std::uint32_t n = 0; n < all; ++n) {
            set_candidate(state, candidates, count, found[n]);
            count += found[n] != i;
        }
    }
    if (have_overflow)
        for_nine_cells([&](std::uint32_t number) {
            for (std::uint32_t k = grid.heads[number]; k != none && count <= candidates.capacity;
                 k = state.skins[k].next_in_cell) {
                if (count < candidates.capacity) set_candidate(state, candidates, count, k);
                count += k != i;
            }
        });
    return count;
}

/// Collects every disc whose skin can overlap that of disc i. Returns
/// false if there are too many.
SWIRL_INLINE bool collect_candidates(const VerletListsState& state, std::uint32_t i,
                                     const SkinRadiusRange& range, Candidates& candidates) {
    const double scale = state.comoving_frame.scale;
    if (state.grid_count > 1) return collect_within(state, i, scale, range, candidates);
    const CandidateColumns columns = state.candidates;
    const std::uint32_t count = collect_adjacent(state, i, columns);
    if (count > columns.capacity) return collect_within(state, i, scale, range, candidates);
    const Skin& mine = state.skins[i];
    const std::uint32_t padded = (count + 7u) & ~7u;
    const double X = mine.X, Y = mine.Y, radii = state.discs[i].radius + state.smallest_radius;
    for (std::uint32_t n = 0; n < padded; ++n) {
        const double dx = static_cast<double>(columns.X[n]) - X;
        const double dy = static_cast<double>(columns.Y[n]) - Y;
        columns.gap[n] = scale * square_root(dx * dx + dy * dy) - radii;
    }
    candidates.count = count;
    // With equal radii no disc is read: with many discs each would be a
    // cache miss.
    if (!state.equal_radii)
        for (std::uint32_t n = 0; n < candidates.count; ++n)
            candidates.gap[n] -= state.discs[candidates.disc[n]].radius - state.smallest_radius;
    pad(state, candidates);
    candidates.farthest = range.largest;
    return true;
}

/// Half the gap to the nearest disc that should not be on the list, to
/// within a fifth. If all discs choose like this, none has its skin at
/// the cost of others. Starts from the previous skin radius.
SWIRL_INLINE double fair_skin_radius(const Candidates& candidates, std::uint32_t target,
                                     double before, const SkinRadiusRange& range) {
    if (candidates.count <= target) return range.largest;
    const auto too_many = [&](double skin_radius) {
        return count_below(candidates.gap, candidates.padded, 2.0 * skin_radius) > target;
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

/// Sets X_i to the position of the disc at time t, with a skin radius of
/// 0 for now.
static void centre_skin(VerletListsState& state, std::uint32_t i, double t) {
    const Vec2 at = state.comoving_frame.to_frame(state.discs[i].flight().position_at(t), t);
    state.skins[i] = {static_cast<float>(at.x), static_cast<float>(at.y), 0.0f, state.size};
    if (!state.has_no_grid) enter_cell(state, grid_of(state, i), i);
}

/// Removes disc i from all lists and centres its skin on it. Returns its
/// previous skin radius.
static double recentre_skin(VerletListsState& state, std::uint32_t i, double t) {
    const double before = state.skins[i].radius;
    clear_list(state, i);
    if (!state.has_no_grid) leave_cell(state, grid_of(state, i), i);
    centre_skin(state, i, t);
    return before;
}

/// Of 64 candidates, those whose skins a skin of this radius reaches, as
/// bits. All at once, because the number among eight is unpredictable.
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

/// Gives disc i, whose skin was just centred, its skin radius and its
/// list. Discs without a skin radius are skipped: they find disc i when
/// they build their lists. Returns false if a list overflows.
static bool build_list(VerletListsState& state, std::uint32_t i, double t, double before,
                       const SkinRadiusRange& range) {
    Candidates candidates(state);
    if (!collect_candidates(state, i, range, candidates)) return false;
    const std::uint32_t species = state.equal_radii ? 0 : state.discs[i].species;
    double skin_radius = fair_skin_radius(candidates, state.species_lists[species].target_length,
                                          before, {range.minimum, candidates.farthest});
    const std::uint32_t maximum =
        state.list_capacity + (state.tails == nullptr ? 0 : state.tail(i).capacity);
    for (;;) {
        std::uint32_t count = 0;
        bool fits = true;
        for (std::uint32_t begin = 0; begin < candidates.padded && fits; begin += 64) {
            std::uint64_t bits = closer_of_64(candidates, begin, skin_radius);
            for (; bits != 0; bits &= bits - 1) {
                const std::uint32_t n = begin + static_cast<std::uint32_t>(__builtin_ctzll(bits));
                if (candidates.reach[n] == 0.0) continue;
                if (count == maximum || is_full(state, candidates.disc[n])) {
                    fits = false;
                    break;
                }
                candidates.chosen[count++] = candidates.disc[n];
            }
        }
        if (fits) {
            for (std::uint32_t k = 0; k < count; ++k) {
                add_neighbour(state, i, candidates.chosen[k]);
                add_neighbour(state, candidates.chosen[k], i);
            }
            break;
        }
        skin_radius *= 0.7;
        if (skin_radius < range.minimum) return false;
    }
    // Rounded down, so that the rounding to single precision is on the
    // safe side.
    Skin& mine = state.skins[i];
    mine.radius = static_cast<float>(skin_radius * (1.0 - 0x1p-22));
    update_far_from_wall(state, i, t);
    return true;
}

/// Makes capacity for the list of disc i, which overflowed: every disc
/// whose skin reaches its skin is centred again and its list rebuilt.
/// Stores all discs whose lists have changed in
/// VerletListsState::candidates.rebuilt. Returns their number; 0 if all
/// lists must be rebuilt.
static std::uint32_t resolve_overflow(VerletListsState& state, std::uint32_t i, double t,
                                      const SkinRadiusRange& range) {
    const std::uint32_t capacity = state.candidates.capacity;
    std::uint32_t* const rebuilt = state.candidates.rebuilt;
    rebuilt[0] = i;
    std::uint32_t count = 1;
    for (std::uint32_t next = 0; next < count; ++next) {
        const std::uint32_t k = rebuilt[next];
        // A disc that was centred again after its list was built is in
        // the array twice.
        if (state.skins[k].radius != 0.0f || build_list(state, k, t, 0.0, range)) continue;
        Candidates candidates(state);
        if (!collect_candidates(state, k, range, candidates)) return 0;
        for (std::uint32_t n = 0; n < candidates.count; ++n) {
            if (candidates.reach[n] == 0.0 ||
                candidates.gap[n] - candidates.reach[n] >= range.minimum)
                continue;
            if (count + 1 >= capacity) return 0;
            recentre_skin(state, candidates.disc[n], t);
            rebuilt[count++] = candidates.disc[n];
        }
        if (!build_list(state, k, t, 0.0, range)) return 0;
    }
    return count;
}

/// Rebuilds all lists, with skins of about the given radius. Returns
/// false if a list overflows.
static bool rebuild_all_lists(VerletListsState& state, double t, double skin_radius,
                              const SkinRadiusRange& range) {
    for (std::uint32_t g = 0; g < state.grid_count; ++g) empty_cells(state, state.grids[g]);
    for (std::uint32_t i = 0; i < state.size; ++i) {
        if (state.stops_at(i)) return true;
        for (std::uint32_t slot = 0; slot < state.list_capacity; ++slot)
            state.cold(i).neighbours()[slot] = state.size;
        state.discs[i].list_length = 0;
        if (state.tails != nullptr) {
            ListTail& tail = state.tail(i);
            for (std::uint32_t slot = 0; slot < tail.capacity; ++slot)
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
