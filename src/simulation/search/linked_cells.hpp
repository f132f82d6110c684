// Whom a disc may meet: those in its cell and in the eight around it. For a thin gas, where a disc
// flies through any neighbourhood in a collision or two and its list would not be worth its making.
//
// The cells are squares at rest in the frame of the container, wider than two discs, so that discs
// in cells that do not touch cannot meet; and so narrow that no more discs than a cell has room for
// can have their centres in one: eight points in a square of side 1 are at most (√6 − √2)/2 apart
// (Schaer and Meir 1965, Canad. Math. Bull. 8, 21), so eight discs need a side of 3.86 radii.
// A disc that reaches the edge of its cell enters the next, and what it may meet is looked up anew.
//
// Included by one file per vector width, like event_loop.hpp, and under the same rule.
#pragma once

#include <cstring>

#include "swirl/math/lanes.hpp"
#include "swirl/physics/contact_time.hpp"
#include "swirl/simulation/resolve.hpp"
#include "swirl/simulation/search/prediction.hpp"
#include "swirl/simulation/search/state.hpp"
#include "swirl/simulation/search/tournament.hpp"
#include "swirl/simulation/search/verlet_skin.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {
namespace cells {

/// The discs of nine cells, the one that asks among them: it never meets itself. After the last
/// come eight times nobody.
struct Around {
    std::uint32_t count;
    std::uint32_t disc[9 * Cell::room + 8];
};

SWIRL_INLINE void look_around(const Machine& m, std::uint32_t i, Around& around) {
    const Cell* row = m.cells + m.neighbourhoods[i].cell - m.cells_per_side - 1;
    std::uint32_t count = 0;
    for (int y = 0; y < 3; ++y, row += m.cells_per_side) {
        for (int x = 0; x < 3; ++x) {
            // The whole cell, so that nothing depends on how many there are but the place of the
            // next.
            std::memcpy(around.disc + count, &row[x], sizeof(Cell));
            count += row[x].count;
        }
    }
    for (int k = 0; k < 8; ++k) around.disc[count + k] = m.size;
    around.count = count;
}

/// When disc i, asked at time t, is at an edge of its cell, and at which. Never at once, so that
/// who stands on an edge and flies along it is not told for ever to cross it.
SWIRL_INLINE Leaving leaving_times(const Machine& m, std::uint32_t i, double t) {
    const HotDisc& disc = m.discs[i];
    const Neighbourhood& mine = m.neighbourhoods[i];
    const Vec2 offset =
        flight_of(disc).position_at(t) - m.carrier.position_at(t) - Vec2{mine.X, mine.Y};
    const Vec2 v = disc.velocity - m.carrier.velocity;
    const Lanes<2> speed = two_lanes(v.x, v.y), from = two_lanes(offset.x, offset.y);
    const Lanes<2> zero(0.0), half(0.5 / m.cells_per_length);
    const Lanes<2> way = select(speed > zero, half - from, half + from);
    // At rest in one direction, whatever the sign of its zero: never.
    const Lanes<2> rate = larger(select(speed > zero, speed, -speed), zero);
    const Lanes<2> wait = larger(way, Lanes<2>(1e-9) * half) / rate;
    const double x = lane(wait, 0), y = lane(wait, 1);
    const std::uint32_t across = v.x > 0.0 ? 0 : 1, up = v.y > 0.0 ? 2 : 3;
    const double wall = disc.far_from_wall
                            ? never
                            : time_of_wall_contact(flight_of(disc), container_flight(m.legs[m.leg]),
                                                   m.container_radius - disc.radius);
    return {wall, t + smaller(x, y), leaves_place + (x < y ? across : up)};
}

/// Everything that may happen to disc i, which may have held its state for a while.
SWIRL_INLINE void predict(Machine& m, std::uint32_t i, double t) {
    Around around;
    look_around(m, i, around);
    Prediction soonest{never, leaves_place};
    for (std::uint32_t k = 0; k < around.count; k += 8)
        soonest = earliest_contact<8>(m, m.discs[i], around.disc + k, soonest);
    write_card(m, i, soonest, leaving_times(m, i, t));
}

/// The same for D discs that have just changed, at time t.
template <int D>
SWIRL_INLINE void predict_changed(Machine& m, const std::uint32_t (&who)[D], double t) {
    Around around[D];
    Lanes<8> contacts[D];
    for (int d = 0; d < D; ++d) look_around(m, who[d], around[d]);
    for (int d = 0; d < D; ++d)
        contacts[d] = contacts_from_now(m.discs[who[d]], load_others<8>(m, around[d].disc), t);
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        Prediction soonest = earlier<8>(around[d].disc, contacts[d], {never, leaves_place});
        for (std::uint32_t k = 8; k < around[d].count; k += 8) {
            const std::uint32_t* const next = around[d].disc + k;
            soonest = earlier<8>(
                next, contacts_from_now(m.discs[who[d]], load_others<8>(m, next), t), soonest);
        }
        write_card(m, who[d], soonest, leaving_times(m, who[d], t));
    }
}

SWIRL_INLINE void leave(Machine& m, std::uint32_t i) {
    Cell& cell = m.cells[m.neighbourhoods[i].cell];
    // Of the cell's eight numbers the last is how many there are, but i stands before it.
    const std::uint32_t slot = place_in_list(cell.disc, 8, i);
    cell.disc[slot] = cell.disc[--cell.count];
}

static void enter(Machine& m, std::uint32_t i, std::uint32_t number) {
    Cell& cell = m.cells[number];
    if (cell.count == Cell::room) {  // geometry forbids it, see above, unless discs overlap
        m.discs_overlap = true;
        return;
    }
    cell.disc[cell.count++] = i;
    const double width = 1.0 / m.cells_per_length;
    const auto centre = [&](std::uint32_t row) {
        return static_cast<float>(m.cell_origin + (row + 0.5) * width);
    };
    Neighbourhood& place = m.neighbourhoods[i];
    place = {centre(number % m.cells_per_side),
             centre(number / m.cells_per_side),
             static_cast<float>(0.71 * width),
             {number}};
    HotDisc& disc = m.discs[i];
    disc.far_from_wall = beyond_reach<double>(reach_short_of_wall(m), {place.X, place.Y},
                                              place.freedom, disc.radius) < 0.0;
}

/// Disc i has come to an edge and enters the cell beyond.
[[gnu::noinline]] static void renew_place(Machine& m, std::uint32_t i, double t) {
    ++m.relists;
    const std::uint32_t side = m.cells_per_side;
    const std::uint32_t step[4] = {1u, 0u - 1u, side, 0u - side};
    const std::uint32_t to = m.neighbourhoods[i].cell + step[m.plan(i).partner - leaves_place];
    leave(m, i);
    enter(m, i, to);
    predict(m, i, t);
}

/// Whether disc i lies deeper in another than rounding errors explain.
static bool overlaps(const Machine& m, std::uint32_t i) {
    Around around;
    look_around(m, i, around);
    const HotDisc& disc = m.discs[i];
    for (std::uint32_t n = 0; n < around.count; ++n) {
        const HotDisc& other = m.discs[around.disc[n]];
        const Vec2 s = flight_of(other).position_at(m.clock) - flight_of(disc).position_at(m.clock);
        const double contact = disc.radius + other.radius;
        if (around.disc[n] != i && dot(s, s) < contact * contact * (1.0 - 1e-9)) return true;
    }
    return false;
}

static void predict_all(Machine& m, double t) {
    empty_queue(m);
    for (std::uint32_t i = 0; i < m.size; ++i) predict(m, i, t);
}

static void start(Machine& m) {
    m.carrier = container_flight(m.legs[m.leg]);
    for (std::uint32_t c = 0; c < m.cells_per_side * m.cells_per_side; ++c) m.cells[c].count = 0;
    for (std::uint32_t i = 0; i < m.size; ++i) {
        const Vec2 at = flight_of(m.discs[i]).position_at(m.clock) - m.carrier.position_at(m.clock);
        enter(m, i, cell_row(m, at.y) * m.cells_per_side + cell_row(m, at.x));
    }
    for (std::uint32_t i = 0; i < m.size && !m.discs_overlap; ++i) m.discs_overlap = overlaps(m, i);
    if (!m.discs_overlap) predict_all(m, m.clock);
}

/// The container, and the cells with it, take another course.
static Event end_leg(Machine& m) {
    const Event event = take_next_leg(m);
    m.carrier = container_flight(m.legs[m.leg]);
    predict_all(m, m.clock);
    return event;
}

}  // namespace cells

/// For event_loop.hpp.
struct Cells {
    SWIRL_INLINE static Event end_leg(Machine& m) { return cells::end_leg(m); }
    SWIRL_INLINE static void predict(Machine& m, std::uint32_t i, double t) {
        cells::predict(m, i, t);
    }
    template <int D>
    SWIRL_INLINE static void predict_changed(Machine& m, const std::uint32_t (&who)[D], double t) {
        cells::predict_changed<D>(m, who, t);
    }
    SWIRL_INLINE static void renew_place(Machine& m, std::uint32_t i, double t) {
        cells::renew_place(m, i, t);
    }
};

}  // namespace SWIRL_TARGET
}  // namespace swirl
