// What an event does to the discs. When the next one comes, and between whom, is for the loops to
// find (event_loop.hpp, all_pairs.hpp).
#pragma once

#include "swirl/math/lanes.hpp"
#include "swirl/physics/collision_law.hpp"
#include "swirl/physics/contact_time.hpp"
#include "swirl/simulation/search/state.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

SWIRL_INLINE Flight<double> flight_of(const HotDisc& d) { return {d.position, d.velocity, d.time}; }

SWIRL_INLINE Body body_of(const Machine& m, const HotDisc& d) {
    const DiscKind& kind = m.kinds[d.kind];
    return {d.velocity, d.spin, d.radius, kind.inverse_mass, kind.inverse_inertia};
}

/// Brings disc i to time t and gives it its new velocities.
SWIRL_INLINE void write_back(Machine& m, std::uint32_t i, const Vec2& position, double t,
                             const Body& body) {
    HotDisc& disc = m.discs[i];
    m.plan(i).angle = m.plan(i).angle + (t - disc.time) * disc.spin;
    store_four(&disc.position.x, position.x, position.y, body.velocity.x, body.velocity.y);
    *reinterpret_cast<Double2*>(&disc.time) = Double2{t, disc.radius};
    disc.spin = body.spin;
    ++disc.changes;
}

/// Discs i < j meet at time t.
SWIRL_INLINE Event collide_discs(Machine& m, std::uint32_t i, std::uint32_t j, double t) {
    const Vec2 at_i = flight_of(m.discs[i]).position_at(t);
    const Vec2 at_j = flight_of(m.discs[j]).position_at(t);
    Body body_i = body_of(m, m.discs[i]), body_j = body_of(m, m.discs[j]);
    const Vec2 s = at_j - at_i;
    const double since_last = t - larger(m.discs[i].time, m.discs[j].time);
    m.lasting += is_lasting_contact(m.disc_surface, since_last);
    const Impulse impulse = collide(body_i, body_j, s, at_contact(m.disc_surface, since_last));
    write_back(m, i, at_i, t, body_i);
    write_back(m, j, at_j, t, body_j);
    ++m.disc_disc;
    const double distance = square_root(dot(s, s));
    return {m.swirls,
            t,
            EventKind::disc_disc,
            i,
            j,
            {s.x / distance, s.y / distance},
            impulse,
            body_i.radius + body_j.radius - distance};
}

SWIRL_INLINE Event collide_with_wall(Machine& m, std::uint32_t i, double t) {
    const Leg& leg = m.legs[m.leg];
    const Vec2 at = flight_of(m.discs[i]).position_at(t);
    Body body = body_of(m, m.discs[i]), wall = wall_body(leg.velocity_at(t));
    const Vec2 s = at - leg.position_at(t);
    const double since_last = t - m.discs[i].time;
    m.lasting += is_lasting_contact(m.wall_surface, since_last);
    const Impulse impulse = collide(body, wall, s, at_contact(m.wall_surface, since_last));
    write_back(m, i, at, t, body);
    ++m.disc_wall;
    const double distance = square_root(dot(s, s));
    return {m.swirls,
            t,
            EventKind::disc_wall,
            i,
            i,
            {s.x / distance, s.y / distance},
            impulse,
            distance - (m.container_radius - body.radius)};
}

/// The container takes its next leg. With the last leg of a swirl everybody is brought up to date
/// and all clocks restart, so that times stay short and precise however long the run; m.clock is
/// then 0.
SWIRL_INLINE Event take_next_leg(Machine& m) {
    m.clock = m.legs[m.leg].end;
    ++m.path_vertex;
    const Event event{m.swirls, m.clock, EventKind::path_vertex, 0, 0, {}, {}, 0.0};
    if (++m.leg < m.leg_count) return event;
    for (std::uint32_t i = 0; i < m.size; ++i) {
        HotDisc& disc = m.discs[i];
        m.plan(i).angle = m.plan(i).angle + (m.clock - disc.time) * disc.spin;
        disc.position = flight_of(disc).position_at(m.clock);
        disc.time = 0.0;
        ++disc.changes;
    }
    m.leg = 0;
    m.clock = 0.0;
    ++m.swirls;
    return event;
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
