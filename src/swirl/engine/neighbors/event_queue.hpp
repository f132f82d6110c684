// Speed only; results stay bitwise identical. The event queue: it finds the disc whose pending
// event comes first. It is a tournament of eight. Level 0 holds the time of each disc's pending
// event, in rows of eight. Each level above holds the winner of each row below. A row is one
// vector, so the winner of eight takes one pass of `smaller`. The top level has up to eight rows.
//
// The discs of an event are removed before it is executed, and the first of the remaining events is
// stored. The discs are inserted again after their next events have been predicted. A new event
// rarely comes first of all, so the processor predicts that branch correctly. It can start with the
// next event while the predictions are still being computed.
//
// Which disc wins a row is unpredictable, so rows are updated without a branch, on all levels. With
// many discs that would be too much work, most of it useless. There, an update stops at the first
// row that the disc does not win.
//
// Rows are read and written as whole vectors. A narrow store into a row that is then read as a
// vector would have to leave the processor's store buffer first.
//
// Two equal times mostly belong to both partners of one collision, each with that collision as its
// pending event. If the events differ, their order decides (pending_event.hpp). Among discs this is
// rare and resolved when it happens. If the floor changes its velocity, hundreds of undisturbed
// rolling spheres begin to roll again at the same instant. In their tournament the winner of a row
// is therefore the first in order (`in_order`).
//
// Every function takes the state of the search, which has a member `queue`.
#pragma once

#include "swirl/engine/neighbors/prediction.hpp"
#include "swirl/engine/neighbors/search_states.hpp"
#include "swirl/engine/pending_event.hpp"
#include "swirl/math/lanes.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

// ---- Prefetching: with many discs, most data that an event needs are far away in memory.

SWIRL_INLINE void prefetch(const void* p) { __builtin_prefetch(p, 1, 3); }

/// Fetches what a prediction for disc i will read: the discs on its list.
SWIRL_INLINE void prefetch_neighbours(const VerletListsState& state, std::uint32_t i) {
    const std::uint32_t* const list = state.cold(i).neighbours();
    for (int k = 0; k < 8; ++k) prefetch(&state.discs[list[k]]);
}
/// Or its cell and the eight around it.
SWIRL_INLINE void prefetch_neighbours(const LinkedCellsState& state, std::uint32_t i) {
    const std::uint32_t side = state.grid.cells_per_side;
    const Cell* row = state.cells + state.positions[i].cell - side - 1;
    for (int y = 0; y < 3; ++y, row += side) {
        prefetch(row);
        prefetch(row + 2);
    }
}

SWIRL_INLINE const void* region_of(const VerletListsState& state, std::uint32_t i) {
    return &state.skins[i];
}
SWIRL_INLINE const void* region_of(const LinkedCellsState& state, std::uint32_t i) {
    return &state.positions[i];
}
/// Fetches what an event of disc i will read and write, and its entries in the queue.
template <class State>
SWIRL_INLINE void prefetch_disc(const State& state, std::uint32_t i) {
    prefetch(&state.discs[i]);
    prefetch(&state.cold(i));
    prefetch(region_of(state, i));
    prefetch(state.queue.level_times[0] + i);
    prefetch(state.queue.level_times[1] + (i >> 3));
    prefetch(state.queue.level_winners[1] + (i >> 3));
}

/// A disc that has won all rows but the last will soon have the next event: its own data is fetched
/// then. The data of its partner and of its neighbours is fetched when it is among the last eight.
template <class State>
SWIRL_INLINE void prefetch_winner(const State& state, std::uint32_t level, std::uint32_t winner) {
    if (level + 2 == state.queue.levels) {
        prefetch_disc(state, winner);
    } else if (level + 1 == state.queue.levels) {
        prefetch_neighbours(state, winner);
        // Without a branch, because whether the partner is a mark is unpredictable.
        const std::uint32_t partner = state.cold(winner).partner;
        prefetch_disc(state, chosen(partner < state.size, partner, state.size));
    }
}

// ---- The queue

/// Leaves all discs without an event.
template <class State>
SWIRL_INLINE void clear_queue(State& state) {
    EventQueue& queue = state.queue;
    for (std::uint32_t level = 0; level < queue.levels; ++level) {
        const std::uint32_t rows = ((state.size - 1) >> (3 * (level + 1))) + 1;
        for (std::uint32_t k = 0; k < 8 * rows; ++k) {
            queue.level_times[level][k] = never;
            if (level > 0) queue.level_winners[level][k] = (k << (3 * level)) % state.size;
        }
    }
    queue.first_time = never;
    queue.first_disc = 0;
}

SWIRL_INLINE PendingEvent pending_event(const EngineState& state, std::uint32_t disc, double time) {
    return {time, disc, state.cold(disc).partner};
}
/// Returns the disc whose event is first in order, among the entries of a row whose bits are set in
/// `equal`. The row belongs to the level below `level` and begins at index `row`.
template <class State>
[[gnu::noinline]] static std::uint32_t first_in_order_of(const State& state, std::uint32_t level,
                                                         std::uint32_t row, std::uint64_t equal,
                                                         double time) {
    PendingEvent first{time, state.size, the_floor};
    for (; equal != 0; equal &= equal - 1) {
        const std::uint32_t index = row + static_cast<std::uint32_t>(__builtin_ctzll(equal));
        const std::uint32_t disc = level > 1 ? state.queue.level_winners[level - 1][index] : index;
        const PendingEvent other = pending_event(state, disc, time);
        if (is_first_in_order(other, first)) first = other;
    }
    return first.disc;
}

/// Stores which event comes first of all, for a top level of `Rows` rows.
template <int Rows, bool in_order, class State>
SWIRL_INLINE void update_first_of_rows(State& state) {
    EventQueue& queue = state.queue;
    const std::uint32_t top = queue.levels - 1;
    Lanes<8> rows[Rows];
    for (int row = 0; row < Rows; ++row)
        rows[row] = Lanes<8>::load(queue.level_times[top] + 8 * row);
    Lanes<8> minimum = rows[0];
    for (int row = 1; row < Rows; ++row) minimum = smaller(minimum, rows[row]);
    const double time = smallest(minimum);
    const std::uint64_t equal = lanes_equal(rows, time);
    const auto lane = static_cast<std::uint32_t>(__builtin_ctzll(equal));
    std::uint32_t disc = top == 0 ? lane : queue.level_winners[top][lane];
    if (in_order && (equal & (equal - 1)) != 0 && time != never)
        disc = first_in_order_of(state, top + 1, 0, equal, time);
    queue.first_time = time;
    queue.first_disc = disc;
}

/// Stores which event comes first of all.
template <bool in_order = false, class State>
SWIRL_INLINE void update_first(State& state) {
    switch (state.queue.top_rows) {
        case 1:
            return update_first_of_rows<1, in_order>(state);
        case 2:
            return update_first_of_rows<2, in_order>(state);
        case 4:
            return update_first_of_rows<4, in_order>(state);
        case 6:
            return update_first_of_rows<6, in_order>(state);
        default:
            update_first_of_rows<max_top_rows, in_order>(state);
    }
}

/// Fills all levels above level 0, which must hold the times of all discs.
template <class State>
SWIRL_INLINE void run_tournament(State& state) {
    EventQueue& queue = state.queue;
    for (std::uint32_t level = 1; level < queue.levels; ++level) {
        const std::uint32_t rows = ((state.size - 1) >> (3 * level)) + 1;
        for (std::uint32_t row = 0; row < rows; ++row) {
            const Lanes<8> times = Lanes<8>::load(queue.level_times[level - 1] + 8 * row);
            const double time = smallest(times);
            const std::uint32_t index = 8 * row + __builtin_ctz(lanes_equal(times, time));
            queue.level_times[level][row] = time;
            queue.level_winners[level][row] =
                level > 1 ? queue.level_winners[level - 1][index] : index;
        }
    }
    update_first(state);
}

/// Removes one disc or two from level 0 and updates the winners above. If both discs share a row,
/// the second update reads what the first has written, and overwrites it.
template <int D, bool in_order, class State>
SWIRL_INLINE void leave_rows(State& state, const std::uint32_t (&ids)[D]) {
    EventQueue& queue = state.queue;
    Lanes<8> row[D];
    std::uint32_t index[D];
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        index[d] = ids[d];
        double* const times = queue.level_times[0] + (index[d] & ~7u);
        set_lane<8>(times, index[d] & 7u, never);
        row[d] = Lanes<8>::load(times);
    }
    for (std::uint32_t level = 1; level < queue.levels; ++level) {
#pragma GCC unroll 2
        for (int d = 0; d < D; ++d) {
            const double time = smallest(row[d]);
            const unsigned equal = lanes_equal(row[d], time);
            std::uint32_t winner = (index[d] & ~7u) + __builtin_ctz(equal);
            if (level > 1) winner = queue.level_winners[level - 1][winner];
            if constexpr (in_order) {
                if ((equal & (equal - 1)) != 0 && time != never)
                    winner = first_in_order_of(state, level, index[d] & ~7u, equal, time);
            } else {
                if (queue.prefetches && d == D - 1) prefetch_winner(state, level, winner);
            }
            index[d] >>= 3;
            double* const times = queue.level_times[level] + (index[d] & ~7u);
            set_lane<8>(times, index[d] & 7u, time);
            row[d] = Lanes<8>::load(times);
            queue.level_winners[level][index[d]] = winner;
        }
    }
}

/// Removes the pending event of one disc.
template <bool in_order = false, class State>
SWIRL_INLINE void remove(State& state, std::uint32_t disc) {
    leave_rows<1, in_order>(state, {disc});
    update_first<in_order>(state);
}
/// Removes the pending events of all discs that take part in `event`.
template <bool in_order = false, class State>
SWIRL_INLINE void remove(State& state, const PendingEvent& event) {
    if (event.is_with_wall() || (in_order && event.partner >= state.size))
        leave_rows<1, in_order>(state, {event.disc});
    else
        leave_rows<2, in_order>(state, {event.partner, event.disc});
    update_first<in_order>(state);
}

/// Inserts the time of an event for a disc that has none, or a later one.
template <bool in_order = false, class State>
SWIRL_INLINE void insert(State& state, std::uint32_t disc, double time) {
    EventQueue& queue = state.queue;
    std::uint32_t index = disc;
    set_lane<8>(queue.level_times[0] + (index & ~7u), index & 7u, time);
    const auto comes_first = [&](double before, std::uint32_t winner) {
        if (in_order && time == before && winner != disc)
            return is_first_in_order(pending_event(state, disc, time),
                                     pending_event(state, winner, time));
        return time < before;
    };
#pragma GCC unroll 1
    for (std::uint32_t level = 1; level < queue.levels; ++level) {
        index >>= 3;
        std::uint32_t& winner = queue.level_winners[level][index];
        const bool first = comes_first(queue.level_times[level][index], winner);
        // In the reverse order the compiler would branch on `first`.
        if (queue.prefetches && !first) return;
        lower_lane<8>(queue.level_times[level] + (index & ~7u), index & 7u, time);
        winner = chosen(first, disc, winner);
    }
    if (comes_first(queue.first_time, queue.first_disc)) [[unlikely]] {
        queue.first_time = time;
        queue.first_disc = disc;
    }
}
/// Inserts a pending event for a disc that has none.
template <bool in_order = false, class State>
SWIRL_INLINE void insert(State& state, const PendingEvent& event) {
    store_partner(state, event);
    insert<in_order>(state, event.disc, event.time);
}

template <class State>
SWIRL_INLINE double pending_time(const State& state, std::uint32_t disc) {
    return state.queue.level_times[0][disc];
}

/// The earliest pending event; or one of them, if several come at the same time.
template <class State>
SWIRL_INLINE PendingEvent next_pending(const State& state) {
    return pending_event(state, state.queue.first_disc, state.queue.first_time);
}

// ---- Simultaneous events

/// Among all pending events at the same time as `first`, the first in order. This is the slow way,
/// for the rare case.
template <class State>
[[gnu::noinline]] static PendingEvent first_of_equals(const State& state, std::uint32_t level,
                                                      std::uint32_t row, PendingEvent first) {
    const Lanes<8> times = Lanes<8>::load(state.queue.level_times[level] + 8 * row);
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

/// Returns the first in order of several events at one instant. The discs of `found` were already
/// removed: they are inserted again, and the discs of the first event are removed instead.
template <class Search>
[[gnu::noinline]] static PendingEvent first_of_simultaneous(typename Search::State& state,
                                                            const PendingEvent& found,
                                                            double partner_pending) {
    insert(state, found.partner, partner_pending);
    insert(state, found.disc, found.time);
    for (;;) {
        PendingEvent first{found.time, state.size, state.size};
        for (std::uint32_t row = 0; row < state.queue.top_rows; ++row)
            first = first_of_equals(state, state.queue.levels - 1, row, first);
        if (state.is_valid(first)) {
            remove(state, first);
            return first;
        }
        Search::reschedule(state, first);
    }
}

/// Removes the pending events of the discs of `found`, which is the earliest event. Returns that
/// event; or the first in order, if several come at the same instant.
template <class Search>
SWIRL_INLINE PendingEvent remove_first(typename Search::State& state, const PendingEvent& found) {
    const double partner_pending = pending_time(state, found.partner);
    // The partner's pending event may be a different one, which is removed with it. Half of all
    // partners have the same time, so this is computed without a branch.
    const bool is_one_event =
        (partner_pending != found.time) | (state.cold(found.partner).partner == found.disc);
    remove(state, found);
    if ((state.queue.first_time == found.time) | !is_one_event) [[unlikely]]
        return first_of_simultaneous<Search>(state, found, partner_pending);
    if (state.queue.prefetches && !found.is_with_wall()) prefetch_neighbours(state, found.partner);
    return found;
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
