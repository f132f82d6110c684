// Collisions of random discs, before and after.
#pragma once

#include "measure/snapshots.hpp"
#include "swirl/physics/collision_law.hpp"

namespace swirl {

struct RandomCollision {
    Snapshot before, after;
    Event event;
};

/// Applies the collision law to two of three random discs, or to one of them and the wall. For
/// every third seed disc 0 cannot spin, for every sixth none can.
inline RandomCollision collide_at_random(std::uint64_t seed, bool wall, const Surface& surface) {
    Noise noise(seed);
    Snapshot s = empty_container(0.5 + 0.5 * noise());
    const Vec2 n = unit_circle(noise());
    const double r0 = 1.0 + 0.5 * noise(), r1 = 1.0 + 0.5 * noise();
    const Vec2 at = s.container_centre + (wall ? (s.container_radius - r0) * n : Vec2{1, 2});
    add_disc(s, at, {noise(), noise()}, noise(), r0, 2.0 + noise());
    add_disc(s, wall ? Vec2{0, 0} : at + (r0 + r1) * n, {noise(), noise()}, noise(), r1,
             2.0 + noise());
    add_disc(s, {-2.0, -3.0}, {noise(), noise()}, noise(), 1.0, 3.0);
    const auto stop_spin = [&](std::size_t i) {
        Disc disc = s.disc(i);
        disc.spin = disc.can_spin = 0.0;
        s.set(i, disc);
    };
    if (seed % 3 == 2) stop_spin(0);
    if (seed % 6 == 5) stop_spin(1);
    const Snapshot before = s;

    const auto body = [&](std::size_t i) {
        return Body{s.velocity(i), s.spin[i], s.radius[i], 1.0 / s.mass[i], s.inverse_inertia(i)};
    };
    Body bodies[] = {body(0), wall ? wall_body(s.container_velocity) : body(1)};
    const Impulse J = collide(bodies[0], bodies[1], n, surface);
    for (std::size_t i = 0; i < (wall ? 1u : 2u); ++i) {
        s.vx[i] = bodies[i].velocity.x;
        s.vy[i] = bodies[i].velocity.y;
        s.spin[i] = bodies[i].spin;
    }
    const EventKind kind = wall ? EventKind::disc_wall : EventKind::disc_disc;
    return {before, s, {0, s.clock, kind, 0, wall ? 0u : 1u, n, J, 0.0}};
}

}  // namespace swirl
