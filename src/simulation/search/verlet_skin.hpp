// Who may meet whom. Each disc has a neighbourhood: a circle of radius h_i about a point X_i that
// is carried along with the mean motion of all discs. While every disc is within its own, only
// pairs with
//
//     |X_i − X_k| < r_i + r_k + h_i + h_k
//
// can touch, and these are on each other's lists. A disc about to leave its neighbourhood gets a
// new one where it stands. Lists change what is predicted, never what happens: a disc keeps the
// state it had, and a pair off the lists cannot meet.
//
// The skin adapts by itself: h_i is half the gap to the nearest disc but `wanted_neighbours`, so
// that a list fits in one vector. In a gas that is a long way, in the pack a short one; the dish
// has both at once. (Lists with a neighbourhood for each disc: Smallenburg 2022,
// doi:10.1140/epje/s10189-022-00180-8, with one skin for all.)
#pragma once

#include "swirl/math/lanes.hpp"
#include "swirl/physics/contact_time.hpp"
#include "swirl/simulation/search/state.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// Discs closer than twice a disc's freedom, at most. Others may add themselves to its list, up to
/// the capacity.
inline constexpr std::uint32_t wanted_neighbours = 7;
/// Rounding errors of positions are 10⁻¹³; this keeps them out of the argument above.
inline constexpr double freedom_margin = 1e-9;

/// Where the centre of the container is, on a straight leg.
SWIRL_INLINE Flight<double> container_flight(const Leg& leg) {
    return {leg.start, leg.velocity, leg.begin};
}

/// Lets the neighbourhoods be carried by the discs' mean velocity from time t on. The pack circles
/// in the dish with the swirl, so this is where most discs stay near; and in a large dish, where
/// the wall is far, they do not follow the container at all.
static void renew_carrier(Machine& m, const Vec2& at, double t) {
    Vec2 sum{0.0, 0.0};
    for (std::uint32_t i = 0; i < m.size; ++i) sum = sum + m.discs[i].velocity;
    m.carrier = {at, (1.0 / m.size) * sum, t};
}

/// How far from the centre of the container a disc may reach without touching the wall, with room
/// for the rounding of places to single precision.
SWIRL_INLINE double reach_short_of_wall(const Machine& m) {
    return m.container_radius * (1.0 - 1e-6);
}
/// How far from the centre of the container, at time t, a neighbourhood may reach so that its disc
/// cannot reach the wall before the leg ends: the neighbourhood drifts against the container.
SWIRL_INLINE double reach_far_from_wall(const Machine& m, double t) {
    const Leg& leg = m.legs[m.leg];
    if (leg.turning != 0.0) return 0.0;
    const Vec2 drift = (leg.end - t) * (m.carrier.velocity - leg.velocity);
    return reach_short_of_wall(m) - square_root(dot(drift, drift));
}

/// Negative if a neighbourhood whose centre is at s from that of the container does not reach so
/// far.
template <class Real>
SWIRL_INLINE Real beyond_reach(const Real& reach, const BasicVec2<Real>& s, const Real& freedom,
                               const Real& radius) {
    const Real room = larger(reach - freedom - radius, Real(0.0));
    return dot(s, s) - room * room;
}

static void note_far_from_wall(Machine& m, std::uint32_t i, double t) {
    const Neighbourhood& mine = m.neighbourhoods[i];
    const Vec2 centre = m.carrier.position_at(t) + Vec2{mine.X, mine.Y};
    const Vec2 s = centre - m.legs[m.leg].position_at(t);
    const double freedom = mine.freedom;
    m.discs[i].far_from_wall =
        beyond_reach(reach_far_from_wall(m, t), s, freedom, m.discs[i].radius) < 0.0;
}

SWIRL_INLINE std::uint32_t cell_row(const Machine& m, double x) {
    const double k = (x - m.cell_origin) * m.cells_per_length;
    if (!(k > 0.0)) return 0;
    const auto row = static_cast<std::uint32_t>(k);
    return row < m.cells_per_side ? row : m.cells_per_side - 1;
}
SWIRL_INLINE std::uint32_t& cell_head(const Machine& m, const Neighbourhood& at) {
    return m.cell_heads[cell_row(m, at.Y) * m.cells_per_side + cell_row(m, at.X)];
}
SWIRL_INLINE void enter_cell(Machine& m, std::uint32_t i) {
    std::uint32_t& head = cell_head(m, m.neighbourhoods[i]);
    m.neighbourhoods[i].next_in_cell = head;
    head = i;
}
SWIRL_INLINE void leave_cell(Machine& m, std::uint32_t i) {
    std::uint32_t* link = &cell_head(m, m.neighbourhoods[i]);
    while (*link != i) link = &m.neighbourhoods[*link].next_in_cell;
    *link = m.neighbourhoods[i].next_in_cell;
}

SWIRL_INLINE bool is_full(const Machine& m, std::uint32_t i) {
    return m.discs[i].neighbours == m.capacity;
}
SWIRL_INLINE void add_neighbour(Machine& m, std::uint32_t i, std::uint32_t k) {
    const std::uint32_t length = m.discs[i].neighbours;
    m.plan(i).neighbours()[length] = k;
    m.discs[i].neighbours = (length + 1) & 127u;
}
SWIRL_INLINE void remove_neighbour(Machine& m, std::uint32_t i, std::uint32_t k) {
    std::uint32_t* const list = m.plan(i).neighbours();
    const std::uint32_t last = m.discs[i].neighbours - 1;
    const std::uint32_t slot = place_in_list(list, m.capacity, k);
    list[slot] = list[last];
    list[last] = m.size;
    m.discs[i].neighbours = last & 127u;
}
SWIRL_INLINE void clear_list(Machine& m, std::uint32_t i) {
    std::uint32_t* const list = m.plan(i).neighbours();
    const std::uint32_t length = m.discs[i].neighbours;
    for (std::uint32_t slot = 0; slot < length; ++slot) {
        remove_neighbour(m, list[slot], i);
        list[slot] = m.size;
    }
    m.discs[i].neighbours = 0;
}

/// The discs around one of them: `gap` is |X_i − X_k| − r_i − r_k and `reach` is h_k. Both are
/// padded to a multiple of eight with discs that are infinitely far.
struct Surroundings {
    static constexpr std::uint32_t room = 512;
    alignas(64) double gap[room];
    alignas(64) double reach[room];
    float X[room], Y[room];
    std::uint32_t disc[room];
    std::uint32_t count, padded;
};

SWIRL_INLINE void add(const Machine& m, Surroundings& around, std::uint32_t k) {
    const Neighbourhood& other = m.neighbourhoods[k];
    around.disc[around.count] = k;
    around.X[around.count] = other.X;
    around.Y[around.count] = other.Y;
    around.reach[around.count] = other.freedom;
}

/// Collects every disc nearer than both freedoms may reach. False if there are too many to hold.
SWIRL_INLINE bool look_around(const Machine& m, std::uint32_t i, Surroundings& around) {
    const Neighbourhood& mine = m.neighbourhoods[i];
    around.count = 0;
    if (m.cells_per_side == 1) {
        if (m.size > Surroundings::room) return false;
        for (std::uint32_t k = 0; k < m.size; ++k, ++around.count) add(m, around, k);
        around.count = i;
        add(m, around, m.size - 1);  // the last one takes our place
        around.count = m.size - 1;
    } else {
        const std::uint32_t cx = cell_row(m, mine.X), cy = cell_row(m, mine.Y);
        const std::uint32_t last = m.cells_per_side - 1;
        for (std::uint32_t y = cy - (cy > 0); y <= cy + (cy < last); ++y)
            for (std::uint32_t x = cx - (cx > 0); x <= cx + (cx < last); ++x)
                for (std::uint32_t k = m.cell_heads[y * m.cells_per_side + x]; k != m.size;
                     k = m.neighbourhoods[k].next_in_cell) {
                    if (around.count == Surroundings::room) return false;
                    add(m, around, k);
                    around.count += k != i;
                }
    }
    around.padded = (around.count + 7u) & ~7u;
    const double X = mine.X, Y = mine.Y, radii = m.discs[i].radius + m.smallest_radius;
    for (std::uint32_t n = 0; n < around.padded; ++n) {
        const double dx = static_cast<double>(around.X[n]) - X;
        const double dy = static_cast<double>(around.Y[n]) - Y;
        around.gap[n] = square_root(dx * dx + dy * dy) - radii;
    }
    // Where all are alike, nobody's disc is looked at: in a large dish each is far away in memory.
    if (!m.equal_radii)
        for (std::uint32_t n = 0; n < around.count; ++n)
            around.gap[n] -= m.discs[around.disc[n]].radius - m.smallest_radius;
    for (std::uint32_t n = around.count; n < around.padded; ++n) {
        around.gap[n] = never;
        around.reach[n] = 0.0;
        around.disc[n] = m.size;
    }
    return true;
}

/// The bounds of h_i; below `least` there is no room for a disc on the lists of those around it.
struct FreedomRange {
    double least, longest;
};

/// Half the gap to the nearest disc that is to stay off the list, to a fifth: if everybody does the
/// same, no one's freedom is at the cost of the others'. Starts from the freedom the disc had.
SWIRL_INLINE double fair_freedom(const Surroundings& around, double before,
                                 const FreedomRange& range) {
    if (around.count <= wanted_neighbours) return range.longest;
    const auto too_many = [&](double freedom) {
        return count_below(around.gap, around.padded, 2.0 * freedom) > wanted_neighbours;
    };
    double freedom = smaller(larger(before, 2.0 * range.least), range.longest);
    if (too_many(freedom)) {
        do freedom *= 0.8;
        while (freedom > range.least && too_many(freedom));
        return larger(freedom, range.least);
    }
    while (freedom < range.longest && !too_many(1.25 * freedom)) freedom *= 1.25;
    return smaller(freedom, range.longest);
}

/// Sets X_i where the disc stands at time t, with no freedom yet.
static void stand(Machine& m, std::uint32_t i, double t) {
    const HotDisc& disc = m.discs[i];
    const Vec2 at = Flight<double>{disc.position, disc.velocity, disc.time}.position_at(t) -
                    m.carrier.position_at(t);
    m.neighbourhoods[i] = {static_cast<float>(at.x), static_cast<float>(at.y), 0.0f, {m.size}};
    if (m.cells_per_side > 1) enter_cell(m, i);
}

/// Takes disc i off all lists and lets it stand where it is now. Returns the freedom it had.
static double settle(Machine& m, std::uint32_t i, double t) {
    const double before = m.neighbourhoods[i].freedom;
    clear_list(m, i);
    if (m.cells_per_side > 1) leave_cell(m, i);
    stand(m, i, t);
    return before;
}

/// Gives disc i, which has just settled, its freedom and its list. Discs without freedom are passed
/// over: they find i when they claim theirs. False if there is no room.
static bool claim(Machine& m, std::uint32_t i, double t, double before, const FreedomRange& range) {
    Surroundings around;
    if (!look_around(m, i, around)) return false;
    double freedom = fair_freedom(around, before, range);
    std::uint32_t chosen[longest_list];
    for (;;) {
        std::uint32_t count = 0;
        bool room = true;
        for (std::uint32_t block = 0; block < around.padded && room; block += 8) {
            unsigned bits = lanes_closer(around.gap + block, around.reach + block, freedom);
            for (; bits != 0; bits &= bits - 1) {
                const std::uint32_t n = block + __builtin_ctz(bits);
                if (around.reach[n] == 0.0) continue;
                if (count == m.capacity || is_full(m, around.disc[n])) {
                    room = false;
                    break;
                }
                chosen[count++] = around.disc[n];
            }
        }
        if (room) {
            for (std::uint32_t k = 0; k < count; ++k) {
                add_neighbour(m, i, chosen[k]);
                add_neighbour(m, chosen[k], i);
            }
            break;
        }
        freedom *= 0.7;
        if (freedom < range.least) return false;
    }
    // Rounded down, so that the single-precision number is on the safe side.
    Neighbourhood& mine = m.neighbourhoods[i];
    mine.freedom = static_cast<float>(freedom * (1.0 - 0x1p-22));
    note_far_from_wall(m, i, t);
    return true;
}

/// Makes room for disc i, which could not claim any freedom: whoever reaches it is settled anew.
/// Writes the numbers of all discs whose lists have changed; returns how many, 0 if it is all of
/// them.
static std::uint32_t make_room(Machine& m, std::uint32_t i, double t, const FreedomRange& range,
                               std::uint32_t (&settled)[256]) {
    constexpr std::uint32_t room = 256;
    settled[0] = i;
    std::uint32_t count = 1;
    for (std::uint32_t next = 0; next < count; ++next) {
        const std::uint32_t k = settled[next];
        // Who has claimed and was settled again stands on the list twice.
        if (m.neighbourhoods[k].freedom != 0.0f || claim(m, k, t, 0.0, range)) continue;
        Surroundings around;
        if (!look_around(m, k, around)) return 0;
        for (std::uint32_t n = 0; n < around.count; ++n) {
            if (around.reach[n] == 0.0 || around.gap[n] - around.reach[n] >= range.least) continue;
            if (count + 1 >= room) return 0;
            settle(m, around.disc[n], t);
            settled[count++] = around.disc[n];
        }
        if (!claim(m, k, t, 0.0, range)) return 0;
    }
    return count;
}

/// Everybody's neighbourhood anew.
static void make_all_neighbourhoods(Machine& m, double t, const FreedomRange& range) {
    for (std::uint32_t c = 0; c < m.cells_per_side * m.cells_per_side; ++c)
        m.cell_heads[c] = m.size;
    for (std::uint32_t i = 0; i < m.size; ++i) {
        for (std::uint32_t slot = 0; slot < m.capacity; ++slot)
            m.plan(i).neighbours()[slot] = m.size;
        m.discs[i].neighbours = 0;
        stand(m, i, t);
    }
    for (std::uint32_t i = 0; i < m.size; ++i) claim(m, i, t, 0.0, range);
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
