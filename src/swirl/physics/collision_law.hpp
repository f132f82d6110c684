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
// A rolling sphere has R h = −v·n (v over the floor). Two that roll slip with s_z = (v_i + v_j)·n:
// not at all head-on, most one behind the other; a sphere at the wall slips with its speed into it.
//
// Who is lifted. J_z pushes j up and i down, or j down and i up; it opposes s_z, so i goes up if
// s_z > 0 and j if s_z < 0: of a pair exactly one. The floor holds the one that is pushed down with
// an impulse −J_z, so only its spin responds. It does not hold the other, which responds with its
// mass, too, and leaves the floor with the velocity w = |J_z|/m. (The wall is "lifted" with 1/m =
// 0; a sphere at the wall is lifted if it rolls into it and pushed down if it spins backwards.)
// Both spins change by −(R/I) J_z (n_y, −n_x). Each component of the slip has an effective mass of
// its own,
//
//     1/m_t = 1/m_i + 1/m_j + R_i²/I_i + R_j²/I_j,
//     1/m_z = 1/m_lifted    + R_i²/I_i + R_j²/I_j,
//
// and J* = −(m_t s_t, m_z s_z) brings both to zero; a contact that sticks has J = (1 + β) J*. For
// equal solid spheres m_t = 1/7 and m_z = 1/6 of a mass.
//
// The lifted sphere falls back after 2w/g, and its w ends in the floor. The model is planar: it
// takes w away at once, so the vertical energy ½ J_z²/m_lifted counts as lost in the collision. How
// short and how low these hops are is measured in docs/spheres.md.
//
// A contact that slides, K = μ J_n < |J*|: friction opposes the slip s = (s_t, s_z) at every
// instant, dJ/dK = −ŝ. The masses differ, so the slip turns while it falls, and no direction is
// right for the whole contact: for K → 0 it is −ŝ of the beginning, for K → |J*| that of J*, up
// to 9.6° from it for solid spheres (14.5° for shells). With k = K/|J*| and 1/m_s = ŝ_t²/m_t +
// ŝ_z²/m_z, where m_s |s| is what takes the slip to zero along its own direction, the law is
//
//     J = (1 − k²) a + k² k J*,    a = −ŝ min(K, m_s |s|).
//
// It differs from the integral over the contact, which has no closed form, by less than 0.02 K for
// solid spheres and 0.035 K for shells; one along −ŝ alone, or along J* alone, by up to 0.17 K and
// 0.25 K (sphere_collision_test.cpp). |J| ≤ K, as of the integral. At k = 1 it is J*, so sticking
// is its continuous end; with β > 0 contacts with |J*| ≤ K < (1 + β) |J*| have K/|J*| J*. With one
// component both parts are ∓K, and the law is that of discs.
//
// Energy: an impulse J brings
//
//     E(J) = s_t J_t + J_t²/2m_t + s_z J_z + J_z²/2m_z
//
// (and −u J_n + J_n²/2m_n = −(1 − e²) m_n u²/2 along the normal; no component works on another's
// velocity), the vertical energy of the lifted included. E(−λ ŝ) = −λ |s| + λ²/2m_s falls up to
// λ = m_s |s|, so E(a) ≤ 0. E(λ J*) = −(λ − λ²/2)(m_t s_t² + m_z s_z²) is not above 0 up to
// λ = 1 + β ≤ 2. E is convex, so it is not above 0 at any mean of two such J either. That is every
// J of the law; and the planar motion, without the vertical energy, keeps even less.
//
// To see what the vertical component does, friction can feel less of it, κ s_z in the place of s_z:
// κ = 1 is the law, with κ = 0 spheres slip as discs do. The above then holds of κ s_z, and what
// the true slip brings more, (1 − κ) s_z J_z, is not above 0 either, as J_z opposes s_z throughout.
//
// Limits of the spheres: they do not hop; the floor's own friction does not notice J_z
// (docs/spheres.md bounds both).
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
/// −J of a contact that slides, K being `coulomb`. In an order of operations that gives discs their
/// bits where one component is zero.
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
    const TangentialAndVertical felt{slip.t, surface.vertical_friction * slip.z};
    const double one_plus_beta = 1.0 + surface.tangential_restitution;
    const TangentialAndVertical sticking{one_plus_beta * mass.t * felt.t,
                                         one_plus_beta * mass.z * felt.z};
    if (size(sticking) <= coulomb) return {times(-1.0, sticking), true};
    return {times(-1.0, sliding(mass, felt, coulomb)), false};
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
SWIRL_INLINE constexpr Tangential mass(const Body&, const Body&, const Tangential&,
                                       double inverse_masses, double lever) {
    return {1.0 / (inverse_masses + lever)};
}
SWIRL_INLINE constexpr TangentialAndVertical mass(const SphereBody& i, const SphereBody& j,
                                                  const TangentialAndVertical& slip,
                                                  double inverse_masses, double lever) {
    const double of_lifted = slip.z > 0.0 ? i.inverse_mass : j.inverse_mass;
    return {1.0 / (inverse_masses + lever), 1.0 / (of_lifted + lever)};
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
    const auto slip = law::slip(i, j, normal, horizontal);
    const Approach approach{-(dot(separation, relative) / square) * distance, slip,
                            1.0 / inverse_masses, law::mass(i, j, slip, inverse_masses, lever)};
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
    const double minimum = 0.5 * floor.deceleration * surface.contact_duration;
    surface.restitution = approach > 0.0 ? larger(1.0, smaller(minimum / approach, 1e100)) : 1.0;
    return surface;
}

}  // namespace swirl
