// Who may meet whom. Each disc has a neighbourhood: a circle of radius h_i about a point X_i that
// is carried along by the container (on a turning leg, that stands still). While every disc is
// within its own, only pairs with
//
//     |X_i − X_k| < r_i + r_k + h_i + h_k
//
// can touch, and these are on each other's lists. A disc about to leave its neighbourhood gets a
// new one where it stands. Lists change what is predicted, never what happens: a disc keeps the
// state it had, and a pair off the lists cannot meet.
//
// The skin adapts by itself: h_i is half the gap to the ninth nearest disc, so that a list holds
// about eight, one vector. In a gas that is a long way, in the pack a short one; the dish has both
// at once.
// (Lists in this form: Smallenburg 2022, doi:10.1140/epje/s10189-022-00180-8, with one skin.)
#pragma once

#include "physics/contact_time.hpp"
#include "simulation/machine.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// Neighbours a disc asks for; others may add themselves up to the capacity of its list.
inline constexpr std::uint32_t wanted_neighbours = 8;
/// Rounding errors of positions are 10⁻¹³; this keeps them out of the argument above.
inline constexpr double freedom_margin = 1e-9;

/// Where the neighbourhoods are carried: with the container on a straight leg.
SWIRL_INLINE Flight<double> carried_frame(const Leg& leg) {
    if (leg.turning != 0.0) return {{0.0, 0.0}, {0.0, 0.0}, leg.begin};
    return {leg.start, leg.velocity, leg.begin};
}

SWIRL_INLINE std::uint32_t cell_row(const Machine& m, double x) {
    const double k = (x - m.cell_origin) / m.cell_width;
    if (!(k > 0.0)) return 0;
    const auto row = static_cast<std::uint32_t>(k);
    return row < m.cells_per_side ? row : m.cells_per_side - 1;
}
SWIRL_INLINE std::uint32_t& cell_head(const Machine& m, float X, float Y) {
    return m.cell_heads[cell_row(m, Y) * m.cells_per_side + cell_row(m, X)];
}

SWIRL_INLINE void enter_cell(Machine& m, std::uint32_t i) {
    std::uint32_t& head = cell_head(m, m.plan(i).X, m.plan(i).Y);
    m.rest[i].next_in_cell = head;
    head = i;
}
SWIRL_INLINE void leave_cell(Machine& m, std::uint32_t i) {
    std::uint32_t* link = &cell_head(m, m.plan(i).X, m.plan(i).Y);
    while (*link != i) link = &m.rest[*link].next_in_cell;
    *link = m.rest[i].next_in_cell;
}

/// False if the list is full.
SWIRL_INLINE bool add_neighbour(Machine& m, std::uint32_t i, std::uint32_t k) {
    std::uint32_t* const list = m.plan(i).neighbours();
    for (std::uint32_t slot = 0; slot < m.capacity; ++slot) {
        if (list[slot] != m.size) continue;
        list[slot] = k;
        return true;
    }
    return false;
}
SWIRL_INLINE void remove_neighbour(Machine& m, std::uint32_t i, std::uint32_t k) {
    std::uint32_t* const list = m.plan(i).neighbours();
    std::uint32_t last = 0, found = 0;
    for (std::uint32_t slot = 0; slot < m.capacity && list[slot] != m.size; ++slot) {
        if (list[slot] == k) found = slot;
        last = slot;
    }
    list[found] = list[last];
    list[last] = m.size;
}
SWIRL_INLINE bool is_full(const Machine& m, std::uint32_t i) {
    return m.plan(i).neighbours()[m.capacity - 1] != m.size;
}

SWIRL_INLINE void clear_list(Machine& m, std::uint32_t i) {
    std::uint32_t* const list = m.plan(i).neighbours();
    for (std::uint32_t slot = 0; slot < m.capacity && list[slot] != m.size; ++slot) {
        remove_neighbour(m, list[slot], i);
        list[slot] = m.size;
    }
}

/// Calls visit(k, |X_i − X_k| − r_i − r_k) for every disc k that may be closer than the longest
/// freedom on both sides.
template <class Visit>
SWIRL_INLINE void for_each_near(const Machine& m, std::uint32_t i, Visit visit) {
    const Plan& plan = m.plan(i);
    const double radius = m.discs[i].radius;
    const auto consider = [&](std::uint32_t k) {
        if (k == i) return;
        const double dx = static_cast<double>(plan.X) - static_cast<double>(m.plan(k).X);
        const double dy = static_cast<double>(plan.Y) - static_cast<double>(m.plan(k).Y);
        visit(k, square_root(dx * dx + dy * dy) - (radius + m.discs[k].radius));
    };
    if (m.cells_per_side == 1) {
        for (std::uint32_t k = 0; k < m.size; ++k) consider(k);
        return;
    }
    const std::uint32_t cx = cell_row(m, plan.X), cy = cell_row(m, plan.Y);
    const std::uint32_t last = m.cells_per_side - 1;
    for (std::uint32_t y = cy - (cy > 0); y <= cy + (cy < last); ++y)
        for (std::uint32_t x = cx - (cx > 0); x <= cx + (cx < last); ++x)
            for (std::uint32_t k = m.cell_heads[y * m.cells_per_side + x]; k != m.size;
                 k = m.rest[k].next_in_cell)
                consider(k);
}

/// Half the gap to the nearest disc that is to stay off the list: if everybody does the same, no
/// one's freedom is at the cost of the others'.
SWIRL_INLINE double fair_freedom(const Machine& m, std::uint32_t i, double longest) {
    double nearest[wanted_neighbours + 1];
    std::uint32_t count = 0;
    for_each_near(m, i, [&](std::uint32_t, double gap) {
        if (count > wanted_neighbours && gap >= nearest[wanted_neighbours]) return;
        std::uint32_t place = count > wanted_neighbours ? wanted_neighbours : count++;
        for (; place > 0 && nearest[place - 1] > gap; --place) nearest[place] = nearest[place - 1];
        nearest[place] = gap;
    });
    if (count <= wanted_neighbours) return longest;
    return smaller(longest, 0.5 * nearest[wanted_neighbours]);
}

/// A disc k that must be on i's list if h_i exceeds `need` = |X_i − X_k| − r_i − r_k − h_k.
struct Candidate {
    double need;
    std::uint32_t disc;
};
inline constexpr std::uint32_t longest_list = 64;

/// The bounds of h_i; below `least` there is no room for a disc on the lists of those around it.
struct FreedomRange {
    double least, longest;
};

/// Sets X_i where the disc stands at time t, with no freedom yet and an empty list.
static void settle(Machine& m, std::uint32_t i, double t) {
    clear_list(m, i);
    if (m.cells_per_side > 1) leave_cell(m, i);
    const HotDisc& disc = m.discs[i];
    const Vec2 at = Flight<double>{disc.position, disc.velocity, disc.time}.position_at(t) -
                    carried_frame(m.legs[m.leg]).position_at(t);
    m.plan(i).X = static_cast<float>(at.x);
    m.plan(i).Y = static_cast<float>(at.y);
    m.rest[i].freedom = 0.0f;
    if (m.cells_per_side > 1) enter_cell(m, i);
}

/// Gives disc i, which has just settled, its freedom and its list. Discs without freedom are passed
/// over: they find i when they claim theirs. False if there is no room.
static bool claim(Machine& m, std::uint32_t i, const FreedomRange& range) {
    double freedom = fair_freedom(m, i, range.longest);
    Candidate candidates[longest_list + 1];  // sorted by need
    std::uint32_t count = 0;
    for_each_near(m, i, [&](std::uint32_t k, double gap) {
        const double other = m.rest[k].freedom;
        const double need = gap - other;
        if (need >= freedom || other == 0.0) return;
        if (is_full(m, k)) {
            freedom = need;
            return;
        }
        std::uint32_t place = count++;
        for (; place > 0 && candidates[place - 1].need > need; --place)
            candidates[place] = candidates[place - 1];
        candidates[place] = {need, k};
        if (count > m.capacity) freedom = smaller(freedom, candidates[--count].need);
    });
    if (freedom < range.least) return false;

    // Rounded down, so that the single-precision number is on the safe side.
    m.rest[i].freedom = static_cast<float>(freedom * (1.0 - 0x1p-22));
    for (std::uint32_t k = 0; k < count && candidates[k].need < freedom; ++k) {
        add_neighbour(m, i, candidates[k].disc);
        add_neighbour(m, candidates[k].disc, i);
    }
    HotDisc& disc = m.discs[i];
    const double X = m.plan(i).X, Y = m.plan(i).Y;
    const double outermost = square_root(X * X + Y * Y) + freedom + disc.radius;
    const bool far = m.legs[m.leg].turning == 0.0 && outermost < m.container_radius * (1.0 - 1e-6);
    disc.kind = far ? disc.kind | far_from_wall : disc.kind & ~far_from_wall;
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
        if (m.rest[k].freedom != 0.0f || claim(m, k, range)) continue;
        std::uint32_t reaching[room];
        std::uint32_t found = 0;
        for_each_near(m, k, [&](std::uint32_t other, double gap) {
            const double freedom = m.rest[other].freedom;
            if (freedom > 0.0 && gap - freedom < range.least && found < room)
                reaching[found++] = other;
        });
        if (count + found + 1 > room) return 0;
        for (std::uint32_t r = 0; r < found; ++r) {
            settle(m, reaching[r], t);
            settled[count++] = reaching[r];
        }
        if (!claim(m, k, range)) return 0;
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
        m.plan(i).X = m.plan(i).Y = 0.0f;
        if (m.cells_per_side > 1) enter_cell(m, i);
    }
    for (std::uint32_t i = 0; i < m.size; ++i) settle(m, i, t);
    for (std::uint32_t i = 0; i < m.size; ++i) claim(m, i, range);
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
