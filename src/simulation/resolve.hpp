// What an event does to the discs. When the next one comes, and between whom, is for the loop to
// find (event_loop.hpp).
#pragma once

#include "swirl/math/lanes.hpp"
#include "swirl/physics/collision_law.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/simulation/collision_checks.hpp"
#include "swirl/simulation/search/state.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

SWIRL_INLINE Body body_of(const EngineState& state, const HotDisc& d) {
    const DiscKind& kind = state.kinds[d.kind];
    return {d.velocity, d.spin, d.radius, kind.inverse_mass, kind.inverse_inertia};
}

/// Brings disc i to time t and gives it its new velocities.
SWIRL_INLINE void write_back(EngineState& state, std::uint32_t i, const Vec2& position, double t,
                             const Body& body) {
    HotDisc& disc = state.discs[i];
    state.cold(i).angle = state.cold(i).angle + (t - disc.time) * disc.spin;
    store_four(&disc.position.x, position.x, position.y, body.velocity.x, body.velocity.y);
    *reinterpret_cast<Double2*>(&disc.time) = Double2{t, disc.radius};
    disc.spin = body.spin;
    ++disc.collisions;
}

/// Discs i < j meet at time t.
SWIRL_INLINE Event collide_discs(EngineState& state, std::uint32_t i, std::uint32_t j, double t) {
    const Vec2 at_i = state.discs[i].flight().position_at(t);
    const Vec2 at_j = state.discs[j].flight().position_at(t);
    const Body before_i = body_of(state, state.discs[i]), before_j = body_of(state, state.discs[j]);
    Body body_i = before_i, body_j = before_j;
    const Vec2 s = at_j - at_i;
    const double since_last = t - larger(state.discs[i].time, state.discs[j].time);
    state.elastic_by_tc += is_elastic_by_tc_model(state.disc_surface, since_last);
    const Impulse impulse = collide(body_i, body_j, s, at_contact(state.disc_surface, since_last));
    if constexpr (internal_checks)
        check_disc_collision({before_i, body_i, before_i.velocity},
                             {before_j, body_j, before_i.velocity}, s, state.disc_surface, impulse,
                             state.overlapped_at_start);
    write_back(state, i, at_i, t, body_i);
    write_back(state, j, at_j, t, body_j);
    ++state.disc_disc;
    const double distance = square_root(dot(s, s));
    return {state.swirls,
            t,
            EventKind::disc_disc,
            i,
            j,
            {s.x / distance, s.y / distance},
            impulse,
            body_i.radius + body_j.radius - distance};
}

SWIRL_INLINE Event collide_with_wall(EngineState& state, std::uint32_t i, double t) {
    const Leg& leg = state.legs[state.leg];
    const Vec2 at = state.discs[i].flight().position_at(t);
    const Body before = body_of(state, state.discs[i]);
    Body body = before, wall = wall_body(leg.velocity_at(t));
    const Vec2 s = at - leg.position_at(t);
    const double since_last = t - state.discs[i].time;
    state.elastic_by_tc += is_elastic_by_tc_model(state.wall_surface, since_last);
    const Impulse impulse = collide(body, wall, s, at_contact(state.wall_surface, since_last));
    if constexpr (internal_checks)
        check_wall_collision({before, body, wall.velocity}, {wall, wall, wall.velocity}, s,
                             state.container_radius - body.radius, state.wall_surface, impulse,
                             state.overlapped_at_start);
    write_back(state, i, at, t, body);
    ++state.disc_wall;
    const double distance = square_root(dot(s, s));
    return {state.swirls,
            t,
            EventKind::disc_wall,
            i,
            i,
            {s.x / distance, s.y / distance},
            impulse,
            distance - (state.container_radius - body.radius)};
}

/// The container takes its next leg. With the last leg of a swirl everybody is brought up to date
/// and all clocks restart, so that times stay short and precise however long the run; state.clock
/// is then 0.
SWIRL_INLINE Event take_next_leg(EngineState& state) {
    state.clock = state.legs[state.leg].end;
    ++state.path_vertex;
    const Event event{state.swirls, state.clock, EventKind::path_vertex, 0, 0, {}, {}, 0.0};
    if (++state.leg < state.leg_count) return event;
    for (std::uint32_t i = 0; i < state.size; ++i) {
        HotDisc& disc = state.discs[i];
        state.cold(i).angle = state.cold(i).angle + (state.clock - disc.time) * disc.spin;
        disc.position = disc.flight().position_at(state.clock);
        disc.time = 0.0;
        ++disc.collisions;
    }
    state.leg = 0;
    state.clock = 0.0;
    ++state.swirls;
    return event;
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
