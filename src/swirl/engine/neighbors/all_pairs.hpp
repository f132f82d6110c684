// Speed only; results stay bitwise identical. The search for a few discs: it tests all pairs,
// without lists or cells.
//
// Up to DiscColumns::maximum discs are stored in columns, eight to a vector. When two discs have
// collided, one pass over the columns finds the next contact of each. With few discs that travel
// far, this costs less than keeping lists up to date. Wall contacts have their own column, so a
// path vertex renews that column and nothing else.
//
// Columns are read and written as whole vectors only. If a part of a vector were stored alone,
// reading the whole vector would wait until the store has left the processor's store buffer.
#pragma once

#include "swirl/engine/neighbors/engine_state_checks.hpp"
#include "swirl/engine/neighbors/neighbor_search.hpp"
#include "swirl/engine/neighbors/prediction.hpp"
#include "swirl/engine/neighbors/search_states.hpp"
#include "swirl/engine/neighbors/wall_times.hpp"
#include "swirl/engine/pending_event.hpp"
#include "swirl/engine/resolve.hpp"
#include "swirl/math/lanes.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {
namespace all_pairs {

using Eight = Lanes<8>;

SWIRL_INLINE Others<8> load_eight(const DiscColumns& columns, int group) {
    const int k = 8 * group;
    return {{{Eight::load(columns.x + k), Eight::load(columns.y + k)},
             {Eight::load(columns.vx + k), Eight::load(columns.vy + k)},
             Eight::load(columns.time + k)},
            Eight::load(columns.radius + k)};
}

/// With a column in one or two of the widest registers, all of it is stored. The compiler then
/// knows the address of the store and of the next load, and keeps the column in registers in
/// between. So a prediction does not wait for the store. Longer columns or narrower registers gain
/// nothing.
template <int G = max_discs_in_columns / 8>
SWIRL_INLINE void set(double* column, std::uint32_t i, double x) {
    if constexpr (G <= 2 && Eight::parts == 1)
        for (std::uint32_t k = 0; k < 8 * G; k += 8)
            with_lane(Eight::load(column + k), i - k, x).store(column + k);
    else
        set_lane<8>(column + (i & ~7u), i & 7u, x);
}

template <int G>
SWIRL_INLINE void copy(AllPairsState& state, std::uint32_t i) {
    const HotDisc& disc = state.discs[i];
    DiscColumns& columns = state.columns;
    set<G>(columns.x, i, disc.position.x);
    set<G>(columns.y, i, disc.position.y);
    set<G>(columns.vx, i, disc.velocity.x);
    set<G>(columns.vy, i, disc.velocity.y);
    set<G>(columns.time, i, disc.time);
}

/// Predicts the first contact of D discs with another disc, at time t. Returns the earliest time.
template <int G, StateAge age, int D>
SWIRL_INLINE double predict_contacts(AllPairsState& state, const std::uint32_t (&ids)[D],
                                     double t) {
    Eight contact[D][G];
    for (int g = 0; g < G; ++g) {
        const Others<8> others = load_eight(state.columns, g);
        for (int d = 0; d < D; ++d)
            contact[d][g] = contact_times<age>(state.discs[ids[d]], others, t);
    }
    double first = never;
    for (int d = 0; d < D; ++d) {
        Eight minimum = contact[d][0];
        for (int g = 1; g < G; ++g) minimum = smaller(minimum, contact[d][g]);
        const double time = smallest(minimum);
        // Without a contact all lanes are equal; any partner will do.
        const std::uint64_t equal = lanes_equal(contact[d], time);
        store_partner(state, {time, ids[d], static_cast<std::uint32_t>(__builtin_ctzll(equal))});
        set<G>(state.columns.contact, ids[d], time);
        first = smaller(first, time);
    }
    return first;
}

/// On an arc: bounds the times when discs that have just collided, at time t, reach the wall.
/// Returns the earlier bound.
template <int G, int D>
SWIRL_INLINE double predict_wall_on_arc(AllPairsState& state, const std::uint32_t (&ids)[D],
                                        double t) {
    DiscColumns& columns = state.columns;
    const bool is_exact = D == 1 || G == 1;
    const Flight<double> centre = is_exact ? arc_centre_at(state, t) : container_near(state, t);
    const Lanes<2> time = earliest_wall_times<D>(state, centre, ids);
    for (int d = 0; d < D; ++d) {
        if (is_exact) columns.centre[ids[d]] = centre;
        set<G>(columns.wall, ids[d], lane(time, d));
        columns.wall_is_bound |= std::uint64_t{1} << ids[d];
    }
    return smallest(time);
}
/// Predicts when a disc that has just collided, at time t, reaches the wall.
template <int G>
SWIRL_INLINE double predict_wall(AllPairsState& state, const std::uint32_t (&ids)[1], double t) {
    if (state.on_arc()) [[unlikely]]
        return predict_wall_on_arc<G>(state, ids, t);
    const double time = wall_time(state, ids[0]);
    set<G>(state.columns.wall, ids[0], time);
    return time;
}
/// The same for two discs. Returns the earlier time.
template <int G>
SWIRL_INLINE double predict_wall(AllPairsState& state, const std::uint32_t (&ids)[2], double t) {
    if (state.on_arc()) [[unlikely]]
        return predict_wall_on_arc<G>(state, ids, t);
    const Lanes<2> time = wall_times_from_now(state, state.discs[ids[0]], state.discs[ids[1]], t);
    set<G>(state.columns.wall, ids[0], lane(time, 0));
    set<G>(state.columns.wall, ids[1], lane(time, 1));
    return smaller(lane(time, 0), lane(time, 1));
}

template <int G>
SWIRL_INLINE void predict_all_walls(AllPairsState& state) {
    DiscColumns& columns = state.columns;
    const bool on_arc = state.on_arc();
    columns.wall_is_bound = on_arc ? ~std::uint64_t{0} : 0;
    columns.walls_bounded_at = state.clock;
    if (on_arc) {
        // Discs that collided on an earlier segment count as being on the arc from now on.
        const Flight<double> centre = arc_centre_at(state, state.clock);
        for (std::uint32_t i = 0; i < state.size; ++i) columns.centre[i] = centre;
    }
    for (int g = 0; g < G; ++g) {
        const Others<8> discs = load_eight(columns, g);
        const Eight time = soonest_wall_times<8>(state, discs.flight, discs.radius, state.clock);
        larger(time, Eight::load(columns.padding + 8 * g)).store(columns.wall + 8 * g);
    }
}
/// Disc i has the earliest event, but `time` is only a lower bound for its contact with the wall of
/// an arc. If the bounds are older than half their horizon, all of them are renewed from `time` on,
/// since nothing happens before. Most discs that come near the wall collide with another disc
/// first. Otherwise the contact of disc i itself is computed.
template <int G>
[[gnu::noinline]] static void refine_wall(AllPairsState& state, std::uint32_t i, double time) {
    DiscColumns& columns = state.columns;
    const Eight then(time);
    if (time - columns.walls_bounded_at > 0.5 * state.arc_bound.horizon) {
        columns.walls_bounded_at = time;
        const Flight<double> centre = container_near(state, time);
        for (int g = 0; g < G; ++g) {
            const Others<8> discs = load_eight(columns, g);
            const Eight no_sooner = earliest_wall_times<8>(
                state, centre, discs.flight.position_at(then), discs.flight.velocity, discs.radius);
            // If the old bound is later, it is kept.
            larger(no_sooner, Eight::load(columns.wall + 8 * g)).store(columns.wall + 8 * g);
        }
        return;
    }
    set<G>(columns.wall, i, never);
    Eight minimum = Eight(state.segments[state.segment].end);
    for (int g = 0; g < G; ++g)
        minimum = smaller(minimum, smaller(Eight::load(columns.contact + 8 * g),
                                           Eight::load(columns.wall + 8 * g)));
    const WallContact contact = seek_wall(
        state, i, columns.centre[i], smallest(minimum) + state.arc_bound.horizon * (1.0 / 16.0));
    set<G>(columns.wall, i, contact.time);
    if (!contact.is_later) columns.wall_is_bound &= ~(std::uint64_t{1} << i);
}

/// Returns the first in order of simultaneous events; the bits select the discs.
SWIRL_INLINE PendingEvent first_in_order(const EngineState& state, double time,
                                         std::uint64_t contacts, std::uint64_t walls) {
    PendingEvent first{time, state.size, state.size};
    if (walls != 0) first.disc = first.partner = static_cast<std::uint32_t>(__builtin_ctzll(walls));
    for (; contacts != 0; contacts &= contacts - 1) {
        const auto i = static_cast<std::uint32_t>(__builtin_ctzll(contacts));
        const PendingEvent contact{time, i, state.cold(i).partner};
        if (is_first_in_order(contact, first)) first = contact;
    }
    return first;
}

/// Scans the pending contacts of all discs and stores the earliest one.
template <int G>
SWIRL_INLINE void find_next(AllPairsState& state) {
    DiscColumns& columns = state.columns;
    for (;;) {
        Eight contact[G], wall[G];
        for (int g = 0; g < G; ++g) {
            contact[g] = Eight::load(columns.contact + 8 * g);
            wall[g] = Eight::load(columns.wall + 8 * g);
        }
        Eight minimum = smaller(contact[0], wall[0]);
        for (int g = 1; g < G; ++g) minimum = smaller(minimum, smaller(contact[g], wall[g]));
        const double time = smallest(minimum);
        const std::uint64_t walls = lanes_equal(wall, time);
        // Which event comes after the end of the segment does not matter.
        if (!(time < state.segments[state.segment].end)) {
            columns.next = {time, state.size, state.size};
            return;
        }
        if ((walls & columns.wall_is_bound) == 0) [[likely]] {
            columns.next = first_in_order(state, time, lanes_equal(contact, time), walls);
            return;
        }
        refine_wall<G>(state, __builtin_ctzll(walls & columns.wall_is_bound), time);
    }
}

template <int G>
[[gnu::noinline]] static void predict_all(AllPairsState& state) {
    for (std::uint32_t i = 0; i < state.size; ++i) copy<G>(state, i);
    for (std::uint32_t i = 0; i < state.size; ++i)
        predict_contacts<G, StateAge::any, 1>(state, {i}, state.clock);
    predict_all_walls<G>(state);
    find_next<G>(state);
}

template <int G>
SWIRL_INLINE void segment_ended(AllPairsState& state) {
    if (state.segment == 0) return predict_all<G>(state);
    predict_all_walls<G>(state);
    find_next<G>(state);
}

template <int G>
SWIRL_INLINE void remove(DiscColumns& columns, std::uint32_t i) {
    set<G>(columns.contact, i, never);
    set<G>(columns.wall, i, never);
}

}  // namespace all_pairs

/// The search for up to 8 G discs.
template <int G>
struct AllPairs {
    using State = AllPairsState;
    using Bodies = Discs;

    SWIRL_INLINE static void start(AllPairsState& state) { all_pairs::predict_all<G>(state); }

    SWIRL_INLINE static PendingEvent next(const AllPairsState& state) { return state.columns.next; }
    SWIRL_INLINE static void reschedule(AllPairsState& state, const PendingEvent& event) {
        ++state.invalidated;
        all_pairs::predict_contacts<G, StateAge::any, 1>(state, {event.disc}, event.time);
        all_pairs::find_next<G>(state);
    }
    /// The earliest event of the remaining discs is found here, before the discs that now collide
    /// have been predicted. It is mostly the next event.
    SWIRL_INLINE static PendingEvent remove(AllPairsState& state, const PendingEvent& event) {
        all_pairs::remove<G>(state.columns, event.disc);
        if (!event.is_with_wall()) all_pairs::remove<G>(state.columns, event.partner);
        all_pairs::find_next<G>(state);
        return event;
    }
    template <int D>
    SWIRL_INLINE static void predict_changed(AllPairsState& state, const std::uint32_t (&ids)[D],
                                             double t) {
        for (int d = 0; d < D; ++d) all_pairs::copy<G>(state, ids[d]);
        const double wall = all_pairs::predict_wall<G>(state, ids, t);
        const double contact = all_pairs::predict_contacts<G, StateAge::now, D>(state, ids, t);
        if (smaller(contact, wall) <= state.columns.next.time) [[unlikely]]
            all_pairs::find_next<G>(state);
    }
    SWIRL_INLINE static void check(const AllPairsState& state, double) { check_columns(state); }
    SWIRL_INLINE static void segment_ended(AllPairsState& state, double) {
        all_pairs::segment_ended<G>(state);
    }
};
static_assert(NeighborSearch<AllPairs<1>>);

}  // namespace SWIRL_TARGET
}  // namespace swirl
