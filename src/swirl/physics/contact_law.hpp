// A contact law gives the coefficients of one collision: friction μ, restitution e and the others
// of Surface. The built-in law takes the constants of the scene. A law of your own may make them
// depend on the impact, for example a restitution e(u) that falls with the speed u:
//
//     struct Softening {
//         double a;
//         swirl::Surface operator()(swirl::Surface surface, const swirl::Impact& impact) const {
//             surface.restitution = 1.0 / (1.0 + a * impact.speed);
//             return surface;
//         }
//     };
//
// The collision law (collision_law.hpp) then applies these coefficients, so momentum and angular
// momentum are conserved, and energy does not grow as long as e and β are from 0 to 1. The TC model
// and the floor act as for constants. engine/own_law.hpp runs a scene with such a law.
//
// A law is a function of its two arguments. To give the same bits everywhere, it uses + − × ÷ and
// square_root() only (docs/explanation/determinism.md).
#pragma once

#include <concepts>

#include "swirl/physics/collision_law.hpp"

namespace swirl {

/// What a law may depend on: the collision of disc i with disc j or with the wall, at its instant
/// and before its impulse.
struct Impact {
    double speed;  // speed of approach along the normal, u > 0
    double slip;   // rate at which the contact slips: |v_rel|, for spheres with its vertical part
    double effective_mass;              // 1/(1/m_i + 1/m_j); the mass of i at the wall
    double radius_i, radius_j;          // j: 0 for the wall
    Vec2 from_centre_i, from_centre_j;  // centres, from that of the container; j: 0 for the wall
    double container_radius;
    bool is_with_wall;
};

template <class Law>
concept ContactLaw = std::copy_constructible<Law> &&
    requires(const Law& law, const Surface& surface, const Impact& impact) {
    { law(surface, impact) } -> std::same_as<Surface>;
};

SWIRL_INLINE double slip_rate(const Tangential& slip) { return magnitude(slip.t); }
SWIRL_INLINE double slip_rate(const TangentialAndVertical& slip) { return law::size(slip); }

/// `separation` is that of collide(). The caller fills in what depends on the container.
template <class AnyBody>
SWIRL_INLINE Impact impact_of(const AnyBody& i, const AnyBody& j, const Vec2& separation) {
    const double square = dot(separation, separation);
    const double distance = square_root(square);
    const Vec2 normal{separation.x / distance, separation.y / distance};
    const Vec2 relative = j.velocity - i.velocity;
    const double horizontal =
        dot(relative, Vec2{normal.y, -normal.x}) + (i.radius * i.spin + j.radius * j.spin);
    return {.speed = larger(-(dot(separation, relative) / square) * distance, 0.0),
            .slip = slip_rate(law::slip(i, j, normal, horizontal)),
            .effective_mass = 1.0 / (i.inverse_mass + j.inverse_mass),
            .radius_i = i.radius,
            .radius_j = j.radius,
            .from_centre_i = {0.0, 0.0},
            .from_centre_j = {0.0, 0.0},
            .container_radius = 0.0,
            .is_with_wall = j.inverse_mass == 0.0};
}

}  // namespace swirl
