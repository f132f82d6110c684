// Speed only, changes no bit: the search for a few discs. No lists, no cells, everybody's contact
// with everybody.
//
// Up to `SideBySide::most` discs stand side by side in columns, eight to a vector. When two have
// collided, one pass over the columns finds whom each of them meets next; that costs less than
// keeping a list up to date where the discs are few and wander far. The wall is kept apart from the
// meetings, so a corner of the path renews one column and nothing else.
//
// Included by one file per vector width, like event_loop.hpp, and under the same rule. Columns are
// read and written by whole vectors only: a number written into a vector that is then read whole
// would wait for the store to leave the processor's store buffer.
#pragma once

#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/engine/neighbors/engine_state_checks.hpp"
#include "swirl/engine/neighbors/prediction.hpp"
#include "swirl/engine/neighbors/wall_times.hpp"
#include "swirl/engine/pending_event.hpp"
#include "swirl/math/lanes.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {
namespace all_pairs {

using Eight = Lanes<8>;

SWIRL_INLINE Others<8> load_eight(const Columns& all, int group) {
    const int k = 8 * group;
    return {{{Eight::load(all.x + k), Eight::load(all.y + k)},
             {Eight::load(all.vx + k), Eight::load(all.vy + k)},
             Eight::load(all.time + k)},
            Eight::load(all.radius + k)};
}

SWIRL_INLINE void set(double* column, std::uint32_t i, double x) {
    set_lane<8>(column + (i & ~7u), i & 7u, x);
}

SWIRL_INLINE void copy(EngineState& state, std::uint32_t i) {
    const HotDisc& disc = state.discs[i];
    Columns& all = *state.columns;
    set(all.x, i, disc.position.x);
    set(all.y, i, disc.position.y);
    set(all.vx, i, disc.velocity.x);
    set(all.vy, i, disc.velocity.y);
    set(all.time, i, disc.time);
}

/// Whom D discs meet first, asked at time t. Says when the first of them does.
template <int G, Held held, int D>
SWIRL_INLINE double predict_meetings(EngineState& state, const std::uint32_t (&who)[D], double t) {
    Eight contact[D][G];
    for (int g = 0; g < G; ++g) {
        const Others<8> others = load_eight(*state.columns, g);
        for (int d = 0; d < D; ++d)
            contact[d][g] = contact_times<held>(state.discs[who[d]], others, t);
    }
    double first = never;
    for (int d = 0; d < D; ++d) {
        Eight minimum = contact[d][0];
        for (int g = 1; g < G; ++g) minimum = smaller(minimum, contact[d][g]);
        const double time = smallest(minimum);
        // Where nobody is met all lanes are equal, and the first will do.
        const std::uint64_t equal = lanes_equal(contact[d], time);
        note_partner(state, {time, who[d], static_cast<std::uint32_t>(__builtin_ctzll(equal))});
        set(state.columns->meeting, who[d], time);
        first = smaller(first, time);
    }
    return first;
}

/// On a turning leg: not before when the first of discs that have just collided meets the wall.
template <int G, int D>
SWIRL_INLINE double predict_turning_wall(EngineState& state, const std::uint32_t (&who)[D],
                                         double t) {
    Columns& all = *state.columns;
    const bool is_kept = D == 1 || G == 1;
    const Flight<double> centre = is_kept ? turning_centre_at(state, t) : container_near(state, t);
    const Lanes<2> time = earliest_wall_times<D>(state, centre, who);
    for (int d = 0; d < D; ++d) {
        if (is_kept) all.centre[who[d]] = centre;
        set(all.wall, who[d], lane(time, d));
        all.wall_is_earliest |= std::uint64_t{1} << who[d];
    }
    return smallest(time);
}
/// When a disc that has just collided, at time t, meets the wall.
template <int G>
SWIRL_INLINE double predict_wall(EngineState& state, const std::uint32_t (&who)[1], double t) {
    if (state.on_turning_segment()) [[unlikely]]
        return predict_turning_wall<G>(state, who, t);
    const double time = wall_time(state, who[0]);
    set(state.columns->wall, who[0], time);
    return time;
}
/// When the first of two does.
template <int G>
SWIRL_INLINE double predict_wall(EngineState& state, const std::uint32_t (&who)[2], double t) {
    if (state.on_turning_segment()) [[unlikely]]
        return predict_turning_wall<G>(state, who, t);
    const Lanes<2> time = wall_times_from_now(state, state.discs[who[0]], state.discs[who[1]], t);
    set(state.columns->wall, who[0], lane(time, 0));
    set(state.columns->wall, who[1], lane(time, 1));
    return smaller(lane(time, 0), lane(time, 1));
}

template <int G>
SWIRL_INLINE void predict_all_walls(EngineState& state) {
    Columns& all = *state.columns;
    const bool turning = state.on_turning_segment();
    all.wall_is_earliest = turning ? ~std::uint64_t{0} : 0;
    all.walls_asked_at = state.clock;
    if (turning) {
        // Of those who collided before, who are on the leg from now on.
        const Flight<double> centre = turning_centre_at(state, state.clock);
        for (std::uint32_t i = 0; i < state.size; ++i) all.centre[i] = centre;
    }
    for (int g = 0; g < G; ++g) {
        const Others<8> discs = load_eight(all, g);
        const Eight time = soonest_wall_times<8>(state, discs.flight, discs.radius, state.clock);
        larger(time, Eight::load(all.nobody + 8 * g)).store(all.wall + 8 * g);
    }
}
/// Disc i is the first, and not before `time` at the wall of a turning leg. If everybody was asked
/// some while ago, all are asked again from then on, as nothing happens before; most of those that
/// come near the wall meet somebody else before they are there. Then when disc i is at the wall.
template <int G>
[[gnu::noinline]] static void ask_wall_again(EngineState& state, std::uint32_t i, double time) {
    Columns& all = *state.columns;
    const Eight then(time);
    if (time - all.walls_asked_at > 0.5 * state.turning_bound.horizon) {
        all.walls_asked_at = time;
        const Flight<double> centre = container_near(state, time);
        for (int g = 0; g < G; ++g) {
            const Others<8> discs = load_eight(all, g);
            const Eight no_sooner = earliest_wall_times<8>(
                state, centre, discs.flight.position_at(then), discs.flight.velocity, discs.radius);
            // What is known better stays.
            larger(no_sooner, Eight::load(all.wall + 8 * g)).store(all.wall + 8 * g);
        }
        return;
    }
    set(all.wall, i, never);
    Eight minimum = Eight(state.segments[state.segment].end);
    for (int g = 0; g < G; ++g)
        minimum = smaller(minimum,
                          smaller(Eight::load(all.meeting + 8 * g), Eight::load(all.wall + 8 * g)));
    const WallContact contact = seek_wall(
        state, i, all.centre[i], smallest(minimum) + state.turning_bound.horizon * (1.0 / 16.0));
    set(all.wall, i, contact.time);
    if (!contact.is_later) all.wall_is_earliest &= ~(std::uint64_t{1} << i);
}

/// Of the events at one instant, that of the discs whose bits are set, the first.
SWIRL_INLINE PendingEvent first_in_order(const EngineState& state, double time,
                                         std::uint64_t meetings, std::uint64_t walls) {
    PendingEvent first{time, state.size, state.size};
    if (walls != 0) first.disc = first.partner = static_cast<std::uint32_t>(__builtin_ctzll(walls));
    for (; meetings != 0; meetings &= meetings - 1) {
        const auto i = static_cast<std::uint32_t>(__builtin_ctzll(meetings));
        const PendingEvent meeting{time, i, state.cold(i).partner};
        if (is_first_in_order(meeting, first)) first = meeting;
    }
    return first;
}

/// Looks at everybody's pending meeting and wall contact and writes down which comes first.
template <int G>
SWIRL_INLINE void find_next(EngineState& state) {
    Columns& all = *state.columns;
    for (;;) {
        Eight meeting[G], wall[G];
        for (int g = 0; g < G; ++g) {
            meeting[g] = Eight::load(all.meeting + 8 * g);
            wall[g] = Eight::load(all.wall + 8 * g);
        }
        Eight minimum = smaller(meeting[0], wall[0]);
        for (int g = 1; g < G; ++g) minimum = smaller(minimum, smaller(meeting[g], wall[g]));
        const double time = smallest(minimum);
        const std::uint64_t walls = lanes_equal(wall, time);
        // Who comes after the leg's end need not be known.
        if (!(time < state.segments[state.segment].end)) {
            all.next = {time, state.size, state.size};
            return;
        }
        if ((walls & all.wall_is_earliest) == 0) [[likely]] {
            all.next = first_in_order(state, time, lanes_equal(meeting, time), walls);
            return;
        }
        ask_wall_again<G>(state, __builtin_ctzll(walls & all.wall_is_earliest), time);
    }
}

template <int G>
[[gnu::noinline]] static void predict_all(EngineState& state) {
    for (std::uint32_t i = 0; i < state.size; ++i) copy(state, i);
    for (std::uint32_t i = 0; i < state.size; ++i)
        predict_meetings<G, Held::for_a_while, 1>(state, {i}, state.clock);
    predict_all_walls<G>(state);
    find_next<G>(state);
}

template <int G>
SWIRL_INLINE void segment_ended(EngineState& state) {
    if (state.segment == 0) return predict_all<G>(state);
    predict_all_walls<G>(state);
    find_next<G>(state);
}

SWIRL_INLINE void remove(Columns& all, std::uint32_t i) {
    set(all.meeting, i, never);
    set(all.wall, i, never);
}

}  // namespace all_pairs

/// For up to 8 G discs.
template <int G>
struct AllPairs {
    SWIRL_INLINE static void start(EngineState& state) { all_pairs::predict_all<G>(state); }

    SWIRL_INLINE static PendingEvent next(const EngineState& state) { return state.columns->next; }
    SWIRL_INLINE static void reschedule(EngineState& state, const PendingEvent& event) {
        ++state.invalidated;
        all_pairs::predict_meetings<G, Held::for_a_while, 1>(state, {event.disc}, event.time);
        all_pairs::find_next<G>(state);
    }
    /// What comes next is mostly known before the discs that now
    /// collide have been predicted: the first of all others' events.
    SWIRL_INLINE static PendingEvent remove(EngineState& state, const PendingEvent& event) {
        all_pairs::remove(*state.columns, event.disc);
        if (!event.is_with_wall()) all_pairs::remove(*state.columns, event.partner);
        all_pairs::find_next<G>(state);
        return event;
    }
    template <int D>
    SWIRL_INLINE static void predict_changed(EngineState& state, const std::uint32_t (&who)[D],
                                             double t) {
        for (int d = 0; d < D; ++d) all_pairs::copy(state, who[d]);
        const double wall = all_pairs::predict_wall<G>(state, who, t);
        const double meeting = all_pairs::predict_meetings<G, Held::since_now, D>(state, who, t);
        if (smaller(meeting, wall) <= state.columns->next.time) [[unlikely]]
            all_pairs::find_next<G>(state);
    }
    SWIRL_INLINE static void check(const EngineState& state, double) { check_columns(state); }
    SWIRL_INLINE static void segment_ended(EngineState& state, double) {
        all_pairs::segment_ended<G>(state);
    }
};

}  // namespace SWIRL_TARGET
}  // namespace swirl
