// Speed only, changes no bit: the search for a few spheres. As all_pairs.hpp does it for discs, no
// lists, no cells, everybody's contact with everybody; but spheres fly parabolas, and each has a
// third pending event, the one in which it begins to roll.
//
// On a floor everything is predicted anew with every leg, so nobody need be looked at who cannot be
// met within it. Seen from the floor, whose velocity u is constant, a sphere is at
// x + (t − t₀) v − t u = X + (t − t₀)(v − u) + ½ (t − t₀)² a with X = x − t₀ u, and until the end
// of the leg, so long as nothing happens to it, no farther from X than
//
//     |v − u| (t_end − t₀) + ½ |a| (t_end − t₀)².
//
// Two whose X are farther apart than the sum of these ways and of their radii do not meet. In a
// thirtieth of a swirl a sphere goes a fraction of its radius, so five or six are left. The ways
// are taken longer than they are by far more than rounding, so that it does not matter how they
// were computed.
//
// Included by one file per vector width, like event_loop.hpp, and under the same rule.
#pragma once

#include "swirl/engine/neighbors/all_pairs.hpp"
#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/engine/neighbors/prediction.hpp"
#include "swirl/engine/neighbors/sphere_contacts.hpp"
#include "swirl/engine/pending_event.hpp"
#include "swirl/engine/resolve.hpp"
#include "swirl/math/lanes.hpp"
#include "swirl/physics/contact_time.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {
namespace few_spheres {

using all_pairs::set;
using spheres::Eight, spheres::EightOthers, spheres::EightTimes, spheres::earlier_meeting;

/// Columns that are loaded by eights are stored by eights too (set): a wide load right behind a
/// narrow store waits for it. The others are not.
SWIRL_INLINE void copy(EngineState& state, std::uint32_t i) {
    const Parabola<double> flight = Spheres::flight(state, i);
    SphereColumns& all = *state.sphere_columns;
    all.x[i] = flight.position.x;
    all.y[i] = flight.position.y;
    all.vx[i] = flight.velocity.x;
    all.vy[i] = flight.velocity.y;
    all.ax[i] = flight.acceleration.x;
    all.ay[i] = flight.acceleration.y;
    all.time[i] = flight.time;
    all.rolls[i] = state.spheres[i].motion.begins_to_roll;
    // Without a floor a leg's end predicts nobody anew: then all must be looked at.
    if (!Spheres::feel_every_segment(state)) {
        set(all.X, i, 0.0);
        set(all.Y, i, 0.0);
        return;
    }
    const Segment& segment = state.segments[state.segment];
    const double way = spheres::way_over_floor(flight.velocity, flight.acceleration,
                                               segment.velocity, segment.end - flight.time);
    set(all.X, i, flight.position.x - flight.time * segment.velocity.x);
    set(all.Y, i, flight.position.y - flight.time * segment.velocity.y);
    set(all.reach, i, way + 0x1p-30 * state.container_radius);
}

/// Bit k is set if sphere k may be met.
template <int G>
SWIRL_INLINE std::uint64_t within_reach(const EngineState& state, std::uint32_t i) {
    const SphereColumns& all = *state.sphere_columns;
    const Eight X(all.X[i]), Y(all.Y[i]), near(all.reach[i] + all.radius[i]);
    Eight beyond[G];
    for (int g = 0; g < G; ++g) {
        const int k = 8 * g;
        const Eight dx = Eight::load(all.X + k) - X, dy = Eight::load(all.Y + k) - Y;
        const Eight maximum = near + (Eight::load(all.reach + k) + Eight::load(all.radius + k));
        beyond[g] = larger(dx * dx + dy * dy - maximum * maximum, Eight(0.0));
    }
    const std::uint64_t everybody = ~std::uint64_t{0} >> (64 - state.size);
    return lanes_equal(beyond, 0.0) & everybody & ~(std::uint64_t{1} << i);
}

SWIRL_INLINE void put(EightOthers& others, int lane, const SphereColumns& all, std::uint32_t k) {
    others.x[lane] = all.x[k];
    others.y[lane] = all.y[k];
    others.vx[lane] = all.vx[k];
    others.vy[lane] = all.vy[k];
    others.ax[lane] = all.ax[k];
    others.ay[lane] = all.ay[k];
    others.time[lane] = all.time[k];
    others.radius[lane] = all.radius[k];
    others.rolls[lane] = all.rolls[k];
    others.who[lane] = k;
}

/// Whom sphere i meets first. Says when. (Not inlined, here and below: a call is nothing beside it,
/// and the loops are compiled in a third of the time.)
template <int G>
[[gnu::noinline]] static double predict_meeting(EngineState& state, std::uint32_t i) {
    SphereColumns& all = *state.sphere_columns;
    const EightTimes mine(state, i);
    PendingEvent first{never, i, 0};
    for (std::uint64_t left = within_reach<G>(state, i); left != 0;) {
        EightOthers others;
        int count = 0;
        for (; left != 0 && count < 8; left &= left - 1, ++count)
            put(others, count, all, static_cast<std::uint32_t>(__builtin_ctzll(left)));
        for (int lane = count; lane < 8; ++lane) put(others, lane, all, others.who[0]);
        first = earlier_meeting(state, mine, others, count, first);
    }
    note_partner(state, first);
    all.meeting[i] = first.time;
    return first.time;
}

[[gnu::noinline]] static void predict_wall(EngineState& state, std::uint32_t i) {
    state.sphere_columns->wall[i] = spheres::wall_time(state, i);
}

/// Of the meeting, the wall and the beginning to roll, what comes first.
SWIRL_INLINE double note_first(EngineState& state, std::uint32_t i) {
    SphereColumns& all = *state.sphere_columns;
    const double first = smaller(smaller(all.meeting[i], all.wall[i]), all.rolls[i]);
    set(all.first, i, first);
    return first;
}

/// Of the events at one instant, that of the spheres whose bits are set, the first.
SWIRL_INLINE PendingEvent first_in_order(const EngineState& state, double time,
                                         std::uint64_t meetings, std::uint64_t walls,
                                         std::uint64_t rolls) {
    const PendingEvent first = all_pairs::first_in_order(state, time, meetings, walls);
    if (rolls == 0) return first;
    const PendingEvent roll{time, static_cast<std::uint32_t>(__builtin_ctzll(rolls)), the_floor};
    return is_first_in_order(roll, first) ? roll : first;
}

/// Looks at everybody's pending events and writes down which comes first.
template <int G>
[[gnu::noinline]] static void find_next(EngineState& state) {
    SphereColumns& all = *state.sphere_columns;
    Eight first[G];
    for (int g = 0; g < G; ++g) first[g] = Eight::load(all.first + 8 * g);
    Eight minimum = first[0];
    for (int g = 1; g < G; ++g) minimum = smaller(minimum, first[g]);
    const double time = smallest(minimum);
    all.next = {time, state.size, state.size};
    // Who comes after the leg's end need not be known.
    if (!(time < state.segments[state.segment].end)) return;
    std::uint64_t meetings = 0, walls = 0, rolls = 0;
    for (std::uint64_t equal = lanes_equal(first, time); equal != 0; equal &= equal - 1) {
        const int i = __builtin_ctzll(equal);
        meetings |= std::uint64_t{all.meeting[i] == time} << i;
        walls |= std::uint64_t{all.wall[i] == time} << i;
        rolls |= std::uint64_t{all.rolls[i] == time} << i;
    }
    all.next = first_in_order(state, time, meetings, walls, rolls);
}

template <int G>
[[gnu::noinline]] static void predict_all(EngineState& state) {
    for (std::uint32_t i = 0; i < state.size; ++i) copy(state, i);
    for (std::uint32_t i = 0; i < state.size; ++i) {
        predict_meeting<G>(state, i);
        predict_wall(state, i);
        note_first(state, i);
    }
    find_next<G>(state);
}

SWIRL_INLINE void remove(SphereColumns& all, std::uint32_t i) {
    all.meeting[i] = all.wall[i] = all.rolls[i] = never;
    set(all.first, i, never);
}

}  // namespace few_spheres

/// For up to 8 G spheres.
template <int G>
struct FewSpheres {
    using Bodies = Spheres;

    SWIRL_INLINE static void start(EngineState& state) { few_spheres::predict_all<G>(state); }

    SWIRL_INLINE static PendingEvent next(const EngineState& state) {
        return state.sphere_columns->next;
    }
    SWIRL_INLINE static void reschedule(EngineState& state, const PendingEvent& event) {
        ++state.invalidated;
        few_spheres::predict_meeting<G>(state, event.disc);
        few_spheres::note_first(state, event.disc);
        few_spheres::find_next<G>(state);
    }
    /// What comes next is mostly known before the spheres that now collide have been predicted: the
    /// first of all others' events.
    SWIRL_INLINE static PendingEvent remove(EngineState& state, const PendingEvent& event) {
        SphereColumns& all = *state.sphere_columns;
        few_spheres::remove(all, event.disc);
        if (event.partner < state.size && !event.is_with_wall())
            few_spheres::remove(all, event.partner);
        few_spheres::find_next<G>(state);
        return event;
    }
    template <int D>
    SWIRL_INLINE static void predict_changed(EngineState& state, const std::uint32_t (&who)[D],
                                             double) {
        double first = never;
        for (int d = 0; d < D; ++d) few_spheres::copy(state, who[d]);
        for (int d = 0; d < D; ++d) {
            few_spheres::predict_wall(state, who[d]);
            few_spheres::predict_meeting<G>(state, who[d]);
            first = smaller(first, few_spheres::note_first(state, who[d]));
        }
        if (first <= state.sphere_columns->next.time) few_spheres::find_next<G>(state);
    }
    SWIRL_INLINE static void segment_ended(EngineState& state, double) {
        if (state.segment == 0 || Spheres::feel_every_segment(state))
            return few_spheres::predict_all<G>(state);
        for (std::uint32_t i = 0; i < state.size; ++i) {
            few_spheres::predict_wall(state, i);
            few_spheres::note_first(state, i);
        }
        few_spheres::find_next<G>(state);
    }
    static void check(const EngineState& state, double t) { spheres::check(state, t); }
};

}  // namespace SWIRL_TARGET
}  // namespace swirl
