// Speed only, changes no bit: whom a sphere meets first, of eight others side by side, and when it
// is at the wall. What both searches of spheres share; whom to ask about is for each to say
// (few_spheres.hpp, many_spheres.hpp).
//
// Of eight contacts at once it is told which do not happen, or happen between equally accelerated
// spheres; the few that are left, mostly one or two, are quartics and solved one by one
// (contact_time.hpp).
//
// Included by one file per vector width, like event_loop.hpp, and under the same rule.
#pragma once

#include "swirl/engine/invariant.hpp"
#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/engine/pending_event.hpp"
#include "swirl/engine/resolve.hpp"
#include "swirl/math/lanes.hpp"
#include "swirl/physics/contact_time.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {
namespace spheres {

using Eight = Lanes<8>;

/// Eight of those who may be met, one behind the other.
struct alignas(64) EightOthers {
    double x[8], y[8], vx[8], vy[8], ax[8], ay[8], time[8], radius[8], rolls[8];
    std::uint32_t who[8];

    SWIRL_INLINE Parabola<Eight> flight() const {
        return {{Eight::load(x), Eight::load(y)},
                {Eight::load(vx), Eight::load(vy)},
                {Eight::load(ax), Eight::load(ay)},
                Eight::load(time)};
    }
};

SWIRL_INLINE double begins_to_roll_at(const EngineState& state, std::uint32_t i) {
    return state.spheres[i].motion.begins_to_roll;
}

/// No farther than this does a sphere get, seen from a floor of velocity u, in the time that is
/// left; and longer than it by far more than rounding, so that it does not matter how it was
/// computed.
SWIRL_INLINE double way_over_floor(const Vec2& velocity, const Vec2& acceleration, const Vec2& u,
                                   double left) {
    const Vec2 v = velocity - u;
    const double way = square_root(dot(v, v)) * left +
                       0.5 * square_root(dot(acceleration, acceleration)) * left * left;
    return way * 1.000001;
}

/// One sphere, eight times.
struct EightTimes {
    std::uint32_t i;
    Parabola<Eight> flight;
    Eight rolls, radius;

    SWIRL_INLINE EightTimes(const EngineState& state, std::uint32_t sphere)
        : i(sphere), rolls(begins_to_roll_at(state, i)), radius(state.discs[i].radius) {
        const Parabola<double> p = Spheres::flight(state, i);
        flight = {in_lanes<8>(p.position), in_lanes<8>(p.velocity), in_lanes<8>(p.acceleration),
                  Eight(p.time)};
    }
};

/// When spheres i and k meet, of whom no more is known than that it takes the quartic.
[[gnu::noinline]] static double meeting_by_quartic(const EngineState& state, std::uint32_t i,
                                                   std::uint32_t k) {
    const Encounter<double> e(Spheres::flight(state, i), Spheres::flight(state, k),
                              begins_to_roll_at(state, i), begins_to_roll_at(state, k),
                              state.discs[i].radius + state.discs[k].radius);
    return e.now + contact_on_parabolas(e.s, e.v, e.g, e.sum_of_radii, e.horizon);
}

/// The first of the contacts with the first `count` of eight, or `first` if that comes before them
/// (pending_event.hpp: the smaller partner comes before).
SWIRL_INLINE PendingEvent earlier_meeting(const EngineState& state, const EightTimes& mine,
                                          const EightOthers& others, int count,
                                          PendingEvent first) {
    const Encounter<Eight> e(mine.flight, others.flight(), mine.rolls, Eight::load(others.rolls),
                             mine.radius + Eight::load(others.radius));
    const Eight wait = e.wait_or_quartic();
    alignas(64) double times[8];
    (e.now + wait).store(times);
    for (unsigned open = lanes_equal(wait, ask_the_quartic); open != 0; open &= open - 1) {
        const int lane = __builtin_ctz(open);
        if (lane < count) times[lane] = meeting_by_quartic(state, mine.i, others.who[lane]);
    }
    for (int lane = 0; lane < count; ++lane)
        if (times[lane] < first.time ||
            (times[lane] == first.time && others.who[lane] < first.partner))
            first = {times[lane], mine.i, others.who[lane]};
    return first;
}

SWIRL_INLINE double wall_time(const EngineState& state, std::uint32_t i) {
    return time_of_wall_contact(Spheres::flight(state, i), begins_to_roll_at(state, i),
                                state.segments[state.segment],
                                state.container_radius - state.discs[i].radius);
}

/// In the build that checks: nobody overlaps, and nobody is outside.
[[maybe_unused]] static void check(const EngineState& state, double t) {
    if (state.overlapped_at_start) return;
    constexpr double rounding = 1e-10;
    for (std::uint32_t i = 0; i < state.size; ++i) {
        const Vec2 at = Spheres::position_at(state, i, t);
        const Vec2 centre = at - state.segments[state.segment].position_at(t);
        promise::no_disc_is_outside_the_container(square_root(dot(centre, centre)) +
                                                      state.discs[i].radius <=
                                                  state.container_radius * (1.0 + rounding));
        for (std::uint32_t k = i + 1; k < state.size; ++k) {
            const Vec2 s = Spheres::position_at(state, k, t) - at;
            const double contact = state.discs[i].radius + state.discs[k].radius;
            promise::no_two_discs_overlap(square_root(dot(s, s)) >= contact * (1.0 - rounding));
        }
    }
}

}  // namespace spheres
}  // namespace SWIRL_TARGET
}  // namespace swirl
