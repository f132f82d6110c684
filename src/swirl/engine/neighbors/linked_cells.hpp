// Speed only; results stay bitwise identical. The search with linked cells: a disc can only collide
// with the discs in its own cell and in the eight cells around it. It is for dilute systems, where
// a disc would leave any skin after a collision or two, so its neighbour list would not be worth
// building.
//
// The cells are squares, wider than the largest disc's diameter, so discs in cells that do not
// touch cannot collide. They are wide enough that discs cross few edges between collisions, and
// narrow enough that a prediction takes one vector. A disc that reaches the edge of its cell enters
// the next one, and its contacts are predicted again. Through a period the cells move with the mean
// velocity that the discs had at its beginning; if that is small against their other motion, the
// cells rest. The container moves over the cells. A path vertex only affects discs in cells that
// the wall reaches.
//
// A cell has capacity for seven discs. The eighth is unassigned: all discs test for a contact with
// it until it enters another cell. Where discs gather, many become unassigned, and narrower cells
// take over. With equal discs no cell overflows if it is narrower than 3.86 radii: eight points in
// a unit square are at most (√6 − √2)/2 apart (Schaer and Meir 1965, Canad. Math. Bull. 8, 21). In
// a cluster cells for little more than one disc are fastest.
//
// With unequal discs, the largest sets the lower limit of the cell width. Where cells hold many
// small discs at rest, each cell has an overflow bucket.
#pragma once

#include <cstring>

#include "swirl/engine/neighbors/engine_state_checks.hpp"
#include "swirl/engine/neighbors/event_queue.hpp"
#include "swirl/engine/neighbors/lists_or_cells.hpp"
#include "swirl/engine/neighbors/neighbor_search.hpp"
#include "swirl/engine/neighbors/prediction.hpp"
#include "swirl/engine/neighbors/renewed_leaving.hpp"
#include "swirl/engine/neighbors/search_states.hpp"
#include "swirl/engine/neighbors/wall_times.hpp"
#include "swirl/engine/pending_event.hpp"
#include "swirl/engine/resolve.hpp"
#include "swirl/math/lanes.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {
namespace cells {

/// With more unassigned discs, narrower cells are faster. Every eight of them cost each prediction
/// one more vector.
inline constexpr std::uint32_t max_unassigned = 16;

/// Asks for cells wider by `factor`. If the reason is that cells overflow, cells may never be wider
/// than that again; and if these are the narrowest already, lists take over, for good.
SWIRL_INLINE void request_width(LinkedCellsState& state, double factor, bool cells_overflow) {
    state.should_switch_search = true;
    const double before = state.grid.width();
    const double target = smaller(larger(factor * before, state.min_width), state.max_cell_width);
    const bool is_narrowest = before < 1.0001 * state.min_width;
    if (cells_overflow) state.max_cell_width = target;
    state.target_cell_width = target;
    if (!cells_overflow || !is_narrowest) return;
    state.target_cell_width = 0.0;
    state.chooses_search = false;
}

/// Entering a cell takes as long as testing this many candidates for a contact. With cells wider by
/// a factor f, discs enter 1/f as many cells and test f² as many candidates. So the cube of the
/// best f is `candidates_per_entry` entries / (2 candidates).
inline constexpr double candidates_per_entry = 32.0;
inline constexpr double narrower = 0.7, wider = 1.4;
/// Lists are considered whenever this many candidates per disc have been tested, in about four
/// events.
inline constexpr std::uint64_t candidates_between_tests = 100;
SWIRL_INLINE void consider_lists(LinkedCellsState& state, double t) {
    if (state.candidates_tested < state.candidates_at_next_test) [[likely]]
        return;
    state.candidates_at_next_test += candidates_between_tests * state.size;
    const bool last = state.chooses_search && lists_would_last(state, state.grid.width(), t);
    begin_test(state);
    if (!last) return;
    state.should_switch_search = true;
    state.target_cell_width = 0.0;
}
/// Called at the end of a period. Does nothing until so much has happened that building new cells
/// is cheap in comparison.
static void choose_width(LinkedCellsState& state) {
    if (state.candidates_tested < 300 * static_cast<std::uint64_t>(state.size)) return;
    const auto entered = static_cast<double>(state.list_rebuilds - state.cell_changes_before);
    const double cube =
        0.5 * candidates_per_entry * entered / static_cast<double>(state.candidates_tested);
    state.candidates_tested = 0;
    state.candidates_at_next_test = candidates_between_tests * state.size;
    state.cell_changes_before = state.list_rebuilds;
    const double before = state.grid.width();
    if (cube < 0.4 && before > 1.1 * state.min_width)
        request_width(state, narrower, false);
    else if (cube > 2.5 && 1.1 * before < state.max_cell_width)
        request_width(state, wider, false);
}

/// The discs of nine cells. The disc itself is among them; it never collides with itself. The last
/// one is followed by eight sentinels.
struct Candidates {
    std::uint32_t count;
    std::uint32_t disc[9 * (Cell::capacity + max_overflow_capacity) + 8];
};

template <bool has_overflow>
SWIRL_INLINE void collect(const LinkedCellsState& state, std::uint32_t i, Candidates& candidates) {
    const Cell* row = state.cells + state.positions[i].cell - state.grid.cells_per_side - 1;
    std::uint32_t count = 0;
#pragma GCC unroll 3
    for (int y = 0; y < 3; ++y, row += state.grid.cells_per_side) {
#pragma GCC unroll 3
        for (int x = 0; x < 3; ++x) {
            // The whole cell is copied, so only the position of the next copy depends on its count.
            std::memcpy(candidates.disc + count, &row[x], sizeof(Cell));
            if (has_overflow && row[x].count > Cell::capacity) {
                const auto number = static_cast<std::uint32_t>(row + x - state.cells);
                for (std::uint32_t k = 0; k < state.overflow_capacity; k += 8)
                    std::memcpy(candidates.disc + count + Cell::capacity + k,
                                state.overflow(number) + k, 8 * sizeof(std::uint32_t));
            }
            count += row[x].count;
        }
    }
    for (int k = 0; k < 8; ++k) candidates.disc[count + k] = state.size;
    candidates.count = count;
}
[[gnu::noinline]] static void collect_with_overflow(const LinkedCellsState& state, std::uint32_t i,
                                                    Candidates& candidates) {
    collect<true>(state, i, candidates);
}
SWIRL_INLINE void collect_candidates(const LinkedCellsState& state, std::uint32_t i,
                                     Candidates& candidates) {
    if (state.overflow_capacity != 0) [[unlikely]]
        return collect_with_overflow(state, i, candidates);
    collect<false>(state, i, candidates);
}

/// The time at which disc i reaches the wall, if that is before `latest`, the time of its earliest
/// other event.
SWIRL_INLINE double wall_time(const LinkedCellsState& state, std::uint32_t i, double latest) {
    if (state.discs[i].far_from_wall != 0) return never;
    if (state.on_arc()) [[unlikely]]
        return wall_time_by(state, i, latest);
    return swirl::wall_time(state, i);
}

/// For disc i, predicted at time t: when it reaches an edge of its cell, and which; and when it
/// reaches the wall, if that is before the edge and before its first contact, at time `contact`.
/// The edge is never reached at once. Otherwise a disc that flies along an edge would cross it
/// without end.
SWIRL_INLINE Leaving leaving_times(const LinkedCellsState& state, std::uint32_t i, double t,
                                   double contact) {
    const HotDisc& disc = state.discs[i];
    const CellPosition& mine = state.positions[i];
    const Flight<double>& frame = state.comoving_frame.origin;
    const Vec2 offset = disc.flight().position_at(t) - frame.position_at(t) - Vec2{mine.X, mine.Y};
    const Vec2 v = disc.velocity - frame.velocity;
    const Lanes<2> speed = two_lanes(v.x, v.y), from = two_lanes(offset.x, offset.y);
    const Lanes<2> zero(0.0), half(0.5 * state.grid.width());
    const Lanes<2> way = select(speed > zero, half - from, half + from);
    // Without motion along an axis the wait is infinite; the sign of the zero speed does not count.
    const Lanes<2> rate = larger(select(speed > zero, speed, -speed), zero);
    const Lanes<2> wait = larger(way, Lanes<2>(1e-9) * half) / rate;
    const double x = lane(wait, 0), y = lane(wait, 1);
    // Without a branch, because the edge is unpredictable.
    const std::uint32_t across = 1u - (v.x > 0.0), up = 3u - (v.y > 0.0);
    const double edge = t + smaller(x, y);
    return {cells::wall_time(state, i, smaller(contact, edge)), edge,
            leaves_skin + chosen(x < y, across, up)};
}

/// The earliest of a disc's first contact, the wall and the edge of its cell. In a dilute system
/// half of all predictions end at an edge, so this has no branch.
SWIRL_INLINE PendingEvent earliest_with_edge(const PendingEvent& contact, const Leaving& leaving) {
    const PendingEvent first = first_of(contact, leaving.wall);
    return {smaller(leaving.skin, first.time), first.disc,
            chosen(leaving.skin < first.time, leaving.mark, first.partner)};
}

/// The first contact of a disc with an unassigned disc, if it comes before all others.
[[gnu::noinline]] static PendingEvent earliest_unassigned(const LinkedCellsState& state,
                                                          PendingEvent first) {
    const HotDisc& disc = state.discs[first.disc];
    for (std::uint32_t k = 0; k < state.unassigned_count; k += 8) {
        const Others<8> others = load_others<8>(state, state.unassigned + k);
        first = earlier<8>(state.unassigned + k, contact_times<StateAge::any>(disc, others, 0.0),
                           first);
    }
    return first;
}

/// The slow way: one vector after the other. Of simultaneous contacts it returns the one with the
/// smallest partner.
template <StateAge age>
[[gnu::noinline]] static PendingEvent first_in_order_of_candidates(const LinkedCellsState& state,
                                                                   std::uint32_t i, double t,
                                                                   const Candidates& candidates) {
    PendingEvent first = no_contact(i);
    for (std::uint32_t k = 0; k < candidates.count; k += 8) {
        const std::uint32_t* const eight = candidates.disc + k;
        const Others<8> others = load_others<8>(state, eight);
        first = earlier<8>(eight, contact_times<age>(state.discs[i], others, t), first);
    }
    return first;
}
/// The first contact of disc i, predicted at time t; `contacts` holds the times of the first eight
/// candidates. Which vector contains the earliest contact is unpredictable. So each lane keeps its
/// earliest contact, the vector that it came from, and the earliest of the rejected ones.
template <StateAge age>
SWIRL_INLINE PendingEvent first_of_candidates(const LinkedCellsState& state, std::uint32_t i,
                                              double t, const Candidates& candidates,
                                              const Lanes<8>& contacts) {
    // If one vector is enough there is mostly no contact, so the branch in `earlier` is
    // predictable.
    if (candidates.count <= 8) return earlier<8>(candidates.disc, contacts, no_contact(i));
    Lanes<8> first = contacts, from(0.0), second(never);
    for (std::uint32_t k = 8; k < candidates.count; k += 8) {
        const Others<8> others = load_others<8>(state, candidates.disc + k);
        const Lanes<8> more = contact_times<age>(state.discs[i], others, t);
        second = smaller(second, larger(more, first));
        from = select(more < first, Lanes<8>(k), from);
        first = smaller(more, first);
    }
    alignas(64) double begin[8];
    from.store(begin);
    const double time = smallest(first);
    const unsigned equal = lanes_equal(first, time);
    const unsigned others = (equal & (equal - 1)) | lanes_equal(second, time);
    // Without a contact all lanes are equal.
    if (chosen(time < never, others, 0) != 0) [[unlikely]]
        return first_in_order_of_candidates<age>(state, i, t, candidates);
    const auto lane = static_cast<std::uint32_t>(__builtin_ctz(equal));
    return {time, i, candidates.disc[static_cast<std::uint32_t>(begin[lane]) + lane]};
}

/// Finds the next event of each of D discs, predicted at time t.
template <StateAge age, int D>
SWIRL_INLINE void find_first(LinkedCellsState& state, const std::uint32_t (&ids)[D], double t,
                             PendingEvent (&first)[D]) {
    Candidates candidates[D];
    Lanes<8> contacts[D];
    for (int d = 0; d < D; ++d) collect_candidates(state, ids[d], candidates[d]);
    for (int d = 0; d < D; ++d)
        contacts[d] =
            contact_times<age>(state.discs[ids[d]], load_others<8>(state, candidates[d].disc), t);
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        PendingEvent contact =
            first_of_candidates<age>(state, ids[d], t, candidates[d], contacts[d]);
        state.candidates_tested += candidates[d].count;
        if (state.unassigned_count != 0) [[unlikely]]
            contact = earliest_unassigned(state, contact);
        first[d] = earliest_with_edge(contact, leaving_times(state, ids[d], t, contact.time));
    }
}
template <StateAge age, int D>
[[gnu::noinline]] static void predict(LinkedCellsState& state, const std::uint32_t (&ids)[D],
                                      double t) {
    PendingEvent first[D];
    find_first<age, D>(state, ids, t, first);
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) insert(state, first[d]);
}

[[gnu::noinline]] static void become_unassigned(LinkedCellsState& state, std::uint32_t i) {
    state.unassigned[state.unassigned_count++] = i;
    if (state.unassigned_count > max_unassigned) request_width(state, narrower, true);
}
/// Returns false if disc i is not unassigned.
SWIRL_INLINE bool unassigned_leaves(LinkedCellsState& state, std::uint32_t i) {
    for (std::uint32_t position = 0; position < state.unassigned_count; ++position) {
        if (state.unassigned[position] != i) continue;
        state.unassigned[position] = state.unassigned[--state.unassigned_count];
        state.unassigned[state.unassigned_count] = state.size;
        return true;
    }
    return false;
}

/// Removes disc i from a cell whose last disc is in the overflow.
[[gnu::noinline]] static void leave_full(LinkedCellsState& state, std::uint32_t number,
                                         std::uint32_t i) {
    Cell& cell = state.cells[number];
    const std::uint32_t last = state.disc_in_cell(number, --cell.count);
    for (std::uint32_t slot = 0; slot < cell.count; ++slot)
        if (state.disc_in_cell(number, slot) == i) state.disc_in_cell(number, slot) = last;
}
SWIRL_INLINE void leave(LinkedCellsState& state, std::uint32_t i) {
    if (state.unassigned_count != 0 && unassigned_leaves(state, i)) [[unlikely]]
        return;
    const std::uint32_t number = state.positions[i].cell;
    Cell& cell = state.cells[number];
    if (cell.count > Cell::capacity) [[unlikely]]
        return leave_full(state, number, i);
    // The search for i reads eight numbers, of which the last is the count; disc i precedes it.
    const std::uint32_t slot = index_in_list(cell.disc, 8, i);
    cell.disc[slot] = cell.disc[--cell.count];
}
SWIRL_INLINE void leave_wall(LinkedCellsState& state, std::uint32_t i) {
    const std::uint32_t position = state.positions[i].near_wall;
    const std::uint32_t last = state.near_wall[--state.near_wall_count];
    state.near_wall[position] = last;
    state.near_wall[state.near_wall_count] = state.size;
    state.positions[last].near_wall = position;
}

static void enter(LinkedCellsState& state, std::uint32_t i, std::uint32_t number) {
    Cell& cell = state.cells[number];
    if (cell.count < Cell::capacity) [[likely]]
        cell.disc[cell.count++] = i;
    else if (cell.count < Cell::capacity + state.overflow_capacity)
        state.disc_in_cell(number, cell.count++) = i;
    else
        become_unassigned(state, i);
    const std::uint32_t side = state.grid.cells_per_side;
    const auto centre = [&](std::uint32_t row) {
        return static_cast<float>(state.grid.corner + (row + 0.5) * state.grid.width());
    };
    CellPosition& position = state.positions[i];
    position.X = centre(number % side);
    position.Y = centre(number / side);
    position.cell = number;
    HotDisc& disc = state.discs[i];
    const double X = position.X, Y = position.Y;
    const bool far = X * X + Y * Y < state.far_from_wall_square;
    if (far == (disc.far_from_wall != 0)) return;
    disc.far_from_wall = far & 1u;
    if (far) return leave_wall(state, i);
    position.near_wall = state.near_wall_count;
    state.near_wall[state.near_wall_count++] = i;
}

/// Moves disc i, which has reached an edge of its cell, to the cell on the other side.
[[gnu::noinline]] static void enter_next_cell(LinkedCellsState& state, std::uint32_t i, double t) {
    ++state.list_rebuilds;
    consider_lists(state, t);
    const std::uint32_t side = state.grid.cells_per_side;
    const std::uint32_t step[4] = {1u, 0u - 1u, side, 0u - side};
    const std::uint32_t to = state.positions[i].cell + step[state.cold(i).partner - leaves_skin];
    leave(state, i);
    enter(state, i, to);
    predict<StateAge::any, 1>(state, {i}, t);
}

/// Predicts cell after cell, so that the candidates are still in the cache.
template <StateAge age>
static void predict_all(LinkedCellsState& state, double t) {
    const std::uint32_t cells = state.grid.cell_count();
    const auto write_down = [&](std::uint32_t i) {
        PendingEvent first[1];
        find_first<age, 1>(state, {i}, t, first);
        store_partner(state, first[0]);
        state.queue.level_times[0][i] = first[0].time;
    };
    // Far enough ahead for the latency of memory.
    const std::uint32_t ahead = state.grid.cells_per_side + 12;
    std::uint32_t predicted = 0;
    for (std::uint32_t c = 0; c < cells; ++c) {
        if (state.queue.prefetches && c + ahead < cells) {
            const std::uint32_t soon = c + ahead;
            for (std::uint32_t k = 0; k < state.cells[soon].count; ++k)
                prefetch_disc(state, state.disc_in_cell(soon, k));
        }
        for (std::uint32_t k = 0; k < state.cells[c].count; ++k) {
            if (state.stops_at(predicted++)) return;
            write_down(state.disc_in_cell(c, k));
        }
    }
    for (std::uint32_t k = 0; k < state.unassigned_count; ++k) write_down(state.unassigned[k]);
    run_tournament(state);
}

/// Distributes all discs over the cells.
static void enter_all(LinkedCellsState& state) {
    for (std::uint32_t c = 0; c < state.grid.cell_count(); ++c) state.cells[c].count = 0;
    for (std::uint32_t k = 0; k < state.size + 8; ++k)
        state.near_wall[k] = state.unassigned[k] = state.size;
    state.near_wall_count = state.unassigned_count = 0;
    for (std::uint32_t i = 0; i < state.size; ++i) {
        if (state.stops_at(i)) return;
        state.discs[i].far_from_wall = 1;
        const Vec2 at = state.discs[i].flight().position_at(state.clock) -
                        state.comoving_frame.origin.position_at(state.clock);
        enter(state, i, state.grid.cell_at(at.x, at.y));
    }
}

/// Below this ratio of the energy of the discs' mean motion to that of all other motion, the cells
/// rest.
inline constexpr double min_common_motion = 0.1;
/// The mean velocity of the discs, if the cells should follow it and reach far enough for a period;
/// otherwise zero.
static Vec2 velocity_to_follow(const LinkedCellsState& state) {
    Vec2 sum{0.0, 0.0};
    double squares = 0.0;
    for (std::uint32_t i = 0; i < state.size; ++i) {
        const Vec2 v = state.discs[i].velocity;
        sum = sum + v;
        squares = squares + dot(v, v);
    }
    const Vec2 mean = (1.0 / state.size) * sum;
    const double common = dot(mean, mean) * state.size;
    const double drift = 0.5 * state.period * square_root(dot(mean, mean));
    const bool pays = common > min_common_motion * (squares - common);
    return pays && drift <= state.max_drift ? mean : Vec2{0.0, 0.0};
}
/// In the middle of the period the cells are centred on the path.
SWIRL_INLINE void begin_frame(LinkedCellsState& state, const Vec2& velocity) {
    const double half = 0.5 * state.period;
    state.comoving_frame = {.origin = {state.path_middle - half * velocity, velocity, 0.0}};
    const double far = state.reach_of_far_cells - half * square_root(dot(velocity, velocity));
    state.far_from_wall_square = far > 0.0 ? far * far : 0.0;
}

static void start(LinkedCellsState& state) {
    clear_queue(state);
    begin_test(state);
    state.candidates_at_next_test = candidates_between_tests * state.size;
    begin_frame(state, velocity_to_follow(state));
    enter_all(state);
    if (!state.should_switch_search) predict_all<StateAge::any>(state, state.clock);
}

/// The period ends: all clocks restart.
static void period_ended(LinkedCellsState& state) {
    choose_width(state);
    const Vec2 before = state.comoving_frame.origin.velocity, velocity = velocity_to_follow(state);
    if (dot(before, before) + dot(velocity, velocity) > 0.0) {
        begin_frame(state, velocity);
        enter_all(state);
    }
    predict_all<StateAge::now>(state, 0.0);
}

/// Predicts when the eight discs from `begin` on, of those near the wall, reach it on the segment
/// that begins now.
SWIRL_INLINE void renew_walls_of_eight(LinkedCellsState& state, std::uint32_t begin) {
    const std::uint32_t* const ids = state.near_wall + begin;
    const Others<8> discs = load_others<8>(state, ids);
    alignas(64) double wall[8];
    wall_times<8>(state, discs.flight, discs.radius).store(wall);
    for (std::uint32_t k = 0; k < 8 && begin + k < state.near_wall_count; ++k)
        renew_leaving(state, ids[k], state.clock, {wall[k], never}, false);
}

/// The container has begun its next segment.
static void segment_ended(LinkedCellsState& state) {
    if (state.segment == 0) return period_ended(state);
    for (std::uint32_t k = 0; k < state.near_wall_count; k += 8) renew_walls_of_eight(state, k);
}

}  // namespace cells

struct LinkedCells {
    using State = LinkedCellsState;
    using Bodies = Discs;

    SWIRL_INLINE static void start(LinkedCellsState& state) { cells::start(state); }
    SWIRL_INLINE static PendingEvent next(const LinkedCellsState& state) {
        return next_pending(state);
    }
    SWIRL_INLINE static void reschedule(LinkedCellsState& state, const PendingEvent& event) {
        swirl::remove(state, event.disc);
        if (event.partner >= leaves_skin) {
            cells::enter_next_cell(state, event.disc, event.time);
        } else {
            ++state.invalidated;
            cells::predict<StateAge::any, 1>(state, {event.disc}, event.time);
        }
    }
    SWIRL_INLINE static PendingEvent remove(LinkedCellsState& state, const PendingEvent& event) {
        return remove_first<LinkedCells>(state, event);
    }
    template <int D>
    SWIRL_INLINE static void predict_changed(LinkedCellsState& state, const std::uint32_t (&ids)[D],
                                             double t) {
        cells::predict<StateAge::now, D>(state, ids, t);
    }
    SWIRL_INLINE static void check(const LinkedCellsState& state, double t) {
        check_cells(state, t);
        check_tournament(state);
    }
    SWIRL_INLINE static bool should_switch_search(const LinkedCellsState& state) {
        return state.should_switch_search;
    }
    SWIRL_INLINE static void segment_ended(LinkedCellsState& state, double) {
        cells::segment_ended(state);
    }
};
static_assert(NeighborSearch<LinkedCells> && CanAskToBeReplaced<LinkedCells>);

}  // namespace SWIRL_TARGET
}  // namespace swirl
