// What happens to the velocities when two bodies touch. One law for disc–disc and disc–wall: the
// wall is a body of infinite mass and moment of inertia (paper, SI "Collision law").
//
//            ___
//          /     \            normal   n : from body i to body j
//         |   j   |  ω_j      tangent  r : n turned by −90°, r = (n_y, −n_x)   (the paper's r̂)
//          \ ___ /
//          / ___ \  ← contact; J_n pushes j along +n and i along −n,
//         |   i   |  ω_i               J_t pushes j along +r and i along −r
//          \ ___ /
//
// The contact point of i lies at +R_i n, that of j at −R_j n. Their velocities along r are
// v_i·r − R_i ω_i and v_j·r + R_j ω_j, so the contact slips at the rate
//
//     slip = (v_j − v_i)·r + R_i ω_i + R_j ω_j.                                  (paper: v_rel)
//
// Disc and wall: i is the disc, n points from the centre of the dish outwards, and j is the wall
// with 1/m = 1/I = 0 and no spin. The disc's own spin enters exactly as above, with the sign of
// the outward normal.
//
// Normal impulse: the approach speed u = (v_i − v_j)·n > 0 is reversed and scaled by the
// restitution e, so J_n = (1 + e) u / (1/m_i + 1/m_j). The paper has e = 1.
//
// Tangential impulse: opposes the slip. J_stick = |slip| / (1/m_i + 1/m_j + R_i²/I_i + R_j²/I_j)
// brings the slip to zero (paper, Eq. Jstick); a contact that sticks gives back the fraction β of
// its slip, reversed, so it takes (1 + β) J_stick; friction can give no more than μ J_n (Coulomb).
//
//     |J_t| = min(μ J_n, (1 + β) J_stick)                 the paper has β = 0
//
// This is Walton's three-parameter law (e, μ, β): Herbst, Cafiero, Zippelius, Herrmann, Luding,
// cond-mat/0501223; with e = 1, β = 0 it is the paper's.
//
// Spheres on a floor (floor.hpp) touch at their equators, and the contact slips upwards as well:
// ω × (±R n) has the vertical part ±R (ω_x n_y − ω_y n_x) = ±R h, so j passes i at the rates
//
//     s_t = (v_j − v_i)·r + R_i ω_i + R_j ω_j  (ω_z)      s_z = −(R_i h_i + R_j h_j).
//
// A rolling sphere has R h = −v·n (v over the floor). Two rub with s_z = (v_i + v_j)·n: not at all
// head-on, most one behind the other; and one at the wall with its speed into it. They stay on the
// floor, which takes vertical impulses as it carries the weight; so against J_z only the spins give
// way, both by −(R/I) J_z (n_y, −n_x). Each component has an effective mass of its own, and what
// brings both slips to zero is
//
//     J* = −(m_t s_t, m_z s_z),    1/m_t = 1/m_i + 1/m_j + R_i²/I_i + R_j²/I_j,
//                                  1/m_z = R_i²/I_i + R_j²/I_j.
//
// With J_stick = |J*| all is as above, along J*: J = J*/|J*| min(μ J_n, (1 + β) |J*|). Discs are
// the case of one component, J*/|J*| = ∓1.
//
// Energy: an impulse J brings s_t J_t + J_t²/2m_t + s_z J_z + J_z²/2m_z (and −u J_n + J_n²/2m_n =
// −(1 − e²) m_n u²/2 along the normal; no component works on another's velocity). For J = λ J* that
// is −(λ − λ²/2)(m_t s_t² + m_z s_z²), and 0 ≤ λ ≤ 1 + β ≤ 2: nothing on the way from 0 to 2 J*
// brings energy, and J* itself takes the most.
//
// To see what the vertical component does, J* = −(m_t s_t, κ m_z s_z) can have less of it: κ = 1 is
// the law, with κ = 0 spheres rub as discs do. The vertical part then brings
// −(λκ − λ²κ²/2) m_z s_z², and 0 ≤ λκ ≤ 2 again.
//
// Limits of the spheres: they do not hop; the floor's own friction does not notice J_z.
#pragma once

#include "swirl/math/real.hpp"
#include "swirl/math/vec2.hpp"
#include "swirl/physics/contact.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/floor.hpp"

namespace swirl {

/// The TC model (Luding, McNamara 1998, doi:10.1007/s100350050017): with e < 1 a cluster of discs
/// can collide infinitely often in a finite time. Real contacts last a time t_c, and discs that
/// meet again within it never parted, so nothing more is dissipated: a collision less than t_c
/// after the last one of either partner is elastic. `since_last` is the shorter of their two times
/// (a disc's time is also reset when the clocks restart, once per swirl; the share of collisions
/// concerned is t_c/T).
SWIRL_INLINE constexpr bool is_elastic_by_tc_model(const Surface& surface, double since_last) {
    return surface.restitution < 1.0 && since_last < surface.contact_duration;
}
SWIRL_INLINE constexpr Surface at_contact(Surface surface, double since_last) {
    if (is_elastic_by_tc_model(surface, since_last)) surface.restitution = 1.0;
    return surface;
}

/// What the law needs to know of a body at the instant of contact.
struct Body {
    Vec2 velocity;
    double spin;
    double radius;
    double inverse_mass, inverse_inertia;
};

/// Of a sphere also the spins (ω_x, ω_y).
struct SphereBody : Body {
    Vec2 rolling_spin;
};

/// The wall: nothing moves it. It does not turn.
SWIRL_INLINE constexpr Body wall_body(const Vec2& velocity) {
    return {velocity, 0.0, 0.0, 0.0, 0.0};
}
SWIRL_INLINE constexpr SphereBody wall_for_spheres(const Vec2& velocity) {
    return {wall_body(velocity), {0.0, 0.0}};
}

/// How a contact slips and the effective mass against which friction works, or the impulse of
/// friction: along r, for discs.
struct Tangential {
    double t;
};
/// Along r and along z, for spheres.
struct TangentialAndVertical {
    double t, z;
};

/// Two bodies about to collide: the speed at which they close in, the slip of the contact, and the
/// effective masses against which the impulses work.
template <class Components = Tangential>
struct Approach {
    double speed;
    Components slip;
    double normal_mass;
    Components tangential_mass;
};

// What discs and spheres differ in.
namespace law {

/// −(1 + β) J*: as the slip goes.
SWIRL_INLINE constexpr Tangential sticking(const Surface& surface, const Tangential& mass,
                                           const Tangential& slip) {
    return {(1.0 + surface.tangential_restitution) * mass.t * slip.t};
}
SWIRL_INLINE constexpr TangentialAndVertical sticking(const Surface& surface,
                                                      const TangentialAndVertical& mass,
                                                      const TangentialAndVertical& slip) {
    const double one_plus_beta = 1.0 + surface.tangential_restitution;
    return {one_plus_beta * mass.t * slip.t,
            surface.vertical_friction * (one_plus_beta * mass.z * slip.z)};
}
SWIRL_INLINE constexpr double size(const Tangential& a) { return magnitude(a.t); }
SWIRL_INLINE double size(const TangentialAndVertical& a) {
    return square_root(a.t * a.t + a.z * a.z);
}
/// So much friction against it.
SWIRL_INLINE constexpr Tangential against(const Tangential& a, double strength) {
    return {minus_if(a.t > 0.0, strength)};
}
SWIRL_INLINE TangentialAndVertical against(const TangentialAndVertical& a, double strength) {
    const double length = size(a);
    if (length == 0.0) return {0.0, 0.0};
    // The direction first: with z = 0 it is exactly ∓1, and discs have the same bits.
    return {-(a.t / length) * strength, -(a.z / length) * strength};
}

SWIRL_INLINE constexpr Impulse impulse(double normal, const Tangential& J, bool sticks) {
    return {normal, J.t, sticks};
}
SWIRL_INLINE constexpr Impulse impulse(double normal, const TangentialAndVertical& J, bool sticks) {
    return {normal, J.t, sticks, J.z};
}

SWIRL_INLINE constexpr Tangential slip(const Body&, const Body&, const Vec2&, double horizontal) {
    return {horizontal};
}
SWIRL_INLINE constexpr TangentialAndVertical slip(const SphereBody& i, const SphereBody& j,
                                                  const Vec2& normal, double horizontal) {
    return {horizontal,
            -(i.radius * cross(i.rolling_spin, normal) + j.radius * cross(j.rolling_spin, normal))};
}

/// `lever` is R²/I of both together.
SWIRL_INLINE constexpr Tangential mass(const Body&, double inverse_masses, double lever) {
    return {1.0 / (inverse_masses + lever)};
}
SWIRL_INLINE constexpr TangentialAndVertical mass(const SphereBody&, double inverse_masses,
                                                  double lever) {
    return {1.0 / (inverse_masses + lever), 1.0 / lever};
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
    const double coulomb = surface.mu * normal;
    const Components sticking = law::sticking(surface, approach.tangential_mass, approach.slip);
    const double stick = law::size(sticking);
    const double strength = smaller(coulomb, stick);
    return law::impulse(normal, law::against(sticking, strength), stick <= coulomb);
}

/// Applies the law to two discs (Body) or two spheres (SphereBody), or one and the wall.
/// `separation` points from the centre of i to the centre of j (or, for the wall, from the centre
/// of the dish to the disc: outwards); only its direction is used.
template <class AnyBody>
SWIRL_INLINE Impulse collide(AnyBody& i, AnyBody& j, const Vec2& separation,
                             const Surface& surface) {
    // All contacts of a pair have the same distance to the last digits, so its rounding error is
    // not random: √ of a number just below or above 4 is always rounded down. Each error enters
    // the kick J_n n = −(1 + e) m (s·v / s·s) s once up and once down, and so the energy staggers
    // with the root of the number of collisions instead of growing in proportion to it. For the
    // same reason s is divided by the distance, not multiplied by 1/distance.
    const double square = dot(separation, separation);
    const double distance = square_root(square);
    const Vec2 normal{separation.x / distance, separation.y / distance};
    const Vec2 tangent{normal.y, -normal.x};
    const Vec2 relative = j.velocity - i.velocity;

    // The sign of the approach is that of separation · relative, the same product that decided in
    // contact_time.hpp that the two are approaching; so a contact found there always has J_n > 0.
    const double inverse_masses = i.inverse_mass + j.inverse_mass;
    const double lever =
        i.radius * i.radius * i.inverse_inertia + j.radius * j.radius * j.inverse_inertia;
    const double horizontal = dot(relative, tangent) + (i.radius * i.spin + j.radius * j.spin);
    const Approach approach{-(dot(separation, relative) / square) * distance,
                            law::slip(i, j, normal, horizontal), 1.0 / inverse_masses,
                            law::mass(i, inverse_masses, lever)};
    const Impulse J = impulse(approach, surface);

    const Vec2 kick = J.normal * normal + J.tangential * tangent;
    i.velocity = i.velocity - i.inverse_mass * kick;
    j.velocity = j.velocity + j.inverse_mass * kick;
    i.spin = i.spin + i.radius * J.tangential * i.inverse_inertia;
    j.spin = j.spin + j.radius * J.tangential * j.inverse_inertia;
    law::roll(i, tangent, J.vertical);
    law::roll(j, tangent, J.vertical);
    return J;
}

/// Spheres on a floor that are pressed together (one slides into another, or rolls along the wall)
/// hop on each other, and a hop of the speed u takes the time 2u/a for a relative acceleration a.
/// Each hop leaves some slip on the floor, which ends and takes u down, to 3/7 of a solid sphere's
/// at the wall, be the collision elastic or not: infinitely many hops in a finite time. A real
/// contact lasts t_c and stores the energy that the pressing force needs to act for so long. So
/// here a collision within t_c of the last one is elastic, and parts the two with no less than
/// μ_f g t_c/2, the speed of a hop of t_c under the force of the floor. The energy in question,
/// m (μ_f g t_c)²/8, is what the choice of t_c decides about (docs/spheres.md).
SWIRL_INLINE Surface at_contact_on_floor(Surface surface, double since_last, const Floor& floor,
                                         const Vec2& separation, const Vec2& relative_velocity) {
    if (floor.deceleration == 0.0) return at_contact(surface, since_last);
    if (!(since_last < surface.contact_duration)) return surface;
    const double approach =
        -dot(separation, relative_velocity) / square_root(dot(separation, separation));
    const double least = 0.5 * floor.deceleration * surface.contact_duration;
    surface.restitution = approach > 0.0 ? larger(1.0, smaller(least / approach, 1e100)) : 1.0;
    return surface;
}

}  // namespace swirl
