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
#pragma once

#include "swirl/math/real.hpp"
#include "swirl/math/vec2.hpp"
#include "swirl/physics/contact.hpp"
#include "swirl/physics/disc.hpp"

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

/// The wall: nothing moves it. It does not turn.
SWIRL_INLINE constexpr Body wall_body(const Vec2& velocity) {
    return {velocity, 0.0, 0.0, 0.0, 0.0};
}

/// Two bodies about to collide: the speed at which they close in, the slip of the contact, and the
/// effective masses against which the two impulses work.
struct Approach {
    double speed, slip;
    double normal_mass, tangential_mass;
};

SWIRL_INLINE constexpr Impulse impulse(const Approach& approach, const Surface& surface) {
    const double normal =
        (1.0 + surface.restitution) * approach.normal_mass * larger(approach.speed, 0.0);
    const double coulomb = surface.mu * normal;
    const double stick = (1.0 + surface.tangential_restitution) * approach.tangential_mass *
                         magnitude(approach.slip);
    const double strength = smaller(coulomb, stick);
    return {normal, select(approach.slip > 0.0, -strength, strength), stick <= coulomb};
}

/// Applies the law. `separation` points from the centre of i to the centre of j (or, for the wall,
/// from the centre of the dish to the disc: outwards); only its direction is used.
SWIRL_INLINE Impulse collide(Body& i, Body& j, const Vec2& separation, const Surface& surface) {
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
    const Approach approach{-(dot(separation, relative) / square) * distance,
                            dot(relative, tangent) + (i.radius * i.spin + j.radius * j.spin),
                            1.0 / inverse_masses,
                            1.0 / (inverse_masses + (i.radius * i.radius * i.inverse_inertia +
                                                     j.radius * j.radius * j.inverse_inertia))};
    const Impulse J = impulse(approach, surface);

    const Vec2 kick = J.normal * normal + J.tangential * tangent;
    i.velocity = i.velocity - i.inverse_mass * kick;
    j.velocity = j.velocity + j.inverse_mass * kick;
    i.spin = i.spin + i.radius * J.tangential * i.inverse_inertia;
    j.spin = j.spin + j.radius * J.tangential * j.inverse_inertia;
    return J;
}

}  // namespace swirl
