// Invariants of a collision (invariant.hpp): the discs touch; linear and angular momentum are
// conserved; energy does not grow (for the wall, in its frame), and decreases by the work of the
// impulses.
#pragma once

#include "swirl/engine/invariant.hpp"
#include "swirl/math/lanes.hpp"
#include "swirl/physics/collision_law.hpp"
#include "swirl/physics/container_path.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// Allowed relative error. Rounding errors of velocities and impulses are about 10⁻¹³, and those of
/// derived quantities are not much larger; a wrong result is off by far more. For lengths it also
/// covers bodies that are pressed together for long, where rounding errors accumulate from contact
/// to contact.
inline constexpr double allowed_rounding = 1e-10;

SWIRL_INLINE bool is_rounding(double error, double scale) {
    return magnitude(error) <= allowed_rounding * scale;
}

// How far from touching two bodies may be at their contact because of the rounding of doubles, each
// by ε = 2⁻⁵³ of its value. The stored positions, velocities and times are exact by definition. Let
// L be the largest coordinate along their flights. Let s be their separation at the later of the
// stored times, from which the contact is predicted (contact_time.hpp), and v its rate of change.
// Let σ be the distance of contact, and t its time.
//
// 1. A position at a time is x + u (t − t₀). Here u (t − t₀) leads from one coordinate to another
//    and is at most 2L. The difference, the product and the sum are rounded by 2εL, 2εL and εL. For
//    two bodies and two coordinates, at the prediction and at the contact: at most 28 εL.
// 2. At the computed time τ, |s + vτ|² − σ² is not zero. c, 2bτ and aτ² are rounded by 3εs²,
//    6εs|vτ| and 3ε|vτ|², and |vτ| is at most s + σ ≤ 2s: together 27 εs². An error δ of the
//    discriminant D adds cδ/(√D − b)². As δ ≤ 8εb² and (√D − b)² ≥ b², this is at most 8 εs². It
//    holds for grazing discs, too, whose τ has lost half of its digits, and for discs that miss
//    each other. As |x|² − σ² = (|x| + σ)(|x| − σ), the error of the distance is 18 εs²/σ. It grows
//    with the square of the path length: in a container of 10⁷ radii it is 0.1 radii.
// 3. The sum now + τ is rounded by εt, in which the distance changes by εt|v|.
//
// For disc and wall s and σ are at most the clearance R − r, and so is s²/σ.
inline constexpr double roundings = 32.0 * 0x1p-53;

SWIRL_INLINE double size_of(const Vec2& x) { return larger(magnitude(x.x), magnitude(x.y)); }

SWIRL_INLINE double rounding_of_contact(const Flight<double>& i, const Flight<double>& j,
                                        double sum_of_radii, double t) {
    const double now = larger(i.time, j.time);
    const Vec2 s = j.position_at(now) - i.position_at(now), v = j.velocity - i.velocity;
    const double L = larger(larger(size_of(i.position), size_of(j.position)),
                            larger(size_of(i.position_at(t)), size_of(j.position_at(t))));
    return roundings * (L + dot(s, s) / sum_of_radii + t * square_root(dot(v, v)));
}
/// The same for the wall; the container's centre is computed from the start of its segment.
SWIRL_INLINE double rounding_of_wall_contact(const Flight<double>& disc, const Segment& segment,
                                             double clearance, double t) {
    const Flight<double> centre = segment.flight_at(t);
    const Vec2 v = disc.velocity - centre.velocity;
    const double L = larger(larger(size_of(disc.position), size_of(disc.position_at(t))),
                            larger(size_of(segment.start), size_of(centre.position)));
    return roundings * (L + clearance + t * square_root(dot(v, v)));
}

/// A body before and after a collision, seen from a frame that moves with the velocity `frame`. The
/// wall has infinite mass; in its own frame it has no energy and gains none.
struct Collided {
    Body before, after;
    Vec2 frame;

    SWIRL_INLINE bool is_wall() const { return before.inverse_mass == 0.0; }
    SWIRL_INLINE bool can_spin() const { return before.inverse_inertia != 0.0; }
    SWIRL_INLINE Vec2 gain_of_momentum() const {
        if (is_wall()) return {0.0, 0.0};
        return (1.0 / before.inverse_mass) * (after.velocity - before.velocity);
    }
    /// The angular momentum that the spin has gained; or that a disc has passed on to what holds
    /// it, if it cannot spin.
    SWIRL_INLINE double gain_of_spin(const Impulse& J) const {
        if (is_wall()) return 0.0;
        if (!can_spin()) return before.radius * J.tangential;
        return (after.spin - before.spin) / before.inverse_inertia;
    }
    SWIRL_INLINE double size_of_spin() const {
        return can_spin() ? magnitude(before.spin / before.inverse_inertia) : 0.0;
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
        const double of_spin = can_spin() ? body.spin * body.spin / body.inverse_inertia : 0.0;
        return 0.5 * (dot(v, v) / body.inverse_mass + of_spin);
    }
};

/// The energy that both impulses add: with u the speed of approach and m_n, m_t the effective
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
    invariant::friction_obeys_coulombs_law(J.normal >= 0.0 &&
                                           magnitude(J.tangential) <=
                                               surface.mu * J.normal * (1.0 + allowed_rounding));
    // Velocities are stored in the lab frame, where a container may be a million times as fast as
    // its discs relative to each other. Each is rounded to 2⁻⁵³ of its value, which changes the
    // energy by that times the momentum. A collision has fewer than sixteen such roundings.
    const double rounded = 16.0 * 0x1p-53 * (i.speed() + j.speed()) *
                           (i.momentum() + j.momentum() + J.normal + magnitude(J.tangential));
    const double allowed = allowed_rounding * before + rounded;
    invariant::energy_never_grows(after - before <= allowed);
    invariant::energy_changes_by_the_work_of_the_impulses(
        magnitude(after - before - work_of(J, i.before, j.before, normal)) <= allowed);
}

/// `separation` points from i to j; its length at contact is the sum of radii, up to `rounding`.
/// Angular momentum is taken about the centre of i, where only the spin of i contributes.
[[maybe_unused]] static void check_disc_collision(const Collided& i, const Collided& j,
                                                  const Vec2& separation, const Surface& surface,
                                                  const Impulse& J, double rounding,
                                                  bool overlapped_at_start) {
    const double distance = square_root(dot(separation, separation));
    const double contact = i.before.radius + j.before.radius;
    check_energy(i, j, (1.0 / distance) * separation, surface, J);

    const Vec2 gain = i.gain_of_momentum() + j.gain_of_momentum();
    const double scale = magnitude(J.normal) + magnitude(J.tangential) +
                         (square_root(dot(i.before.velocity, i.before.velocity)) +
                          square_root(dot(j.before.velocity, j.before.velocity))) /
                             smaller(i.before.inverse_mass, j.before.inverse_mass);
    invariant::momentum_is_conserved(is_rounding(gain.x, scale) && is_rounding(gain.y, scale));

    if (overlapped_at_start) return;
    invariant::discs_touch_at_contact(magnitude(distance - contact) <=
                                      allowed_rounding * contact + rounding);
    const double angular =
        cross(separation, j.gain_of_momentum()) + i.gain_of_spin(J) + j.gain_of_spin(J);
    const double spins = i.size_of_spin() + j.size_of_spin();
    // The lever arms of the tangential impulse are the radii, which do not include the rounding.
    invariant::angular_momentum_is_conserved(magnitude(angular) <=
                                             allowed_rounding * (contact * scale + spins) +
                                                 rounding * magnitude(J.tangential));
}

/// `from_centre` points from the centre of the container to the disc; `contact` is its length when
/// the disc touches the wall, up to `rounding`.
[[maybe_unused]] static void check_wall_collision(const Collided& disc, const Collided& wall,
                                                  const Vec2& from_centre, double contact,
                                                  const Surface& surface, const Impulse& J,
                                                  double rounding, bool overlapped_at_start) {
    const double distance = square_root(dot(from_centre, from_centre));
    check_energy(disc, wall, (1.0 / distance) * from_centre, surface, J);
    if (overlapped_at_start) return;
    invariant::discs_touch_at_contact(magnitude(distance - contact) <=
                                      allowed_rounding * (contact + disc.before.radius) + rounding);
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
