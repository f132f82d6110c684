// What must hold whatever the discs do, and how it is asked (internal_check.hpp): of every
// collision, of every event, and now and then of all discs at once.
//
// Included by one file per vector width, like event_loop.hpp, and under the same rule.
#pragma once

#include "swirl/physics/collision_law.hpp"
#include "swirl/physics/contact_time.hpp"
#include "swirl/simulation/internal_check.hpp"
#include "swirl/simulation/pending_event.hpp"
#include "swirl/simulation/search/state.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {
namespace invariant {

using namespace ::swirl::invariant;

/// Rounding errors of positions are 10⁻¹³ and of what follows from them not much larger; whatever
/// is wrong is wrong by far more.
inline constexpr double rounding = 1e-10;

SWIRL_INLINE bool is_small(double error, double scale) {
    return magnitude(error) <= rounding * scale;
}

/// A body before and after a collision.
struct Collided {
    Body before, after;

    double mass() const { return 1.0 / before.inverse_mass; }
    double moment_of_inertia() const { return 1.0 / before.inverse_inertia; }
    Vec2 gain_of_momentum() const { return mass() * (after.velocity - before.velocity); }
    double gain_of_spin() const { return moment_of_inertia() * (after.spin - before.spin); }
    /// Twice the kinetic energy, seen from a frame that moves with the given velocity.
    double twice_energy(const Body& body, const Vec2& frame) const {
        const Vec2 v = body.velocity - frame;
        return mass() * dot(v, v) + moment_of_inertia() * body.spin * body.spin;
    }
    double gain_of_energy(const Vec2& frame) const {
        return 0.5 * (twice_energy(after, frame) - twice_energy(before, frame));
    }
    double energy_scale(const Vec2& frame) const {
        return twice_energy(before, frame) + twice_energy(after, frame);
    }
};

/// What both impulses did to the energy: with u the speed of approach, m_n and m_t the effective
/// masses, −u J_n + J_n²/2m_n for the normal and slip J_t + J_t²/2m_t for the tangential one.
[[maybe_unused]] static double work_of(const Impulse& J, const Body& i, const Body& j,
                                       const Vec2& normal) {
    const Vec2 tangent{normal.y, -normal.x};
    const Vec2 relative = j.velocity - i.velocity;
    const double u = -dot(relative, normal);
    const double slip = dot(relative, tangent) + i.radius * i.spin + j.radius * j.spin;
    const double inverse_mass = i.inverse_mass + j.inverse_mass;
    const double inverse_tangential_mass = inverse_mass + i.radius * i.radius * i.inverse_inertia +
                                           j.radius * j.radius * j.inverse_inertia;
    return -u * J.normal + 0.5 * J.normal * J.normal * inverse_mass + slip * J.tangential +
           0.5 * J.tangential * J.tangential * inverse_tangential_mass;
}

[[maybe_unused]] static void check_friction(const Impulse& J, const Surface& surface) {
    friction_is_within_coulombs_cone(
        J.normal >= 0.0 && magnitude(J.tangential) <= surface.mu * J.normal * (1.0 + rounding));
}

/// Two discs. Angular momentum is taken about the centre of the first: what it gains there is spin
/// alone.
[[maybe_unused]] static void check_disc_collision(const Collided& i, const Collided& j,
                                                  const Vec2& separation, const Surface& surface,
                                                  const Impulse& J, bool discs_touch) {
    const double distance = square_root(dot(separation, separation));
    const double contact = i.before.radius + j.before.radius;
    check_friction(J, surface);

    const Vec2 momentum = i.gain_of_momentum() + j.gain_of_momentum();
    const Vec2& frame = i.before.velocity;
    const double energy_scale = i.energy_scale(frame) + j.energy_scale(frame);
    const double momentum_scale = square_root(energy_scale * (i.mass() + j.mass())) +
                                  i.mass() * square_root(dot(frame, frame));
    momentum_is_conserved(is_small(momentum.x, momentum_scale) &&
                          is_small(momentum.y, momentum_scale));

    const double work = work_of(J, i.before, j.before, (1.0 / distance) * separation);
    const double energy = i.gain_of_energy(frame) + j.gain_of_energy(frame);
    energy_never_grows(energy <= rounding * energy_scale);
    energy_is_lost_as_the_law_says(is_small(energy - work, energy_scale));

    if (!discs_touch) return;  // they overlapped at the start
    discs_touch_at_contact(is_small(distance - contact, contact));
    const double angular_momentum =
        cross(separation, j.gain_of_momentum()) + i.gain_of_spin() + j.gain_of_spin();
    angular_momentum_is_conserved(is_small(angular_momentum, contact * momentum_scale));
}

/// A disc and the wall, seen from the wall.
[[maybe_unused]] static void check_wall_collision(const Collided& disc, const Body& wall,
                                                  const Vec2& from_centre, double clearance,
                                                  const Surface& surface, const Impulse& J,
                                                  bool discs_touch) {
    const double distance = square_root(dot(from_centre, from_centre));
    check_friction(J, surface);
    const double energy_scale = disc.energy_scale(wall.velocity);
    const double work = work_of(J, disc.before, wall, (1.0 / distance) * from_centre);
    const double energy = disc.gain_of_energy(wall.velocity);
    energy_never_grows(energy <= rounding * energy_scale);
    energy_is_lost_as_the_law_says(is_small(energy - work, energy_scale));
    if (discs_touch) discs_touch_at_contact(is_small(distance - clearance, state_scale(clearance)));
}

}  // namespace invariant
}  // namespace SWIRL_TARGET
}  // namespace swirl
