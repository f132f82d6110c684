// Speed only, changes no bit: the search through linked cells. A disc may meet those in its cell
// and in the eight around it. For a thin gas, where a disc flies through any skin in a collision or
// two and its list would not be worth its making.
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
#include "swirl/simulation/pending_event.hpp"
#include "swirl/simulation/search/prediction.hpp"
#include "swirl/simulation/search/state.hpp"
#include "swirl/simulation/search/state_checks.hpp"
#include "swirl/simulation/search/tournament.hpp"
#include "swirl/simulation/search/verlet_skin.hpp"
#include "swirl/simulation/search/wall_times.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {
namespace cells {

/// The discs of nine cells, the one that asks among them: it never meets itself. After the last
/// come eight times nobody.
struct Candidates {
    std::uint32_t count;
    std::uint32_t disc[9 * Cell::room + 8];
};

SWIRL_INLINE void collect_candidates(const EngineState& state, std::uint32_t i,
                                     Candidates& candidates) {
    const Cell* row = state.cells + state.skins[i].cell - state.grids[0].cells_per_side - 1;
    std::uint32_t count = 0;
    for (int y = 0; y < 3; ++y, row += state.grids[0].cells_per_side) {
        for (int x = 0; x < 3; ++x) {
            // The whole cell, so that nothing depends on how many there are but the place of the
            // next.
            std::memcpy(candidates.disc + count, &row[x], sizeof(Cell));
            count += row[x].count;
        }
    }
    for (int k = 0; k < 8; ++k) candidates.disc[count + k] = state.size;
    candidates.count = count;
}

/// When disc i, asked at time t, is at an edge of its cell, and at which. Never at once, so that
/// who stands on an edge and flies along it is not told for ever to cross it.
SWIRL_INLINE Leaving leaving_times(const EngineState& state, std::uint32_t i, double t) {
    const HotDisc& disc = state.discs[i];
    const Skin& mine = state.skins[i];
    const Flight<double>& frame = state.comoving_frame.origin;
    const Vec2 offset = disc.flight().position_at(t) - frame.position_at(t) - Vec2{mine.X, mine.Y};
    const Vec2 v = disc.velocity - frame.velocity;
    const Lanes<2> speed = two_lanes(v.x, v.y), from = two_lanes(offset.x, offset.y);
    const Lanes<2> zero(0.0), half(0.5 / state.grids[0].cells_per_length);
    const Lanes<2> way = select(speed > zero, half - from, half + from);
    // At rest in one direction, whatever the sign of its zero: never.
    const Lanes<2> rate = larger(select(speed > zero, speed, -speed), zero);
    const Lanes<2> wait = larger(way, Lanes<2>(1e-9) * half) / rate;
    const double x = lane(wait, 0), y = lane(wait, 1);
    const std::uint32_t across = v.x > 0.0 ? 0 : 1, up = v.y > 0.0 ? 2 : 3;
    return {disc.far_from_wall ? never : wall_time(state, i), t + smaller(x, y),
            leaves_skin + (x < y ? across : up)};
}

/// Everything that may happen to D discs, asked at time t.
template <Held held, int D>
[[gnu::noinline]] static void predict(EngineState& state, const std::uint32_t (&who)[D], double t) {
    Candidates candidates[D];
    Lanes<8> contacts[D];
    for (int d = 0; d < D; ++d) collect_candidates(state, who[d], candidates[d]);
    for (int d = 0; d < D; ++d)
        contacts[d] =
            contact_times<held>(state.discs[who[d]], load_others<8>(state, candidates[d].disc), t);
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        PendingEvent meeting = earlier<8>(candidates[d].disc, contacts[d], no_meeting(who[d]));
        for (std::uint32_t k = 8; k < candidates[d].count; k += 8) {
            const std::uint32_t* const more = candidates[d].disc + k;
            const Others<8> others = load_others<8>(state, more);
            meeting =
                earlier<8>(more, contact_times<held>(state.discs[who[d]], others, t), meeting);
        }
        put_in(state, first_of(meeting, leaving_times(state, who[d], t)));
    }
}

SWIRL_INLINE void leave(EngineState& state, std::uint32_t i) {
    Cell& cell = state.cells[state.skins[i].cell];
    // Of the cell's eight numbers the last is how many there are, but i stands before it.
    const std::uint32_t slot = place_in_list(cell.disc, 8, i);
    cell.disc[slot] = cell.disc[--cell.count];
}

static void enter(EngineState& state, std::uint32_t i, std::uint32_t number) {
    Cell& cell = state.cells[number];
    if (cell.count == Cell::room) {  // geometry forbids it, see above, unless discs overlap
        state.discs_overlap = true;
        return;
    }
    cell.disc[cell.count++] = i;
    const std::uint32_t side = state.grids[0].cells_per_side;
    const double width = 1.0 / state.grids[0].cells_per_length;
    const auto centre = [&](std::uint32_t row) {
        return static_cast<float>(state.cell_origin + (row + 0.5) * width);
    };
    Skin& place = state.skins[i];
    place = {
        centre(number % side), centre(number / side), static_cast<float>(0.71 * width), {number}};
    HotDisc& disc = state.discs[i];
    disc.far_from_wall = beyond_reach<double>(reach_short_of_wall(state), {place.X, place.Y},
                                              place.skin_radius, disc.radius) < 0.0;
}

/// Disc i has come to an edge and enters the cell beyond.
[[gnu::noinline]] static void enter_next_cell(EngineState& state, std::uint32_t i, double t) {
    ++state.list_rebuilds;
    const std::uint32_t side = state.grids[0].cells_per_side;
    const std::uint32_t step[4] = {1u, 0u - 1u, side, 0u - side};
    const std::uint32_t to = state.skins[i].cell + step[state.cold(i).partner - leaves_skin];
    leave(state, i);
    enter(state, i, to);
    predict<Held::for_a_while, 1>(state, {i}, t);
}

/// Whether disc i lies deeper in another than rounding errors explain.
static bool overlaps(const EngineState& state, std::uint32_t i) {
    Candidates candidates;
    collect_candidates(state, i, candidates);
    const HotDisc& disc = state.discs[i];
    for (std::uint32_t n = 0; n < candidates.count; ++n) {
        const HotDisc& other = state.discs[candidates.disc[n]];
        const Vec2 s =
            other.flight().position_at(state.clock) - disc.flight().position_at(state.clock);
        const double contact = disc.radius + other.radius;
        if (candidates.disc[n] != i && dot(s, s) < contact * contact * (1.0 - 1e-9)) return true;
    }
    return false;
}

static void predict_all(EngineState& state, double t) {
    empty_queue(state);
    for (std::uint32_t i = 0; i < state.size; ++i) {
        if (state.stops_at(i)) return;
        predict<Held::for_a_while, 1>(state, {i}, t);
    }
}

SWIRL_INLINE void rest_with_container(EngineState& state) {
    state.comoving_frame = {.origin = container_flight(state.legs[state.leg])};
}

static void start(EngineState& state) {
    rest_with_container(state);
    const Grid& grid = state.grids[0];
    for (std::uint32_t c = 0; c < grid.cells_per_side * grid.cells_per_side; ++c)
        state.cells[c].count = 0;
    for (std::uint32_t i = 0; i < state.size; ++i) {
        if (state.stops_at(i)) return;
        const Vec2 at = state.discs[i].flight().position_at(state.clock) -
                        state.comoving_frame.origin.position_at(state.clock);
        enter(state, i, cell_number(state, grid, at.x, at.y));
    }
    for (std::uint32_t i = 0; i < state.size && !state.discs_overlap; ++i) {
        if (state.stops_at(i)) return;
        state.discs_overlap = overlaps(state, i);
    }
    if (!state.discs_overlap) predict_all(state, state.clock);
}

/// The container, and the cells with it, take another course.
SWIRL_INLINE void leg_ended(EngineState& state) {
    rest_with_container(state);
    predict_all(state, state.clock);
}

}  // namespace cells

struct LinkedCells {
    SWIRL_INLINE static void start(EngineState& state) { cells::start(state); }
    SWIRL_INLINE static PendingEvent next(const EngineState& state) { return next_pending(state); }
    SWIRL_INLINE static void predict_again(EngineState& state, const PendingEvent& event) {
        swirl::take_out(state, event.disc);
        if (event.partner >= leaves_skin) {
            cells::enter_next_cell(state, event.disc, event.time);
        } else {
            ++state.invalidated;
            cells::predict<Held::for_a_while, 1>(state, {event.disc}, event.time);
        }
    }
    SWIRL_INLINE static PendingEvent take_out(EngineState& state, const PendingEvent& event) {
        return take_first<LinkedCells>(state, event);
    }
    template <int D>
    SWIRL_INLINE static void predict_changed(EngineState& state, const std::uint32_t (&who)[D],
                                             double t) {
        cells::predict<Held::since_now, D>(state, who, t);
    }
    SWIRL_INLINE static void check(const EngineState& state, double t) {
        check_cells(state, t);
        check_tournament(state);
    }
    SWIRL_INLINE static void leg_ended(EngineState& state, double) { cells::leg_ended(state); }
};

}  // namespace SWIRL_TARGET
}  // namespace swirl
