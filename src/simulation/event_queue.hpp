// Whose event comes first: a tournament of eight. Level 0 holds each disc's pending time, in rows
// of eight; each level above holds the winner of each row below. A row is one vector, so the winner
// of eight takes one pass of `smaller`, and a disc whose new time does not change its row's winner
// costs one row.
//
// The rows are read and written whole: eight bytes written into a row that is then read as a vector
// would wait for the store to leave the processor's store buffer.
//
// Two equal times: mostly both partners of one collision, each with the event on its own card. If
// they are different events, the one with the smaller first disc comes first (then the smaller
// second), so that the order of events does not depend on who found which.
#pragma once

#include "physics/lanes.hpp"
#include "simulation/machine.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

struct Next {
    double time;
    std::uint32_t disc;
};

SWIRL_INLINE void prefetch(const void* p) { __builtin_prefetch(p, 1, 3); }

/// Fetches what a prediction for disc i will read.
SWIRL_INLINE void prefetch_neighbours(const Machine& m, std::uint32_t i) {
    const std::uint32_t* const list = m.plan(i).neighbours();
    for (int k = 0; k < 8; ++k) prefetch(&m.discs[list[k]]);
}

/// In a large dish most of what an event needs is far away in memory. Who has won all rows but the
/// last is soon to come: its own lines are fetched then, and its partner and neighbours when it is
/// among the last eight.
SWIRL_INLINE void prefetch_winner(const Machine& m, std::uint32_t level, std::uint32_t winner) {
    if (level + 2 == m.levels) {
        prefetch(&m.discs[winner]);
        prefetch(&m.plan(winner));
        prefetch(&m.neighbourhoods[winner]);
    } else if (level + 1 == m.levels) {
        prefetch_neighbours(m, winner);
        const std::uint32_t partner = m.plan(winner).partner;
        if (partner >= m.size) return;
        prefetch(&m.discs[partner]);
        prefetch(&m.plan(partner));
        prefetch(&m.neighbourhoods[partner]);
        prefetch(m.level_times[0] + (partner & ~7u));
    }
}

/// Lets the row's winner be known one level up, as far as anything changes.
SWIRL_INLINE void promote(Machine& m, std::uint32_t row, double time, std::uint32_t winner) {
    for (std::uint32_t level = 1; level < m.levels; ++level) {
        double* const times = m.level_times[level] + (row & ~7u);
        std::uint32_t* const winners = m.level_winners[level] + (row & ~7u);
        if (times[row & 7u] == time && winners[row & 7u] == winner) return;
        if (m.prefetches) prefetch_winner(m, level, winner);
        const Lanes<8> card = with_lane(Lanes<8>::load(times), row & 7u, time);
        card.store(times);
        winners[row & 7u] = winner;
        time = smallest(card);
        winner = winners[__builtin_ctz(lanes_equal(card, time))];
        row >>= 3;
    }
}

SWIRL_INLINE void set_pending(Machine& m, std::uint32_t disc, double time) {
    double* const times = m.level_times[0] + (disc & ~7u);
    const Lanes<8> card = with_lane(Lanes<8>::load(times), disc & 7u, time);
    card.store(times);
    const double first = smallest(card);
    promote(m, disc >> 3, first, (disc & ~7u) + __builtin_ctz(lanes_equal(card, first)));
}

SWIRL_INLINE double pending_time(const Machine& m, std::uint32_t disc) {
    return m.level_times[0][disc];
}

/// Whether the event on i's card comes before the one on k's, both at the same time.
SWIRL_INLINE bool comes_first(const Machine& m, std::uint32_t i, std::uint32_t k) {
    const std::uint32_t pi = m.plan(i).partner, pk = m.plan(k).partner;
    const std::uint32_t i_low = i < pi ? i : pi, k_low = k < pk ? k : pk;
    if (i_low != k_low) return i_low < k_low;
    return (i < pi ? pi : i) < (k < pk ? pk : k);
}

/// Among all cards with the winning time, the first in order; the slow way, for the rare case.
[[gnu::noinline]] static std::uint32_t first_of_equals(const Machine& m, double time,
                                                       std::uint32_t level, std::uint32_t row,
                                                       std::uint32_t best) {
    const unsigned equal = lanes_equal(Lanes<8>::load(m.level_times[level] + 8 * row), time);
    for (unsigned left = equal; left != 0; left &= left - 1) {
        const std::uint32_t child = 8 * row + __builtin_ctz(left);
        if (level > 0)
            best = first_of_equals(m, time, level - 1, child, best);
        else if (best == m.size || comes_first(m, child, best))
            best = child;
    }
    return best;
}

/// The card that comes first. Along the winner's rows every lane that equals it is counted; one
/// such lane is expected where the partner holds the same event.
SWIRL_INLINE Next next_pending(const Machine& m) {
    const std::uint32_t top = m.levels - 1;
    const Lanes<8> card = Lanes<8>::load(m.level_times[top]);
    const double time = smallest(card);
    unsigned equal = lanes_equal(card, time);
    const std::uint32_t lane = __builtin_ctz(equal);
    const std::uint32_t disc = top == 0 ? lane : m.level_winners[top][lane];
    int others = __builtin_popcount(equal) - 1;
    for (std::uint32_t level = 0; level < top; ++level) {
        const double* const row = m.level_times[level] + ((disc >> (3 * level)) & ~7u);
        others += __builtin_popcount(lanes_equal(Lanes<8>::load(row), time)) - 1;
    }
    const std::uint32_t partner = m.plan(disc).partner;
    const int expected = partner < m.size && partner != disc && pending_time(m, partner) == time;
    if (others > expected) [[unlikely]]
        return {time, time == never ? disc : first_of_equals(m, time, top, 0, m.size)};
    return {time, disc};
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
