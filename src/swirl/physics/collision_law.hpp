// The collision law: what happens to the velocities when two bodies touch. It is one law for two
// discs and for a disc at the wall: the wall is a body of infinite mass and moment of inertia
// (paper, SI "Collision law"). The paper has friction between discs and at the wall, each with a
// coefficient of its own (Surface).
//
//            ___
//          /     \            normal   n : from body i to body j
//         |   j   |  ω_j      tangent  r : n turned by −90°, r = (n_y, −n_x)   (the paper's r̂)
//          \ ___ /
//          / ___ \  ← contact; J_n pushes j along +n and i along −n,
//         |   i   |  ω_i               J_t pushes j along +r and i along −r
//          \ ___ /
//
// The contact point of i is at +R_i n from its centre, that of j at −R_j n. Their velocities along
// r are v_i·r − R_i ω_i and v_j·r + R_j ω_j, so the contact slips at the rate
//
//     slip = (v_j − v_i)·r + R_i ω_i + R_j ω_j.                                  (paper: v_rel)
//
// Disc and wall: i is the disc, n points outwards from the centre of the container, and j is the
// wall with 1/m = 1/I = 0 and no spin. The disc's own spin enters exactly as above.
//
// Normal impulse: the speed of approach u = (v_i − v_j)·n > 0 is reversed and scaled by the
// restitution e, so J_n = (1 + e) u / (1/m_i + 1/m_j). The paper has e = 1.
//
// Tangential impulse: it opposes the slip. J_stick = |slip| / (1/m_i + 1/m_j + R_i²/I_i + R_j²/I_j)
// stops the slip (paper, Eq. Jstick). A contact that sticks reverses its slip and keeps the
// fraction β of it, which takes (1 + β) J_stick. Friction can supply at most μ J_n (Coulomb):
//
//     |J_t| = min(μ J_n, (1 + β) J_stick)                 the paper has β = 0
//
// This is Walton's three-parameter law (e, μ, β): Herbst, Cafiero, Zippelius, Herrmann, Luding,
// cond-mat/0501223. With e = 1 and β = 0 it is the paper's.
//
// A particle that cannot spin (Disc::can_spin) has 1/I = 0. Friction then changes velocities only.
// What holds its spin takes up the torque R J_t, so the sum of L and spins is not conserved: one
// collision of two such discs changes it by −(R_i + R_j) J_t. Such a sphere rolls as before: only
// R²/I of m_t is 0.
//
// ---- Spheres
//
// Spheres on a floor (floor.hpp) touch at their equators, and the contact also slips vertically:
// ω × (±R n) has the vertical component ±R (ω_x n_y − ω_y n_x) = ±R h. So j passes i at the rates
//
//     s_t = (v_j − v_i)·r + R_i ω_i + R_j ω_j  (ω_z)      s_z = −(R_i h_i + R_j h_j).
//
// A rolling sphere has R h = −v·n (v relative to the floor). Two rolling spheres slip with s_z =
// (v_i + v_j)·n: not at all head-on, most one behind the other. A sphere at the wall slips with its
// speed into the wall.
//
// Lifting: J_z pushes j up and i down, or j down and i up. It opposes s_z, so i is lifted if s_z >
// 0 and j if s_z < 0: exactly one of a pair. The floor holds the sphere that is pushed down with an
// impulse −J_z, so only its spin responds. The floor does not hold the lifted sphere: it responds
// with its mass, too, and leaves the floor with the velocity w = |J_z|/m. (If the wall is "lifted",
// 1/m = 0. A sphere at the wall is lifted if it rolls into it, and pushed down if it spins
// backwards.) Both spins change by −(R/I) J_z (n_y, −n_x). Each component of the slip has its own
// effective mass,
//
//     1/m_t = 1/m_i + 1/m_j + R_i²/I_i + R_j²/I_j,
//     1/m_z = 1/m_lifted    + R_i²/I_i + R_j²/I_j,
//
// and J* = −(m_t s_t, m_z s_z) stops both; a contact that sticks has J = (1 + β) J*. For equal
// solid spheres m_t = 1/7 and m_z = 1/6 of a mass.
//
// The lifted sphere falls back after 2w/g, and the floor absorbs its w. The model is planar: it
// removes w at once, so the vertical energy ½ J_z²/m_lifted counts as lost in the collision.
// docs/explanation/spheres.md measures how short and low these flights are.
//
// A contact that slides, K = μ J_n < |J*|: friction opposes the slip s = (s_t, s_z) at every
// instant, dJ/dK = −ŝ. The two masses differ, so the slip turns while it decreases, and no fixed
// direction is right for the whole contact. For K → 0 it is −ŝ of the beginning; for K → |J*| it is
// that of J*, up to 9.6° away for solid spheres (14.5° for shells). Let k = K/|J*| and 1/m_s =
// ŝ_t²/m_t + ŝ_z²/m_z; then m_s |s| stops the slip along its own direction. The law is
//
//     J = (1 − k²) a + k² k J*,    a = −ŝ min(K, m_s |s|).
//
// It differs from the integral over the contact, which has no closed form, by less than 0.02 K for
// solid spheres and 0.035 K for shells. A law along −ŝ alone, or along J* alone, differs by up to
// 0.17 K and 0.25 K (sphere_collision_test.cpp). |J| ≤ K, as for the integral. At k = 1 it is J*,
// so sticking is its continuous end. With β > 0 contacts with |J*| ≤ K < (1 + β) |J*| have K/|J*|
// J*. If one component is zero both parts are ∓K, and the law is that of discs.
//
// Energy: an impulse J adds
//
//     E(J) = s_t J_t + J_t²/2m_t + s_z J_z + J_z²/2m_z
//
// (and −u J_n + J_n²/2m_n = −(1 − e²) m_n u²/2 along the normal; no component does work on
// another's velocity), with the vertical energy of the lifted sphere included. E(−λ ŝ) = −λ |s| +
// λ²/2m_s decreases up to λ = m_s |s|, so E(a) ≤ 0. E(λ J*) = −(λ − λ²/2)(m_t s_t² + m_z s_z²) is
// not positive up to λ = 1 + β ≤ 2. E is convex, so it is not positive at any mean of two such J.
// Every J of the law is such a mean. The planar motion, without the vertical energy, keeps even
// less.
//
// To show the effect of the vertical component, friction can act on less of it: on κ s_z instead of
// s_z. κ = 1 is the law; with κ = 0 spheres slip as discs do. The above then holds for κ s_z. The
// true slip adds (1 − κ) s_z J_z, which is not positive either, as J_z opposes s_z throughout.
//
// Limits for spheres: they do not leave the floor, and the floor's own friction does not depend on
// J_z (docs/explanation/spheres.md bounds both effects).
#pragma once

#include "swirl/math/real.hpp"
#include "swirl/math/vec2.hpp"
#include "swirl/physics/body.hpp"
#include "swirl/physics/contact.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/floor.hpp"

namespace swirl {

/// The TC model (Luding, McNamara 1998, doi:10.1007/s100350050017). With e < 1 a cluster of discs
/// can collide infinitely often in a finite time. Real contacts last a time t_c, and discs that
/// collide again within it never separated, so nothing more is dissipated. Therefore a collision is
/// elastic if it comes less than t_c after the last one of either partner. `since_last` is the
/// shorter of their two times. (A disc's time is also reset when the clocks restart, once per
/// period; this concerns a fraction t_c/T of the collisions.)
SWIRL_INLINE constexpr bool is_elastic_by_tc_model(const Surface& surface, double since_last) {
    return surface.restitution < 1.0 && since_last < surface.contact_duration;
}
SWIRL_INLINE constexpr Surface at_contact(Surface surface, double since_last) {
    if (is_elastic_by_tc_model(surface, since_last)) surface.restitution = 1.0;
    return surface;
}

/// For discs, a tangential quantity has one component, along r. It is the slip of a contact, the
/// effective mass for friction, or the impulse of friction.
struct Tangential {
    double t;
};
/// For spheres it has components along r and z.
struct TangentialAndVertical {
    double t, z;
};

/// Two bodies about to collide: the speed of approach, the slip of the contact, and the effective
/// masses for the normal and tangential impulses.
template <class Components = Tangential>
struct Approach {
    double speed;
    Components slip;
    double normal_mass;
    Components tangential_mass;
};

// The parts that differ between discs and spheres.
namespace law {

template <class Components>
struct Friction {
    Components impulse;
    bool sticks;
};

SWIRL_INLINE constexpr Friction<Tangential> friction(const Surface& surface, const Tangential& mass,
                                                     const Tangential& slip, double coulomb) {
    const double sticking = (1.0 + surface.tangential_restitution) * mass.t * slip.t;
    const double stick = magnitude(sticking);
    return {{minus_if(sticking > 0.0, smaller(coulomb, stick))}, stick <= coulomb};
}

SWIRL_INLINE double size(const TangentialAndVertical& a) {
    return square_root(a.t * a.t + a.z * a.z);
}
SWIRL_INLINE TangentialAndVertical times(double factor, const TangentialAndVertical& a) {
    return {factor * a.t, factor * a.z};
}
/// −J of a contact that slides; `coulomb` is K. The order of operations makes the result bitwise
/// identical to that for discs if one component is zero.
SWIRL_INLINE TangentialAndVertical sliding(const TangentialAndVertical& mass,
                                           const TangentialAndVertical& slip, double coulomb) {
    const TangentialAndVertical whole{mass.t * slip.t, mass.z * slip.z};
    const double speed = size(slip), stick = size(whole);
    if (speed == 0.0 || stick == 0.0) return {0.0, 0.0};
    const TangentialAndVertical along{slip.t / speed, slip.z / speed};
    const TangentialAndVertical b = times(coulomb, {whole.t / stick, whole.z / stick});
    if (coulomb >= stick) return b;
    const double stops =
        mass.t / (along.t * along.t + along.z * along.z * (mass.t / mass.z)) * speed;
    const TangentialAndVertical a = times(smaller(coulomb, stops), along);
    const double k = coulomb / stick;
    return {a.t + k * k * (b.t - a.t), a.z + k * k * (b.z - a.z)};
}
SWIRL_INLINE Friction<TangentialAndVertical> friction(const Surface& surface,
                                                      const TangentialAndVertical& mass,
                                                      const TangentialAndVertical& slip,
                                                      double coulomb) {
    const TangentialAndVertical counted{slip.t, surface.vertical_friction * slip.z};
    const double one_plus_beta = 1.0 + surface.tangential_restitution;
    const TangentialAndVertical sticking{one_plus_beta * mass.t * counted.t,
                                         one_plus_beta * mass.z * counted.z};
    if (size(sticking) <= coulomb) return {times(-1.0, sticking), true};
    return {times(-1.0, sliding(mass, counted, coulomb)), false};
}

SWIRL_INLINE constexpr Impulse impulse(double normal, const Tangential& J, bool sticks) {
    return {.normal = normal, .tangential = J.t, .sticks = sticks};
}
SWIRL_INLINE constexpr Impulse impulse(double normal, const TangentialAndVertical& J, bool sticks) {
    return {.normal = normal, .tangential = J.t, .sticks = sticks, .vertical = J.z};
}

SWIRL_INLINE constexpr Tangential slip(const Body&, const Body&, const Vec2&, double horizontal) {
    return {horizontal};
}
SWIRL_INLINE constexpr TangentialAndVertical slip(const SphereBody& i, const SphereBody& j,
                                                  const Vec2& normal, double horizontal) {
    return {horizontal,
            -(i.radius * cross(i.rolling_spin, normal) + j.radius * cross(j.rolling_spin, normal))};
}

/// `lever` is R²/I of the spins about the vertical axis, summed over both bodies.
SWIRL_INLINE constexpr Tangential mass(const Body&, const Body&, const Tangential&,
                                       double inverse_masses, double lever) {
    return {1.0 / (inverse_masses + lever)};
}
SWIRL_INLINE constexpr TangentialAndVertical mass(const SphereBody& i, const SphereBody& j,
                                                  const TangentialAndVertical& slip,
                                                  double inverse_masses, double lever) {
    const double of_lifted = slip.z > 0.0 ? i.inverse_mass : j.inverse_mass;
    const double of_rolling =
        i.radius * i.radius * i.inverse_inertia + j.radius * j.radius * j.inverse_inertia;
    return {1.0 / (inverse_masses + lever), 1.0 / (of_lifted + of_rolling)};
}

SWIRL_INLINE constexpr void roll(Body&, const Vec2&, double) {}
SWIRL_INLINE constexpr void roll(SphereBody& sphere, const Vec2& tangent, double vertical) {
    sphere.rolling_spin =
        sphere.rolling_spin - (sphere.radius * vertical * sphere.inverse_inertia) * tangent;
}

}  // namespace law

template <class Components>
SWIRL_INLINE constexpr Impulse impulse(const Approach<Components>& approach,
                                       const Surface& surface) {
    const double normal =
        (1.0 + surface.restitution) * approach.normal_mass * larger(approach.speed, 0.0);
    const auto [J, sticks] =
        law::friction(surface, approach.tangential_mass, approach.slip, surface.mu * normal);
    return law::impulse(normal, J, sticks);
}

/// Applies the law to two discs (Body) or two spheres (SphereBody), or to one and the wall. Changes
/// their velocities and spins and returns the impulse. `separation` points from the centre of i to
/// the centre of j; for the wall it points outwards, from the centre of the container to the disc.
/// Only its direction matters.
template <class AnyBody>
SWIRL_INLINE Impulse collide(AnyBody& i, AnyBody& j, const Vec2& separation,
                             const Surface& surface) {
    // All contacts of a pair have the same distance up to the last digits, so its rounding error is
    // not random: √ of a number just below or above 4 is always rounded down. Each error enters the
    // impulse J_n n = −(1 + e) m (s·v / s·s) s once with each sign. So the energy performs a random
    // walk with the number of collisions instead of drifting in proportion to it. For the same
    // reason s is divided by the distance, not multiplied by 1/distance.
    const double square = dot(separation, separation);
    const double distance = square_root(square);
    const Vec2 normal{separation.x / distance, separation.y / distance};
    const Vec2 tangent{normal.y, -normal.x};
    const Vec2 relative = j.velocity - i.velocity;

    // The sign of the approach is that of separation · relative. The same product decided in
    // contact_time.hpp that the two approach, so a contact found there always has J_n > 0.
    const double inverse_masses = i.inverse_mass + j.inverse_mass;
    const double spins_i = inverse_spin_inertia(i), spins_j = inverse_spin_inertia(j);
    const double lever = i.radius * i.radius * spins_i + j.radius * j.radius * spins_j;
    const double horizontal = dot(relative, tangent) + (i.radius * i.spin + j.radius * j.spin);
    const auto slip = law::slip(i, j, normal, horizontal);
    const Approach approach{-(dot(separation, relative) / square) * distance, slip,
                            1.0 / inverse_masses, law::mass(i, j, slip, inverse_masses, lever)};
    const Impulse J = impulse(approach, surface);

    const Vec2 kick = J.normal * normal + J.tangential * tangent;
    i.velocity = i.velocity - i.inverse_mass * kick;
    j.velocity = j.velocity + j.inverse_mass * kick;
    i.spin = i.spin + i.radius * J.tangential * spins_i;
    j.spin = j.spin + j.radius * J.tangential * spins_j;
    law::roll(i, tangent, J.vertical);
    law::roll(j, tangent, J.vertical);
    return J;
}

/// The TC model for spheres on a floor. If two are pressed together (one slides into another, or
/// rolls along the wall) they separate and collide again and again. With relative acceleration a
/// and speed u each separation lasts 2u/a. During the separation, friction ends the slip on the
/// floor that the collision caused, and thereby reduces u. At the wall, u falls to 3/7 for a solid
/// sphere, even if the collision is elastic. Without a limit there would be infinitely many
/// collisions in a finite time. A real contact lasts t_c and stores the work of the pressing force
/// during that time. In the model, a collision within t_c of the last one is therefore elastic. It
/// also separates the two with at least μ_f g t_c/2, the speed of a separation of length t_c under
/// the force of the floor. The choice of t_c affects only energies of about m (μ_f g t_c)²/8
/// (docs/explanation/spheres.md).
SWIRL_INLINE Surface at_contact_on_floor(Surface surface, double since_last, const Floor& floor,
                                         const Vec2& separation, const Vec2& relative_velocity) {
    if (floor.deceleration == 0.0) return at_contact(surface, since_last);
    if (!(since_last < surface.contact_duration)) return surface;
    const double approach =
        -dot(separation, relative_velocity) / square_root(dot(separation, separation));
    const double minimum = 0.5 * floor.deceleration * surface.contact_duration;
    surface.restitution = approach > 0.0 ? larger(1.0, smaller(minimum / approach, 1e100)) : 1.0;
    return surface;
}

}  // namespace swirl
