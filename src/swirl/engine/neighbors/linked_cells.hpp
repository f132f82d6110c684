// Speed only, changes no bit: the search through linked cells. A disc may meet those in its cell
// and in the eight around it. For a thin gas, where a disc flies through any skin in a collision or
// two and its list would not be worth its making.
//
// The cells are squares, wider than two discs of the largest, so that discs in cells that do not
// touch cannot meet; and so wide that few edges are crossed from one collision to the next, while a
// prediction still takes one vector. A disc that reaches the edge of its cell enters the next, and
// what it may meet is looked up anew. Through a swirl the cells move with the mean velocity that
// the discs had when it began, or rest if that is little against their other motion. The container
// moves over them: a corner of its path is news only to those in cells to which the wall comes.
//
// A cell has room for seven. Who comes eighth is a stray, known to everybody, until it enters
// another cell. Where discs gather strays become many, and narrower cells take over. There are none
// of equal discs in cells below 3.86 radii: eight points in a square of side 1 are at most (√6 −
// √2)/2 apart (Schaer and Meir 1965, Canad. Math. Bull. 8, 21). In a pack cells for little more
// than one disc are the fastest.
//
// Of unequal discs the largest says how narrow cells can be. If they hold many of the small ones at
// rest, each has an annex with more room.
//
// Included by one file per vector width, like event_loop.hpp, and under the same rule.
#pragma once

#include <cstring>

#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/engine/neighbors/engine_state_checks.hpp"
#include "swirl/engine/neighbors/lists_or_cells.hpp"
#include "swirl/engine/neighbors/prediction.hpp"
#include "swirl/engine/neighbors/renewed_leaving.hpp"
#include "swirl/engine/neighbors/tournament.hpp"
#include "swirl/engine/neighbors/verlet_skin.hpp"
#include "swirl/engine/neighbors/wall_times.hpp"
#include "swirl/engine/pending_event.hpp"
#include "swirl/math/lanes.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {
namespace cells {

SWIRL_INLINE double width(const EngineState& state) {
    return 1.0 / state.grids[0].cells_per_length;
}

/// With more strays than this narrower cells are faster; each eight of them cost everybody a
/// vector.
inline constexpr std::uint32_t max_unassigned = 16;

/// Discs would do with cells so much wider. If they have gathered and have no place, these are the
/// widest from now on; and if there are no narrower ones, lists take over.
SWIRL_INLINE void outgrow(EngineState& state, double factor, bool for_want_of_room) {
    state.should_switch_search = true;
    const double before = width(state);
    const double wanted = smaller(larger(factor * before, state.narrowest_cell), state.widest_cell);
    const bool is_narrowest = before < 1.0001 * state.narrowest_cell;
    if (for_want_of_room) state.widest_cell = wanted;
    state.wanted_cell = wanted;
    if (!for_want_of_room || !is_narrowest) return;
    state.wanted_cell = 0.0;
    state.chooses_search = false;  // and these lists remain
}

/// To enter a cell takes as long as to look at so many discs; with cells wider by a factor f it is
/// done 1/f times as often, and f² times as many are looked at. So the best f has the cube
/// `candidates_per_entry` entries / (2 candidates).
inline constexpr double candidates_per_entry = 32.0;
inline constexpr double narrower = 0.7, wider = 1.4;
/// Asked whenever so many have been looked at for each disc, some four events.
inline constexpr std::uint64_t candidates_till_asked = 100;
SWIRL_INLINE void ask_about_lists(EngineState& state, double t) {
    if (state.candidates_looked_at < state.candidates_till_asked) [[likely]]
        return;
    state.candidates_till_asked += candidates_till_asked * state.size;
    const bool last = state.chooses_search && lists_would_last(state, width(state), t);
    begin_to_count(state);
    if (!last) return;
    state.should_switch_search = true;
    state.wanted_cell = 0.0;
}
/// Asked at the end of a swirl, when so much has happened that laying all anew is little besides.
static void choose_width(EngineState& state) {
    if (state.candidates_looked_at < 300 * static_cast<std::uint64_t>(state.size)) return;
    const auto entered = static_cast<double>(state.list_rebuilds - state.entered_before);
    const double cube =
        0.5 * candidates_per_entry * entered / static_cast<double>(state.candidates_looked_at);
    state.candidates_looked_at = 0;
    state.candidates_till_asked = candidates_till_asked * state.size;
    state.entered_before = state.list_rebuilds;
    const double before = width(state);
    if (cube < 0.4 && before > 1.1 * state.narrowest_cell)
        outgrow(state, narrower, false);
    else if (cube > 2.5 && 1.1 * before < state.widest_cell)
        outgrow(state, wider, false);
}

/// The discs of nine cells, the one that asks among them: it never meets itself. After the last
/// come eight times nobody.
struct Candidates {
    std::uint32_t count;
    std::uint32_t disc[9 * (Cell::room + max_overflow_capacity) + 8];
};

template <bool have_annexes>
SWIRL_INLINE void collect(const EngineState& state, std::uint32_t i, Candidates& candidates) {
    const Cell* row = state.cells + state.skins[i].cell - state.grids[0].cells_per_side - 1;
    std::uint32_t count = 0;
#pragma GCC unroll 3
    for (int y = 0; y < 3; ++y, row += state.grids[0].cells_per_side) {
#pragma GCC unroll 3
        for (int x = 0; x < 3; ++x) {
            // The whole cell, so that nothing depends on how many there are but the place of the
            // next.
            std::memcpy(candidates.disc + count, &row[x], sizeof(Cell));
            if (have_annexes && row[x].count > Cell::room) {
                const auto number = static_cast<std::uint32_t>(row + x - state.cells);
                for (std::uint32_t k = 0; k < state.overflow_capacity; k += 8)
                    std::memcpy(candidates.disc + count + Cell::room + k,
                                state.overflow(number) + k, 8 * sizeof(std::uint32_t));
            }
            count += row[x].count;
        }
    }
    for (int k = 0; k < 8; ++k) candidates.disc[count + k] = state.size;
    candidates.count = count;
}
[[gnu::noinline]] static void collect_with_annexes(const EngineState& state, std::uint32_t i,
                                                   Candidates& candidates) {
    collect<true>(state, i, candidates);
}
SWIRL_INLINE void collect_candidates(const EngineState& state, std::uint32_t i,
                                     Candidates& candidates) {
    if (state.overflow_capacity != 0) [[unlikely]]
        return collect_with_annexes(state, i, candidates);
    collect<false>(state, i, candidates);
}

/// When disc i, which does something else at `latest`, reaches the wall, if before.
SWIRL_INLINE double wall_time(const EngineState& state, std::uint32_t i, double latest) {
    if (state.discs[i].far_from_wall != 0) return never;
    if (state.on_turning_segment()) [[unlikely]]
        return wall_time_by(state, i, latest);
    return swirl::wall_time(state, i);
}

/// When disc i, asked at time t, is at an edge of its cell, and at which; and at the wall, if
/// before that and before it meets somebody, at time `meeting`. Never at once at an edge, so that
/// who stands on one and flies along it is not told for ever to cross it.
SWIRL_INLINE Leaving leaving_times(const EngineState& state, std::uint32_t i, double t,
                                   double meeting) {
    const HotDisc& disc = state.discs[i];
    const Skin& mine = state.skins[i];
    const Flight<double>& frame = state.comoving_frame.origin;
    const Vec2 offset = disc.flight().position_at(t) - frame.position_at(t) - Vec2{mine.X, mine.Y};
    const Vec2 v = disc.velocity - frame.velocity;
    const Lanes<2> speed = two_lanes(v.x, v.y), from = two_lanes(offset.x, offset.y);
    const Lanes<2> zero(0.0), half(0.5 * width(state));
    const Lanes<2> way = select(speed > zero, half - from, half + from);
    // At rest in one direction, whatever the sign of its zero: never.
    const Lanes<2> rate = larger(select(speed > zero, speed, -speed), zero);
    const Lanes<2> wait = larger(way, Lanes<2>(1e-9) * half) / rate;
    const double x = lane(wait, 0), y = lane(wait, 1);
    // By which edge is not to be guessed.
    const std::uint32_t across = 1u - (v.x > 0.0), up = 3u - (v.y > 0.0);
    const double edge = t + smaller(x, y);
    return {cells::wall_time(state, i, smaller(meeting, edge)), edge,
            leaves_skin + chosen(x < y, across, up)};
}

/// The first of a disc's first meeting, the wall and the edge of its cell: in a thin gas half of
/// all predictions end there, so it is not to be guessed.
SWIRL_INLINE PendingEvent or_edge(const PendingEvent& meeting, const Leaving& leaving) {
    const PendingEvent first = first_of(meeting, leaving.wall);
    return {smaller(leaving.skin, first.time), first.disc,
            chosen(leaving.skin < first.time, leaving.mark, first.partner)};
}

/// The first of the strays that a disc meets, if it meets one before all others.
[[gnu::noinline]] static PendingEvent earliest_unassigned(const EngineState& state,
                                                          PendingEvent first) {
    const HotDisc& disc = state.discs[first.disc];
    for (std::uint32_t k = 0; k < state.unassigned_count; k += 8) {
        const Others<8> others = load_others<8>(state, state.unassigned + k);
        first = earlier<8>(state.unassigned + k,
                           contact_times<Held::for_a_while>(disc, others, 0.0), first);
    }
    return first;
}

/// The same one vector after the other, of those at one instant the one with the smallest number.
template <Held held>
[[gnu::noinline]] static PendingEvent first_in_order_of_candidates(const EngineState& state,
                                                                   std::uint32_t i, double t,
                                                                   const Candidates& candidates) {
    PendingEvent first = no_meeting(i);
    for (std::uint32_t k = 0; k < candidates.count; k += 8) {
        const std::uint32_t* const eight = candidates.disc + k;
        const Others<8> others = load_others<8>(state, eight);
        first = earlier<8>(eight, contact_times<held>(state.discs[i], others, t), first);
    }
    return first;
}
/// Whom disc i, asked at time t, meets first; when it meets the first eight is known. Which vector
/// has the first of all is anybody's guess, so each lane keeps its own, where that came from, and
/// the soonest of those that it was preferred to.
template <Held held>
SWIRL_INLINE PendingEvent first_of_candidates(const EngineState& state, std::uint32_t i, double t,
                                              const Candidates& candidates,
                                              const Lanes<8>& contacts) {
    // Where one vector suffices mostly nobody is met, which is guessed right.
    if (candidates.count <= 8) return earlier<8>(candidates.disc, contacts, no_meeting(i));
    Lanes<8> first = contacts, from(0.0), second(never);
    for (std::uint32_t k = 8; k < candidates.count; k += 8) {
        const Others<8> others = load_others<8>(state, candidates.disc + k);
        const Lanes<8> more = contact_times<held>(state.discs[i], others, t);
        second = smaller(second, larger(more, first));
        from = select(more < first, Lanes<8>(k), from);
        first = smaller(more, first);
    }
    alignas(64) double begin[8];
    from.store(begin);
    const double time = smallest(first);
    const unsigned equal = lanes_equal(first, time);
    const unsigned others = (equal & (equal - 1)) | lanes_equal(second, time);
    // Where nobody is met all are equal.
    if (chosen(time < never, others, 0) != 0) [[unlikely]]
        return first_in_order_of_candidates<held>(state, i, t, candidates);
    const auto lane = static_cast<std::uint32_t>(__builtin_ctz(equal));
    return {time, i, candidates.disc[static_cast<std::uint32_t>(begin[lane]) + lane]};
}

/// The first of everything that may happen to each of D discs, asked at time t.
template <Held held, int D>
SWIRL_INLINE void find_first(EngineState& state, const std::uint32_t (&who)[D], double t,
                             PendingEvent (&first)[D]) {
    Candidates candidates[D];
    Lanes<8> contacts[D];
    for (int d = 0; d < D; ++d) collect_candidates(state, who[d], candidates[d]);
    for (int d = 0; d < D; ++d)
        contacts[d] =
            contact_times<held>(state.discs[who[d]], load_others<8>(state, candidates[d].disc), t);
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        PendingEvent meeting =
            first_of_candidates<held>(state, who[d], t, candidates[d], contacts[d]);
        state.candidates_looked_at += candidates[d].count;
        if (state.unassigned_count != 0) [[unlikely]]
            meeting = earliest_unassigned(state, meeting);
        first[d] = or_edge(meeting, leaving_times(state, who[d], t, meeting.time));
    }
}
template <Held held, int D>
[[gnu::noinline]] static void predict(EngineState& state, const std::uint32_t (&who)[D], double t) {
    PendingEvent first[D];
    find_first<held, D>(state, who, t, first);
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) insert(state, first[d]);
}

[[gnu::noinline]] static void become_unassigned(EngineState& state, std::uint32_t i) {
    state.unassigned[state.unassigned_count++] = i;
    if (state.unassigned_count > max_unassigned) outgrow(state, narrower, true);
}
/// False if disc i is none.
SWIRL_INLINE bool unassigned_leaves(EngineState& state, std::uint32_t i) {
    for (std::uint32_t place = 0; place < state.unassigned_count; ++place) {
        if (state.unassigned[place] != i) continue;
        state.unassigned[place] = state.unassigned[--state.unassigned_count];
        state.unassigned[state.unassigned_count] = state.size;
        return true;
    }
    return false;
}

/// A cell whose last is in its annex.
[[gnu::noinline]] static void leave_full(EngineState& state, std::uint32_t number,
                                         std::uint32_t i) {
    Cell& cell = state.cells[number];
    const std::uint32_t last = state.disc_in_cell(number, --cell.count);
    for (std::uint32_t slot = 0; slot < cell.count; ++slot)
        if (state.disc_in_cell(number, slot) == i) state.disc_in_cell(number, slot) = last;
}
SWIRL_INLINE void leave(EngineState& state, std::uint32_t i) {
    if (state.unassigned_count != 0 && unassigned_leaves(state, i)) [[unlikely]]
        return;
    const std::uint32_t number = state.skins[i].cell;
    Cell& cell = state.cells[number];
    if (cell.count > Cell::room) [[unlikely]]
        return leave_full(state, number, i);
    // Of the cell's eight numbers the last is how many there are, but i stands before it.
    const std::uint32_t slot = place_in_list(cell.disc, 8, i);
    cell.disc[slot] = cell.disc[--cell.count];
}
SWIRL_INLINE void leave_wall(EngineState& state, std::uint32_t i) {
    const std::uint32_t place = state.skins[i].near_wall;
    const std::uint32_t last = state.near_wall[--state.near_wall_count];
    state.near_wall[place] = last;
    state.near_wall[state.near_wall_count] = state.size;
    state.skins[last].near_wall = place;
}

static void enter(EngineState& state, std::uint32_t i, std::uint32_t number) {
    Cell& cell = state.cells[number];
    if (cell.count < Cell::room) [[likely]]
        cell.disc[cell.count++] = i;
    else if (cell.count < Cell::room + state.overflow_capacity)
        state.disc_in_cell(number, cell.count++) = i;
    else
        become_unassigned(state, i);
    const std::uint32_t side = state.grids[0].cells_per_side;
    const auto centre = [&](std::uint32_t row) {
        return static_cast<float>(state.cell_origin + (row + 0.5) * width(state));
    };
    Skin& place = state.skins[i];
    place.X = centre(number % side);
    place.Y = centre(number / side);
    place.cell = number;
    HotDisc& disc = state.discs[i];
    const double X = place.X, Y = place.Y;
    const bool far = X * X + Y * Y < state.far_from_wall_square;
    if (far == (disc.far_from_wall != 0)) return;
    disc.far_from_wall = far & 1u;
    if (far) return leave_wall(state, i);
    place.near_wall = state.near_wall_count;
    state.near_wall[state.near_wall_count++] = i;
}

/// Disc i has come to an edge and enters the cell beyond.
[[gnu::noinline]] static void enter_next_cell(EngineState& state, std::uint32_t i, double t) {
    ++state.list_rebuilds;
    ask_about_lists(state, t);
    const std::uint32_t side = state.grids[0].cells_per_side;
    const std::uint32_t step[4] = {1u, 0u - 1u, side, 0u - side};
    const std::uint32_t to = state.skins[i].cell + step[state.cold(i).partner - leaves_skin];
    leave(state, i);
    enter(state, i, to);
    predict<Held::for_a_while, 1>(state, {i}, t);
}

/// Cell after cell, so that who is looked at is still at hand.
template <Held held>
static void predict_all(EngineState& state, double t) {
    const std::uint32_t cells = state.grids[0].cells_per_side * state.grids[0].cells_per_side;
    const auto write_down = [&](std::uint32_t i) {
        PendingEvent first[1];
        find_first<held, 1>(state, {i}, t, first);
        note_partner(state, first[0]);
        state.level_times[0][i] = first[0].time;
    };
    // Far enough ahead for memory.
    const std::uint32_t ahead = state.grids[0].cells_per_side + 12;
    std::uint32_t predicted = 0;
    for (std::uint32_t c = 0; c < cells; ++c) {
        if (state.prefetches && c + ahead < cells) {
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
    hold_tournament(state);
}

/// Everybody enters a cell, from nowhere.
static void enter_all(EngineState& state) {
    const Grid& grid = state.grids[0];
    for (std::uint32_t c = 0; c < grid.cells_per_side * grid.cells_per_side; ++c)
        state.cells[c].count = 0;
    for (std::uint32_t k = 0; k < state.size + 8; ++k)
        state.near_wall[k] = state.unassigned[k] = state.size;
    state.near_wall_count = state.unassigned_count = 0;
    for (std::uint32_t i = 0; i < state.size; ++i) {
        if (state.stops_at(i)) return;
        state.discs[i].far_from_wall = 1;
        const Vec2 at = state.discs[i].flight().position_at(state.clock) -
                        state.comoving_frame.origin.position_at(state.clock);
        enter(state, i, cell_number(state, grid, at.x, at.y));
    }
}

/// If the discs' energy in their mean motion is less than this, over that in all other motion,
/// cells might as well rest.
inline constexpr double bearable_common_motion = 0.1;
/// The mean velocity of the discs, if that is worth following, through a swirl, and the cells
/// reach so far.
static Vec2 velocity_to_follow(const EngineState& state) {
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
    const bool pays = common > bearable_common_motion * (squares - common);
    return pays && drift <= state.max_drift ? mean : Vec2{0.0, 0.0};
}
/// In the middle of the swirl the cells are where the path is.
SWIRL_INLINE void begin_frame(EngineState& state, const Vec2& velocity) {
    const double half = 0.5 * state.period;
    state.comoving_frame = {.origin = {state.middle_of_path - half * velocity, velocity, 0.0}};
    const double far = state.reach_of_far_cells - half * square_root(dot(velocity, velocity));
    state.far_from_wall_square = far > 0.0 ? far * far : 0.0;
}

static void start(EngineState& state) {
    empty_queue(state);
    begin_to_count(state);
    state.candidates_till_asked = candidates_till_asked * state.size;
    begin_frame(state, velocity_to_follow(state));
    enter_all(state);
    if (!state.should_switch_search) predict_all<Held::for_a_while>(state, state.clock);
}

/// All clocks restart.
static void swirl_ended(EngineState& state) {
    choose_width(state);
    const Vec2 before = state.comoving_frame.origin.velocity, velocity = velocity_to_follow(state);
    if (dot(before, before) + dot(velocity, velocity) > 0.0) {
        begin_frame(state, velocity);
        enter_all(state);
    }
    predict_all<Held::since_now>(state, 0.0);
}

/// When the eight discs from `begin` on, of those near the wall, reach it on the leg that begins
/// at time t.
SWIRL_INLINE void renew_walls_of_eight(EngineState& state, std::uint32_t begin) {
    const std::uint32_t* const who = state.near_wall + begin;
    const Others<8> discs = load_others<8>(state, who);
    alignas(64) double wall[8];
    wall_times<8>(state, discs.flight, discs.radius).store(wall);
    for (std::uint32_t k = 0; k < 8 && begin + k < state.near_wall_count; ++k)
        renew_leaving(state, who[k], state.clock, {wall[k], never}, false);
}

/// The container takes another course.
static void segment_ended(EngineState& state) {
    if (state.segment == 0) return swirl_ended(state);
    for (std::uint32_t k = 0; k < state.near_wall_count; k += 8) renew_walls_of_eight(state, k);
}

}  // namespace cells

struct LinkedCells {
    SWIRL_INLINE static void start(EngineState& state) { cells::start(state); }
    SWIRL_INLINE static PendingEvent next(const EngineState& state) { return next_pending(state); }
    SWIRL_INLINE static void reschedule(EngineState& state, const PendingEvent& event) {
        swirl::remove(state, event.disc);
        if (event.partner >= leaves_skin) {
            cells::enter_next_cell(state, event.disc, event.time);
        } else {
            ++state.invalidated;
            cells::predict<Held::for_a_while, 1>(state, {event.disc}, event.time);
        }
    }
    SWIRL_INLINE static PendingEvent remove(EngineState& state, const PendingEvent& event) {
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
    SWIRL_INLINE static bool should_switch_search(const EngineState& state) {
        return state.should_switch_search;
    }
    SWIRL_INLINE static void segment_ended(EngineState& state, double) {
        cells::segment_ended(state);
    }
};

}  // namespace SWIRL_TARGET
}  // namespace swirl
