// Speed only, changes no bit: whose event comes first. A tournament of eight: level 0 holds each
// disc's pending time, in rows of eight; each level above holds the winner of each row below. A row
// is one vector, so the winner of eight takes one pass of `smaller`. The topmost level has up to
// eight rows.
//
// The discs of an event are taken out before it is executed, and then who comes first of what
// remains is noted. When it has been predicted what they do next, they are put in again. That
// rarely comes first of all, so to ask is a branch which the processor guesses right: it goes on to
// the next event, as far as it looks ahead, while the predictions are still being computed.
//
// Who wins a row is anybody's guess, so it is settled without a branch, on all levels. In a large
// dish that is too much, most of it for nothing: there a disc that does not win its row is done.
//
// The rows are read and written by whole vectors: eight bytes written into a row that is then read
// as a vector would wait for the store to leave the processor's store buffer.
//
// Two equal times are mostly both partners of one collision, each with it as its pending event. If
// they are different events, their order decides (pending_event.hpp). Of discs that is asked when
// it happens, which is rare. Spheres that rolled undisturbed when the floor changed its velocity
// begin to roll again at the same instant, hundreds of them; so in their tournament the winner of
// a row is the first in order (`in_order`).
#pragma once

#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/engine/neighbors/prediction.hpp"
#include "swirl/engine/pending_event.hpp"
#include "swirl/math/lanes.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

SWIRL_INLINE void prefetch(const void* p) { __builtin_prefetch(p, 1, 3); }

/// Fetches what a prediction for disc i will read: the discs on its list, or the cells around.
SWIRL_INLINE void prefetch_neighbours(const EngineState& state, std::uint32_t i) {
    if (state.cells) {
        const Cell* row = state.cells + state.skins[i].cell - state.grids[0].cells_per_side - 1;
        for (int y = 0; y < 3; ++y, row += state.grids[0].cells_per_side) {
            prefetch(row);
            prefetch(row + 2);
        }
        return;
    }
    const std::uint32_t* const list = state.cold(i).neighbours();
    for (int k = 0; k < 8; ++k) prefetch(&state.discs[list[k]]);
}

/// Fetches what an event of disc i will read and write, and its places in the queue.
SWIRL_INLINE void prefetch_disc(const EngineState& state, std::uint32_t i) {
    prefetch(&state.discs[i]);
    prefetch(&state.cold(i));
    prefetch(&state.skins[i]);
    prefetch(state.level_times[0] + i);
    prefetch(state.level_times[1] + (i >> 3));
    prefetch(state.level_winners[1] + (i >> 3));
}

/// In a large dish most of what an event needs is far away in memory. Who has won all rows but the
/// last is soon to come: its own lines are fetched then, and its partner's and its neighbours' when
/// it is among the last eight.
SWIRL_INLINE void prefetch_winner(const EngineState& state, std::uint32_t level,
                                  std::uint32_t winner) {
    if (level + 2 == state.levels) {
        prefetch_disc(state, winner);
    } else if (level + 1 == state.levels) {
        prefetch_neighbours(state, winner);
        // Or nobody, in the place of a mark: whether it is one would be guessed wrong.
        const std::uint32_t partner = state.cold(winner).partner;
        prefetch_disc(state, chosen(partner < state.size, partner, state.size));
    }
}

/// No disc has an event.
SWIRL_INLINE void empty_queue(EngineState& state) {
    for (std::uint32_t level = 0; level < state.levels; ++level) {
        const std::uint32_t rows = ((state.size - 1) >> (3 * (level + 1))) + 1;
        for (std::uint32_t k = 0; k < 8 * rows; ++k) {
            state.level_times[level][k] = never;
            if (level > 0) state.level_winners[level][k] = (k << (3 * level)) % state.size;
        }
    }
    state.first_time = never;
    state.first_disc = 0;
}

SWIRL_INLINE PendingEvent pending_event(const EngineState& state, std::uint32_t disc, double time) {
    return {time, disc, state.cold(disc).partner};
}
/// Of those in a row whose bits are set, who comes first in order. The row has the level below
/// `level`, and begins at `row`.
[[gnu::noinline]] static std::uint32_t first_in_order_of(const EngineState& state,
                                                         std::uint32_t level, std::uint32_t row,
                                                         std::uint64_t equal, double time) {
    PendingEvent first{time, state.size, the_floor};
    for (; equal != 0; equal &= equal - 1) {
        const std::uint32_t place = row + static_cast<std::uint32_t>(__builtin_ctzll(equal));
        const std::uint32_t disc = level > 1 ? state.level_winners[level - 1][place] : place;
        const PendingEvent other = pending_event(state, disc, time);
        if (is_first_in_order(other, first)) first = other;
    }
    return first.disc;
}

/// Says who comes first of all, where the topmost level has so many rows.
template <int Rows, bool in_order>
SWIRL_INLINE void note_first_of_rows(EngineState& state) {
    const std::uint32_t top = state.levels - 1;
    Lanes<8> rows[Rows];
    for (int row = 0; row < Rows; ++row)
        rows[row] = Lanes<8>::load(state.level_times[top] + 8 * row);
    Lanes<8> minimum = rows[0];
    for (int row = 1; row < Rows; ++row) minimum = smaller(minimum, rows[row]);
    const double time = smallest(minimum);
    const std::uint64_t equal = lanes_equal(rows, time);
    const auto lane = static_cast<std::uint32_t>(__builtin_ctzll(equal));
    std::uint32_t disc = top == 0 ? lane : state.level_winners[top][lane];
    if (in_order && (equal & (equal - 1)) != 0 && time != never)
        disc = first_in_order_of(state, top + 1, 0, equal, time);
    state.first_time = time;
    state.first_disc = disc;
}

/// Says who comes first of all.
template <bool in_order = false>
SWIRL_INLINE void note_first(EngineState& state) {
    switch (state.top_rows) {
        case 1:
            return note_first_of_rows<1, in_order>(state);
        case 2:
            return note_first_of_rows<2, in_order>(state);
        case 4:
            return note_first_of_rows<4, in_order>(state);
        case 6:
            return note_first_of_rows<6, in_order>(state);
        default:
            note_first_of_rows<max_top_rows, in_order>(state);
    }
}

/// From the times of all discs, which are written down: who wins.
[[maybe_unused]] static void hold_tournament(EngineState& state) {
    for (std::uint32_t level = 1; level < state.levels; ++level) {
        const std::uint32_t rows = ((state.size - 1) >> (3 * level)) + 1;
        for (std::uint32_t row = 0; row < rows; ++row) {
            const Lanes<8> times = Lanes<8>::load(state.level_times[level - 1] + 8 * row);
            const double time = smallest(times);
            const std::uint32_t place = 8 * row + __builtin_ctz(lanes_equal(times, time));
            state.level_times[level][row] = time;
            state.level_winners[level][row] =
                level > 1 ? state.level_winners[level - 1][place] : place;
        }
    }
    note_first(state);
}

/// The places of one disc or two go to the next in their rows, on every level. Where both have one
/// row, the second sees there what the first has done, and what it writes is what stays.
template <int D, bool in_order>
SWIRL_INLINE void leave_rows(EngineState& state, const std::uint32_t (&who)[D]) {
    Lanes<8> row[D];
    std::uint32_t place[D];
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        place[d] = who[d];
        double* const times = state.level_times[0] + (place[d] & ~7u);
        set_lane<8>(times, place[d] & 7u, never);
        row[d] = Lanes<8>::load(times);
    }
    for (std::uint32_t level = 1; level < state.levels; ++level) {
#pragma GCC unroll 2
        for (int d = 0; d < D; ++d) {
            const double time = smallest(row[d]);
            const unsigned equal = lanes_equal(row[d], time);
            std::uint32_t winner = (place[d] & ~7u) + __builtin_ctz(equal);
            if (level > 1) winner = state.level_winners[level - 1][winner];
            if (in_order && (equal & (equal - 1)) != 0 && time != never)
                winner = first_in_order_of(state, level, place[d] & ~7u, equal, time);
            place[d] >>= 3;
            if (state.prefetches && d == D - 1) prefetch_winner(state, level, winner);
            double* const times = state.level_times[level] + (place[d] & ~7u);
            set_lane<8>(times, place[d] & 7u, time);
            row[d] = Lanes<8>::load(times);
            state.level_winners[level][place[d]] = winner;
        }
    }
}

/// Leaves a disc without an event.
template <bool in_order = false>
SWIRL_INLINE void remove(EngineState& state, std::uint32_t disc) {
    leave_rows<1, in_order>(state, {disc});
    note_first<in_order>(state);
}
/// The discs of an event.
template <bool in_order = false>
SWIRL_INLINE void remove(EngineState& state, const PendingEvent& event) {
    if (event.is_with_wall() || (in_order && event.partner >= state.size))
        leave_rows<1, in_order>(state, {event.disc});
    else
        leave_rows<2, in_order>(state, {event.partner, event.disc});
    note_first<in_order>(state);
}

/// Gives a disc that has none, or a later one, an event at the given time.
template <bool in_order = false>
SWIRL_INLINE void insert(EngineState& state, std::uint32_t disc, double time) {
    std::uint32_t place = disc;
    set_lane<8>(state.level_times[0] + (place & ~7u), place & 7u, time);
    const auto comes_first = [&](double before, std::uint32_t winner) {
        if (in_order && time == before && winner != disc)
            return is_first_in_order(pending_event(state, disc, time),
                                     pending_event(state, winner, time));
        return time < before;
    };
#pragma GCC unroll 1
    for (std::uint32_t level = 1; level < state.levels; ++level) {
        place >>= 3;
        std::uint32_t& winner = state.level_winners[level][place];
        const bool first = comes_first(state.level_times[level][place], winner);
        // In this order: the other way round the compiler branches on who is first.
        if (state.prefetches && !first) return;
        lower_lane<8>(state.level_times[level] + (place & ~7u), place & 7u, time);
        winner = chosen(first, disc, winner);
    }
    if (comes_first(state.first_time, state.first_disc)) [[unlikely]] {
        state.first_time = time;
        state.first_disc = disc;
    }
}

SWIRL_INLINE double pending_time(const EngineState& state, std::uint32_t disc) {
    return state.level_times[0][disc];
}

/// The pending event that comes first, or one of those that do.
SWIRL_INLINE PendingEvent next_pending(const EngineState& state) {
    return pending_event(state, state.first_disc, state.first_time);
}

/// Among all pending events that come at the same time as `first`, the first in order; the slow
/// way, for the rare case.
[[gnu::noinline]] static PendingEvent first_of_equals(const EngineState& state, std::uint32_t level,
                                                      std::uint32_t row, PendingEvent first) {
    const Lanes<8> times = Lanes<8>::load(state.level_times[level] + 8 * row);
    for (unsigned equal = lanes_equal(times, first.time); equal != 0; equal &= equal - 1) {
        const std::uint32_t child = 8 * row + __builtin_ctz(equal);
        if (level > 0) {
            first = first_of_equals(state, level - 1, child, first);
            continue;
        }
        const PendingEvent other = pending_event(state, child, first.time);
        if (is_first_in_order(other, first)) first = other;
    }
    return first;
}

/// If several events come at the same instant: their first, in order. The discs of the one that was
/// found have been taken out and are put back; those of the first are taken out.
template <class Search>
[[gnu::noinline]] static PendingEvent first_of_simultaneous(EngineState& state,
                                                            const PendingEvent& found,
                                                            double partner_pending) {
    insert(state, found.partner, partner_pending);
    insert(state, found.disc, found.time);
    for (;;) {
        PendingEvent first{found.time, state.size, state.size};
        for (std::uint32_t row = 0; row < state.top_rows; ++row)
            first = first_of_equals(state, state.levels - 1, row, first);
        if (state.is_valid(first)) {
            remove(state, first);
            return first;
        }
        Search::reschedule(state, first);
    }
}

/// Leaves the discs of the first event, which has been found, without any; says which is the first
/// in order, if several come at the same instant.
template <class Search>
SWIRL_INLINE PendingEvent take_first(EngineState& state, const PendingEvent& found) {
    const double partner_pending = pending_time(state, found.partner);
    // That of the partner may be another, which is taken out with it. Half of all partners have the
    // same time, so this is no branch.
    const bool is_one_event =
        (partner_pending != found.time) | (state.cold(found.partner).partner == found.disc);
    remove(state, found);
    if ((state.first_time == found.time) | !is_one_event) [[unlikely]]
        return first_of_simultaneous<Search>(state, found, partner_pending);
    if (state.prefetches && !found.is_with_wall()) prefetch_neighbours(state, found.partner);
    return found;
}

/// Gives a disc that has none a pending event.
template <bool in_order = false>
SWIRL_INLINE void insert(EngineState& state, const PendingEvent& event) {
    note_partner(state, event);
    insert<in_order>(state, event.disc, event.time);
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
