// Speed only, changes no bit: Verlet lists. Each disc has a skin: a circle of radius h_i about a
// point X_i that rests in a co-moving frame, which moves with the mean velocity of all discs. While
// every disc is within its own skin, only pairs with
//
//     |X_i − X_k| < r_i + r_k + h_i + h_k
//
// can touch, and these are on each other's lists. A disc about to leave its skin gets a new one
// where it stands, and its list is rebuilt. Lists change what is predicted, never what happens: a
// disc keeps the state it had, and a pair off the lists cannot meet.
//
// The skin radius adapts by itself: h_i is half the gap to the nearest disc but
// `wanted_neighbours`, so that a list fits in one vector. In a gas that is a long way, in the pack
// a short one; the dish has both at once. (Lists rebuilt one disc at a time: Smallenburg 2022,
// doi:10.1140/epje/s10189-022-00180-8, there with one skin radius for all.)
#pragma once

#include "swirl/math/lanes.hpp"
#include "swirl/physics/contact_time.hpp"
#include "swirl/simulation/search/state.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// Discs closer than twice a disc's skin radius, at most. Others may add themselves to its list, up
/// to the capacity.
inline constexpr std::uint32_t wanted_neighbours = 7;
/// Rounding errors of positions are 10⁻¹³; this keeps them out of the argument above.
inline constexpr double skin_margin = 1e-9;

/// How far a disc may go from the centre of its skin.
SWIRL_INLINE double inner_skin_radius(const Skin& skin) {
    return static_cast<double>(skin.skin_radius) * (1.0 - skin_margin);
}

/// From time t on the co-moving frame has the discs' mean velocity. The pack circles in the dish
/// with the swirl, so this is where most discs stay near; and in a large dish, where the wall is
/// far, they do not follow the container at all.
static void renew_comoving_frame(EngineState& state, const Vec2& origin, double t) {
    Vec2 sum{0.0, 0.0};
    for (std::uint32_t i = 0; i < state.size; ++i) sum = sum + state.discs[i].velocity;
    state.comoving_frame = {origin, (1.0 / state.size) * sum, t};
}

/// How far from the centre of the container a disc may reach without touching the wall, with room
/// for the rounding of places to single precision.
SWIRL_INLINE double reach_short_of_wall(const EngineState& state) {
    return state.container_radius * (1.0 - 1e-6);
}
/// How far from the centre of the container, at time t, a skin may reach so that its disc cannot
/// reach the wall before the leg ends: the skin drifts against the container.
SWIRL_INLINE double reach_far_from_wall(const EngineState& state, double t) {
    const Leg& leg = state.legs[state.leg];
    if (leg.turning != 0.0) return 0.0;
    const Vec2 drift = (leg.end - t) * (state.comoving_frame.velocity - leg.velocity);
    return reach_short_of_wall(state) - square_root(dot(drift, drift));
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
    const Vec2 centre = state.comoving_frame.position_at(t) + Vec2{mine.X, mine.Y};
    const Vec2 s = centre - state.legs[state.leg].position_at(t);
    const double skin_radius = mine.skin_radius;
    state.discs[i].far_from_wall =
        beyond_reach(reach_far_from_wall(state, t), s, skin_radius, state.discs[i].radius) < 0.0;
}

SWIRL_INLINE std::uint32_t cell_row(const EngineState& state, double x) {
    const double k = (x - state.cell_origin) * state.cells_per_length;
    if (!(k > 0.0)) return 0;
    const auto row = static_cast<std::uint32_t>(k);
    return row < state.cells_per_side ? row : state.cells_per_side - 1;
}
SWIRL_INLINE std::uint32_t& cell_head(const EngineState& state, const Skin& at) {
    return state.cell_heads[cell_row(state, at.Y) * state.cells_per_side + cell_row(state, at.X)];
}
SWIRL_INLINE void enter_cell(EngineState& state, std::uint32_t i) {
    std::uint32_t& head = cell_head(state, state.skins[i]);
    state.skins[i].next_in_cell = head;
    head = i;
}
SWIRL_INLINE void leave_cell(EngineState& state, std::uint32_t i) {
    std::uint32_t* link = &cell_head(state, state.skins[i]);
    while (*link != i) link = &state.skins[*link].next_in_cell;
    *link = state.skins[i].next_in_cell;
}

SWIRL_INLINE bool is_full(const EngineState& state, std::uint32_t i) {
    return state.discs[i].neighbours == state.capacity;
}
SWIRL_INLINE void add_neighbour(EngineState& state, std::uint32_t i, std::uint32_t k) {
    const std::uint32_t length = state.discs[i].neighbours;
    state.cold(i).neighbours()[length] = k;
    state.discs[i].neighbours = (length + 1) & 127u;
}
SWIRL_INLINE void remove_neighbour(EngineState& state, std::uint32_t i, std::uint32_t k) {
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
}

/// The discs around one of them: `gap` is |X_i − X_k| − r_i − r_k and `reach` is h_k. Both are
/// padded to a multiple of eight with discs that are infinitely far.
struct Candidates {
    static constexpr std::uint32_t room = 512;
    alignas(64) double gap[room];
    alignas(64) double reach[room];
    float X[room], Y[room];
    std::uint32_t disc[room];
    std::uint32_t count, padded;
};

SWIRL_INLINE void add(const EngineState& state, Candidates& candidates, std::uint32_t k) {
    const Skin& other = state.skins[k];
    candidates.disc[candidates.count] = k;
    candidates.X[candidates.count] = other.X;
    candidates.Y[candidates.count] = other.Y;
    candidates.reach[candidates.count] = other.skin_radius;
}

/// Collects every disc that two skins may reach across to. False if there are too many to hold.
SWIRL_INLINE bool collect_candidates(const EngineState& state, std::uint32_t i,
                                     Candidates& candidates) {
    const Skin& mine = state.skins[i];
    candidates.count = 0;
    if (state.cells_per_side == 1) {
        if (state.size > Candidates::room) return false;
        for (std::uint32_t k = 0; k < state.size; ++k, ++candidates.count)
            add(state, candidates, k);
        candidates.count = i;
        add(state, candidates, state.size - 1);  // the last one takes our place
        candidates.count = state.size - 1;
    } else {
        const std::uint32_t cx = cell_row(state, mine.X), cy = cell_row(state, mine.Y);
        const std::uint32_t last = state.cells_per_side - 1;
        for (std::uint32_t y = cy - (cy > 0); y <= cy + (cy < last); ++y)
            for (std::uint32_t x = cx - (cx > 0); x <= cx + (cx < last); ++x)
                for (std::uint32_t k = state.cell_heads[y * state.cells_per_side + x];
                     k != state.size; k = state.skins[k].next_in_cell) {
                    if (candidates.count == Candidates::room) return false;
                    add(state, candidates, k);
                    candidates.count += k != i;
                }
    }
    candidates.padded = (candidates.count + 7u) & ~7u;
    const double X = mine.X, Y = mine.Y, radii = state.discs[i].radius + state.smallest_radius;
    for (std::uint32_t n = 0; n < candidates.padded; ++n) {
        const double dx = static_cast<double>(candidates.X[n]) - X;
        const double dy = static_cast<double>(candidates.Y[n]) - Y;
        candidates.gap[n] = square_root(dx * dx + dy * dy) - radii;
    }
    // Where all are alike, nobody's disc is looked at: in a large dish each is far away in memory.
    if (!state.equal_radii)
        for (std::uint32_t n = 0; n < candidates.count; ++n)
            candidates.gap[n] -= state.discs[candidates.disc[n]].radius - state.smallest_radius;
    for (std::uint32_t n = candidates.count; n < candidates.padded; ++n) {
        candidates.gap[n] = never;
        candidates.reach[n] = 0.0;
        candidates.disc[n] = state.size;
    }
    return true;
}

/// The bounds of h_i; below `least` there is no room for a disc on the lists of those around it.
struct SkinRadiusRange {
    double least, largest;
};

/// Half the gap to the nearest disc that is to stay off the list, to a fifth: if everybody does the
/// same, no one's skin is at the cost of the others'. Starts from the skin radius the disc had.
SWIRL_INLINE double fair_skin_radius(const Candidates& candidates, double before,
                                     const SkinRadiusRange& range) {
    if (candidates.count <= wanted_neighbours) return range.largest;
    const auto too_many = [&](double skin_radius) {
        return count_below(candidates.gap, candidates.padded, 2.0 * skin_radius) >
               wanted_neighbours;
    };
    double skin_radius = smaller(larger(before, 2.0 * range.least), range.largest);
    if (too_many(skin_radius)) {
        do skin_radius *= 0.8;
        while (skin_radius > range.least && too_many(skin_radius));
        return larger(skin_radius, range.least);
    }
    while (skin_radius < range.largest && !too_many(1.25 * skin_radius)) skin_radius *= 1.25;
    return smaller(skin_radius, range.largest);
}

/// Sets X_i where the disc is at time t, with a skin radius of 0 for now.
static void centre_skin(EngineState& state, std::uint32_t i, double t) {
    const HotDisc& disc = state.discs[i];
    const Vec2 at = Flight<double>{disc.position, disc.velocity, disc.time}.position_at(t) -
                    state.comoving_frame.position_at(t);
    state.skins[i] = {static_cast<float>(at.x), static_cast<float>(at.y), 0.0f, {state.size}};
    if (state.cells_per_side > 1) enter_cell(state, i);
}

/// Takes disc i off all lists and centres its skin on it. Returns the skin radius it had.
static double recentre_skin(EngineState& state, std::uint32_t i, double t) {
    const double before = state.skins[i].skin_radius;
    clear_list(state, i);
    if (state.cells_per_side > 1) leave_cell(state, i);
    centre_skin(state, i, t);
    return before;
}

/// Gives disc i, whose skin was just recentred, its skin radius and its list. Discs that have no
/// skin radius are passed over: they find i when they build theirs. False if a list overflows.
static bool build_list(EngineState& state, std::uint32_t i, double t, double before,
                       const SkinRadiusRange& range) {
    Candidates candidates;
    if (!collect_candidates(state, i, candidates)) return false;
    double skin_radius = fair_skin_radius(candidates, before, range);
    std::uint32_t chosen[longest_list];
    for (;;) {
        std::uint32_t count = 0;
        bool room = true;
        for (std::uint32_t block = 0; block < candidates.padded && room; block += 8) {
            unsigned bits =
                lanes_closer(candidates.gap + block, candidates.reach + block, skin_radius);
            for (; bits != 0; bits &= bits - 1) {
                const std::uint32_t n = block + __builtin_ctz(bits);
                if (candidates.reach[n] == 0.0) continue;
                if (count == state.capacity || is_full(state, candidates.disc[n])) {
                    room = false;
                    break;
                }
                chosen[count++] = candidates.disc[n];
            }
        }
        if (room) {
            for (std::uint32_t k = 0; k < count; ++k) {
                add_neighbour(state, i, chosen[k]);
                add_neighbour(state, chosen[k], i);
            }
            break;
        }
        skin_radius *= 0.7;
        if (skin_radius < range.least) return false;
    }
    // Rounded down, so that the single-precision number is on the safe side.
    Skin& mine = state.skins[i];
    mine.skin_radius = static_cast<float>(skin_radius * (1.0 - 0x1p-22));
    note_far_from_wall(state, i, t);
    return true;
}

/// Makes room for the list of disc i, which overflowed: whoever's skin reaches it is recentred and
/// its list rebuilt. Writes the numbers of all discs whose lists have changed; returns how many, 0
/// if it is all of them.
static std::uint32_t resolve_overflow(EngineState& state, std::uint32_t i, double t,
                                      const SkinRadiusRange& range, std::uint32_t (&rebuilt)[256]) {
    constexpr std::uint32_t room = 256;
    rebuilt[0] = i;
    std::uint32_t count = 1;
    for (std::uint32_t next = 0; next < count; ++next) {
        const std::uint32_t k = rebuilt[next];
        // Who was recentred again after its list was built is among them twice.
        if (state.skins[k].skin_radius != 0.0f || build_list(state, k, t, 0.0, range)) continue;
        Candidates candidates;
        if (!collect_candidates(state, k, candidates)) return 0;
        for (std::uint32_t n = 0; n < candidates.count; ++n) {
            if (candidates.reach[n] == 0.0 ||
                candidates.gap[n] - candidates.reach[n] >= range.least)
                continue;
            if (count + 1 >= room) return 0;
            recentre_skin(state, candidates.disc[n], t);
            rebuilt[count++] = candidates.disc[n];
        }
        if (!build_list(state, k, t, 0.0, range)) return 0;
    }
    return count;
}

/// Everybody's list anew.
static void rebuild_all_lists(EngineState& state, double t, const SkinRadiusRange& range) {
    for (std::uint32_t c = 0; c < state.cells_per_side * state.cells_per_side; ++c)
        state.cell_heads[c] = state.size;
    for (std::uint32_t i = 0; i < state.size; ++i) {
        for (std::uint32_t slot = 0; slot < state.capacity; ++slot)
            state.cold(i).neighbours()[slot] = state.size;
        state.discs[i].neighbours = 0;
        centre_skin(state, i, t);
    }
    for (std::uint32_t i = 0; i < state.size; ++i) build_list(state, i, t, 0.0, range);
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
