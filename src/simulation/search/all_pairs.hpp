// The loop for a few discs: no lists, no cells, everybody's contact with everybody.
//
// Up to `SideBySide::most` discs stand side by side in columns, eight to a vector. When two have
// collided, one pass over the columns finds whom each of them meets next; that costs less than
// keeping a list up to date where the discs are few and wander far. The rest is as in
// event_loop.hpp: each disc has one pending meeting, and one that has gone invalidated is predicted
// again when its time comes. The wall is kept apart from the meetings, so a corner of the path
// renews one column and nothing else.
//
// Included by one file per vector width, like event_loop.hpp, and under the same rule.
// AlignedMemory are read and written by whole vectors only: a number written into a vector that is
// then read whole would wait for the store to leave the processor's store buffer.
#pragma once

#include "swirl/math/lanes.hpp"
#include "swirl/physics/contact_time.hpp"
#include "swirl/simulation/resolve.hpp"
#include "swirl/simulation/search/state.hpp"
#include "swirl/simulation/search/verlet_skin.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {
namespace all_pairs {

using Eight = Lanes<8>;
using EightVectors = BasicVec2<Eight>;

SWIRL_INLINE EightVectors eight(const Vec2& a) { return {Eight(a.x), Eight(a.y)}; }

SWIRL_INLINE Flight<Eight> eight_flights(const SideBySide& all, int group) {
    const int k = 8 * group;
    return {{Eight::load(all.x + k), Eight::load(all.y + k)},
            {Eight::load(all.vx + k), Eight::load(all.vy + k)},
            Eight::load(all.time + k)};
}

SWIRL_INLINE void set(double* column, std::uint32_t i, double x) {
    double* const group = column + (i & ~7u);
    with_lane(Eight::load(group), i & 7u, x).store(group);
}

SWIRL_INLINE void copy(EngineState& state, std::uint32_t i) {
    const HotDisc& disc = state.discs[i];
    SideBySide& all = *state.side_by_side;
    set(all.x, i, disc.position.x);
    set(all.y, i, disc.position.y);
    set(all.vx, i, disc.velocity.x);
    set(all.vy, i, disc.velocity.y);
    set(all.time, i, disc.time);
}

/// Writes down disc i's first meeting, and says when; of several at the same instant, with the
/// smallest number.
template <int G>
SWIRL_INLINE double note_meeting(EngineState& state, std::uint32_t i, const Eight (&contact)[G]) {
    Eight least = contact[0];
    for (int g = 1; g < G; ++g) least = smaller(least, contact[g]);
    const double time = smallest(least);
    // Where nobody is met all lanes are equal, and the first will do.
    const auto partner = static_cast<std::uint32_t>(__builtin_ctzll(lanes_equal(contact, time)));
    ColdDisc& pending = state.cold(i);
    pending.partner = partner;
    pending.partner_collisions = state.discs[partner].collisions;
    set(state.side_by_side->meeting, i, time);
    return time;
}

/// Search disc i meets, which may have held its state for a while.
template <int G>
SWIRL_INLINE void predict(EngineState& state, std::uint32_t i) {
    const SideBySide& all = *state.side_by_side;
    const HotDisc& disc = state.discs[i];
    const Flight<Eight> mine{eight(disc.position), eight(disc.velocity), Eight(disc.time)};
    Eight contact[G];
    for (int g = 0; g < G; ++g)
        contact[g] = time_of_contact(mine, eight_flights(all, g),
                                     Eight(disc.radius) + Eight::load(all.radius + 8 * g));
    note_meeting(state, i, contact);
}

/// Search D discs meet that have just changed, at time t; none of the others holds a later state.
/// The general formula with a term that is zero left out, and the same bits. Says when the first
/// meets.
template <int G, int D>
SWIRL_INLINE double predict_changed(EngineState& state, const std::uint32_t (&who)[D], double t) {
    const SideBySide& all = *state.side_by_side;
    const Eight now(t);
    Eight contact[D][G];
    for (int g = 0; g < G; ++g) {
        const Flight<Eight> others = eight_flights(all, g);
        const EightVectors at = others.position_at(now);
        const Eight radius = Eight::load(all.radius + 8 * g);
        for (int d = 0; d < D; ++d) {
            const HotDisc& disc = state.discs[who[d]];
            contact[d][g] = now + time_until_contact(at - eight(disc.position),
                                                     others.velocity - eight(disc.velocity),
                                                     Eight(disc.radius) + radius);
        }
    }
    double first = never;
    for (int d = 0; d < D; ++d) first = smaller(first, note_meeting(state, who[d], contact[d]));
    return first;
}

/// When disc i meets the wall.
SWIRL_INLINE double predict_wall(EngineState& state, std::uint32_t i) {
    const HotDisc& disc = state.discs[i];
    const Leg& leg = state.legs[state.leg];
    const double clearance = state.container_radius - disc.radius;
    const double time =
        leg.turning != 0.0
            ? time_of_turning_wall_contact(flight_of(disc), leg, clearance)
            : time_of_wall_contact(flight_of(disc), container_flight(leg), clearance);
    set(state.side_by_side->wall, i, time);
    return time;
}

/// When the first of two discs, which have just changed at time t, meets the wall.
SWIRL_INLINE double predict_walls(EngineState& state, std::uint32_t i, std::uint32_t j, double t) {
    const Leg& leg = state.legs[state.leg];
    if (leg.turning != 0.0) [[unlikely]]
        return smaller(predict_wall(state, i), predict_wall(state, j));
    const HotDisc &a = state.discs[i], &b = state.discs[j];
    const Flight<double> container = container_flight(leg);
    const Vec2 centre = container.position_at(t);
    const auto from = [](const Vec2& p, const Vec2& q, const Vec2& origin) {
        return BasicVec2<Lanes<2>>{two_lanes(p.x, q.x) - Lanes<2>(origin.x),
                                   two_lanes(p.y, q.y) - Lanes<2>(origin.y)};
    };
    const Lanes<2> wait = time_to_leave(
        from(a.position, b.position, centre), from(a.velocity, b.velocity, container.velocity),
        Lanes<2>(state.container_radius) - two_lanes(a.radius, b.radius));
    const Lanes<2> time = Lanes<2>(t) + wait;
    set(state.side_by_side->wall, i, lane(time, 0));
    set(state.side_by_side->wall, j, lane(time, 1));
    return smaller(lane(time, 0), lane(time, 1));
}

template <int G>
SWIRL_INLINE void predict_all_walls(EngineState& state) {
    SideBySide& all = *state.side_by_side;
    if (state.legs[state.leg].turning != 0.0) {
        for (std::uint32_t i = 0; i < state.size; ++i) predict_wall(state, i);
        return;
    }
    const Flight<double> container = container_flight(state.legs[state.leg]);
    const Flight<Eight> centre{eight(container.position), eight(container.velocity),
                               Eight(container.time)};
    for (int g = 0; g < G; ++g) {
        const Eight clearance = Eight(state.container_radius) - Eight::load(all.radius + 8 * g);
        const Eight time = time_of_wall_contact(eight_flights(all, g), centre, clearance);
        larger(time, Eight::load(all.nobody + 8 * g)).store(all.wall + 8 * g);
    }
}

/// Of the events at one instant, on whose cards the bits are set, the one with the smaller first
/// disc; then the smaller second, the wall counting as the disc itself.
SWIRL_INLINE Due first_in_order(const EngineState& state, double time, std::uint64_t meetings,
                                std::uint64_t walls) {
    Due due{time, state.size, state.size, state.size};
    if (walls != 0) {
        const auto i = static_cast<std::uint32_t>(__builtin_ctzll(walls));
        due = {time, i, i, i};
    }
    for (; meetings != 0; meetings &= meetings - 1) {
        const auto i = static_cast<std::uint32_t>(__builtin_ctzll(meetings));
        const std::uint32_t k = state.cold(i).partner;
        const std::uint32_t low = i < k ? i : k, high = i < k ? k : i;
        if (low < due.i || (low == due.i && high < due.j)) due = {time, low, high, i};
    }
    return due;
}

/// Looks at all cards and writes down which comes first.
template <int G>
SWIRL_INLINE void find_due(EngineState& state) {
    SideBySide& all = *state.side_by_side;
    Eight meeting[G], wall[G];
    for (int g = 0; g < G; ++g) {
        meeting[g] = Eight::load(all.meeting + 8 * g);
        wall[g] = Eight::load(all.wall + 8 * g);
    }
    Eight least = smaller(meeting[0], wall[0]);
    for (int g = 1; g < G; ++g) least = smaller(least, smaller(meeting[g], wall[g]));
    const double time = smallest(least);
    const double end = state.legs[state.leg].end;
    all.due = time >= end ? Due{end, state.size, state.size, state.size}
                          : first_in_order(state, time, lanes_equal(meeting, time),
                                           lanes_equal(wall, time));
}

template <int G>
[[gnu::noinline]] static void renew_all(EngineState& state) {
    for (std::uint32_t i = 0; i < state.size; ++i) copy(state, i);
    for (std::uint32_t i = 0; i < state.size; ++i) predict<G>(state, i);
    predict_all_walls<G>(state);
    find_due<G>(state);
}

template <int G>
[[gnu::noinline]] static Event end_leg(EngineState& state) {
    const Event event = take_next_leg(state);
    if (state.leg == 0) {
        renew_all<G>(state);
    } else {
        predict_all_walls<G>(state);
        find_due<G>(state);
    }
    return event;
}

/// The card that comes first and is not invalidated.
template <int G>
SWIRL_INLINE Due next_due(EngineState& state) {
    for (;;) {
        const Due due = state.side_by_side->due;
        if (due.i == due.j) return due;
        const ColdDisc& pending = state.cold(due.owner);
        if (state.discs[pending.partner].collisions == pending.partner_collisions) return due;
        ++state.invalidated;
        predict<G>(state, due.owner);
        find_due<G>(state);
    }
}

/// What comes next is mostly known before the discs that now collide have been predicted: the first
/// of all others' cards.
template <int G>
SWIRL_INLINE void find_due_but_for(EngineState& state, std::uint32_t i, std::uint32_t j) {
    SideBySide& all = *state.side_by_side;
    set(all.meeting, i, never);
    set(all.wall, i, never);
    if (i != j) {
        set(all.meeting, j, never);
        set(all.wall, j, never);
    }
    find_due<G>(state);
}

template <int G>
SWIRL_INLINE Event execute(EngineState& state, const Due& due) {
    if (due.i == state.size) return end_leg<G>(state);
    state.clock = due.time;
    find_due_but_for<G>(state, due.i, due.j);
    Event event;
    double first;
    if (due.i == due.j) {
        event = collide_with_wall(state, due.i, due.time);
        copy(state, due.i);
        first =
            smaller(predict_changed<G, 1>(state, {due.i}, due.time), predict_wall(state, due.i));
    } else {
        event = collide_discs(state, due.i, due.j, due.time);
        copy(state, due.i);
        copy(state, due.j);
        first = smaller(predict_changed<G, 2>(state, {due.i, due.j}, due.time),
                        predict_walls(state, due.i, due.j, due.time));
    }
    if (first <= state.side_by_side->due.time) [[unlikely]]
        find_due<G>(state);
    return event;
}

template <int G>
static Event step_groups(EngineState& state) {
    return execute<G>(state, next_due<G>(state));
}
template <int G>
static std::uint64_t run_groups(EngineState& state, std::uint64_t count, std::int64_t swirls,
                                double clock) {
    for (std::uint64_t done = 0; done < count; ++done) {
        const Due due = next_due<G>(state);
        if (state.swirls > swirls || (state.swirls == swirls && due.time > clock)) return done;
        execute<G>(state, due);
    }
    return count;
}

/// The loop for up to 8 G discs.
template <int G>
constexpr EventLoop loop(const char* width) {
    return {width, renew_all<G>, step_groups<G>, run_groups<G>};
}

}  // namespace all_pairs

}  // namespace SWIRL_TARGET
}  // namespace swirl
