// What every collision must keep (internal_check.hpp): the discs touch; momentum, linear and
// angular, is conserved; energy does not grow, in the frame of the wall where there is one, and
// falls by what the impulses work.
//
// Included by one file per vector width, like event_loop.hpp, and under the same rule.
#pragma once

#include "swirl/math/lanes.hpp"
#include "swirl/physics/collision_law.hpp"
#include "swirl/simulation/internal_check.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// Rounding errors of positions are 10⁻¹³ and of what follows from them not much larger; what is
/// wrong is wrong by far more.
inline constexpr double allowed_rounding = 1e-10;

SWIRL_INLINE bool is_rounding(double error, double scale) {
    return magnitude(error) <= allowed_rounding * scale;
}

/// A body before and after a collision, seen from a frame that moves with a velocity of its own.
/// The wall, whose mass is infinite, has no energy in its own frame and gains none.
struct Collided {
    Body before, after;
    Vec2 frame;

    SWIRL_INLINE bool is_wall() const { return before.inverse_mass == 0.0; }
    SWIRL_INLINE Vec2 gain_of_momentum() const {
        if (is_wall()) return {0.0, 0.0};
        return (1.0 / before.inverse_mass) * (after.velocity - before.velocity);
    }
    SWIRL_INLINE double gain_of_spin() const {
        if (is_wall()) return 0.0;
        return (after.spin - before.spin) / before.inverse_inertia;
    }
    SWIRL_INLINE double momentum() const {
        if (is_wall()) return 0.0;
        const Vec2 v = before.velocity - frame;
        return square_root(dot(v, v)) / before.inverse_mass;
    }
    SWIRL_INLINE double speed() const { return square_root(dot(before.velocity, before.velocity)); }
    SWIRL_INLINE double energy(const Body& body) const {
        if (is_wall()) return 0.0;
        const Vec2 v = body.velocity - frame;
        return 0.5 * (dot(v, v) / body.inverse_mass + body.spin * body.spin / body.inverse_inertia);
    }
};

/// The energy that both impulses bring: with u the speed of approach and m_n, m_t the effective
/// masses, −u J_n + J_n²/2m_n along the normal and slip J_t + J_t²/2m_t along the tangent.
SWIRL_INLINE double work_of(const Impulse& J, const Body& i, const Body& j, const Vec2& normal) {
    const Vec2 tangent{normal.y, -normal.x};
    const Vec2 relative = j.velocity - i.velocity;
    const double approach = -dot(relative, normal);
    const double slip = dot(relative, tangent) + i.radius * i.spin + j.radius * j.spin;
    const double inverse_masses = i.inverse_mass + j.inverse_mass;
    const double inverse_tangential = inverse_masses + i.radius * i.radius * i.inverse_inertia +
                                      j.radius * j.radius * j.inverse_inertia;
    return J.normal * (0.5 * J.normal * inverse_masses - approach) +
           J.tangential * (0.5 * J.tangential * inverse_tangential + slip);
}

[[maybe_unused]] static void check_energy(const Collided& i, const Collided& j, const Vec2& normal,
                                          const Surface& surface, const Impulse& J) {
    const double before = i.energy(i.before) + j.energy(j.before);
    const double after = i.energy(i.after) + j.energy(j.after);
    promise::friction_obeys_coulombs_law(J.normal >= 0.0 &&
                                         magnitude(J.tangential) <=
                                             surface.mu * J.normal * (1.0 + allowed_rounding));
    // Velocities are held in the lab, where a dish may be a million times as fast as its discs are
    // against each other: each is rounded to 2⁻⁵³ of its size, and moves the energy by as much
    // times the momentum. Sixteen such roundings are more than a collision has.
    const double rounded = 16.0 * 0x1p-53 * (i.speed() + j.speed()) *
                           (i.momentum() + j.momentum() + J.normal + magnitude(J.tangential));
    const double allowed = allowed_rounding * before + rounded;
    promise::energy_never_grows(after - before <= allowed);
    promise::energy_changes_by_the_work_of_the_impulses(
        magnitude(after - before - work_of(J, i.before, j.before, normal)) <= allowed);
}

/// `separation` points from i to j; `contact` is how long it is when they touch. Angular momentum
/// is taken about the centre of i, where i gains spin alone.
[[maybe_unused]] static void check_disc_collision(const Collided& i, const Collided& j,
                                                  const Vec2& separation, const Surface& surface,
                                                  const Impulse& J, bool overlapped_at_start) {
    const double distance = square_root(dot(separation, separation));
    const double contact = i.before.radius + j.before.radius;
    check_energy(i, j, (1.0 / distance) * separation, surface, J);

    const Vec2 gain = i.gain_of_momentum() + j.gain_of_momentum();
    const double scale = magnitude(J.normal) + magnitude(J.tangential) +
                         (square_root(dot(i.before.velocity, i.before.velocity)) +
                          square_root(dot(j.before.velocity, j.before.velocity))) /
                             smaller(i.before.inverse_mass, j.before.inverse_mass);
    promise::momentum_is_conserved(is_rounding(gain.x, scale) && is_rounding(gain.y, scale));

    if (overlapped_at_start) return;
    promise::discs_touch_at_contact(is_rounding(distance - contact, contact));
    const double angular =
        cross(separation, j.gain_of_momentum()) + i.gain_of_spin() + j.gain_of_spin();
    const double spins = magnitude(i.before.spin / i.before.inverse_inertia) +
                         magnitude(j.before.spin / j.before.inverse_inertia);
    promise::angular_momentum_is_conserved(is_rounding(angular, contact * scale + spins));
}

/// `from_centre` points from the centre of the container to the disc; `contact` is how long it is
/// when the disc touches the wall.
[[maybe_unused]] static void check_wall_collision(const Collided& disc, const Collided& wall,
                                                  const Vec2& from_centre, double contact,
                                                  const Surface& surface, const Impulse& J,
                                                  bool overlapped_at_start) {
    const double distance = square_root(dot(from_centre, from_centre));
    check_energy(disc, wall, (1.0 / distance) * from_centre, surface, J);
    if (overlapped_at_start) return;
    promise::discs_touch_at_contact(is_rounding(distance - contact, contact + disc.before.radius));
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
