// Speed only; results stay bitwise identical. Code that both searches for spheres share: the first
// contact of a sphere with eight others, and its contact with the wall. The search
// (few_spheres.hpp, many_spheres.hpp) decides which spheres to test.
//
// Vector arithmetic finds which of eight contacts do not happen, or happen between equally
// accelerated spheres. The remaining ones, mostly one or two, are roots of quartics and are solved
// one by one (contact_time.hpp).
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

/// Eight candidates for a contact, as struct of arrays.
struct alignas(64) EightOthers {
    double x[8], y[8], vx[8], vy[8], ax[8], ay[8], time[8], radius[8], rolls[8];
    std::uint32_t ids[8];

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

/// An upper bound of the distance that a sphere moves in the remaining time, seen from a floor of
/// velocity u. It is enlarged by far more than rounding errors, so the way it is computed does not
/// matter.
SWIRL_INLINE double max_distance_over_floor(const Vec2& velocity, const Vec2& acceleration,
                                            const Vec2& u, double left) {
    const Vec2 v = velocity - u;
    const double distance = square_root(dot(v, v)) * left +
                            0.5 * square_root(dot(acceleration, acceleration)) * left * left;
    return distance * 1.000001;
}

/// One sphere, in all eight lanes.
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

/// The time at which spheres i and k collide, for a pair that needs the quartic.
[[gnu::noinline]] static double contact_by_quartic(const EngineState& state, std::uint32_t i,
                                                   std::uint32_t k) {
    const Encounter<double> e(Spheres::flight(state, i), Spheres::flight(state, k),
                              begins_to_roll_at(state, i), begins_to_roll_at(state, k),
                              state.discs[i].radius + state.discs[k].radius);
    return e.now + contact_on_parabolas(e.s, e.v, e.g, e.sum_of_radii, e.horizon);
}

/// The earliest contact with the first `count` of eight spheres, or `first` if that comes before.
/// If contacts are simultaneous, the one with the smaller partner comes first (pending_event.hpp).
SWIRL_INLINE PendingEvent earlier_contact(const EngineState& state, const EightTimes& mine,
                                          const EightOthers& others, int count,
                                          PendingEvent first) {
    const Encounter<Eight> e(mine.flight, others.flight(), mine.rolls, Eight::load(others.rolls),
                             mine.radius + Eight::load(others.radius));
    const Eight wait = e.wait_or_quartic();
    alignas(64) double times[8];
    (e.now + wait).store(times);
    for (unsigned open = lanes_equal(wait, needs_quartic); open != 0; open &= open - 1) {
        const int lane = __builtin_ctz(open);
        if (lane < count) times[lane] = contact_by_quartic(state, mine.i, others.ids[lane]);
    }
    for (int lane = 0; lane < count; ++lane)
        if (times[lane] < first.time ||
            (times[lane] == first.time && others.ids[lane] < first.partner))
            first = {times[lane], mine.i, others.ids[lane]};
    return first;
}

SWIRL_INLINE double wall_time(const EngineState& state, std::uint32_t i) {
    return time_of_wall_contact(Spheres::flight(state, i), begins_to_roll_at(state, i),
                                state.segments[state.segment],
                                state.container_radius - state.discs[i].radius);
}

/// Invariants (invariant.hpp): no overlap, and no sphere outside the container.
[[maybe_unused]] static void check(const EngineState& state, double t) {
    if (state.overlapped_at_start) return;
    constexpr double rounding = 1e-10;
    for (std::uint32_t i = 0; i < state.size; ++i) {
        const Vec2 at = Spheres::position_at(state, i, t);
        const Vec2 centre = at - state.segments[state.segment].position_at(t);
        invariant::no_disc_is_outside_the_container(square_root(dot(centre, centre)) +
                                                        state.discs[i].radius <=
                                                    state.container_radius * (1.0 + rounding));
        for (std::uint32_t k = i + 1; k < state.size; ++k) {
            const Vec2 s = Spheres::position_at(state, k, t) - at;
            const double contact = state.discs[i].radius + state.discs[k].radius;
            invariant::no_two_discs_overlap(square_root(dot(s, s)) >= contact * (1.0 - rounding));
        }
    }
}

}  // namespace spheres
}  // namespace SWIRL_TARGET
}  // namespace swirl
