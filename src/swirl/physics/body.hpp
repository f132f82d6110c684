// The bodies of a contact, as the collision law and the energy budget see them.
#pragma once

#include "swirl/math/real.hpp"
#include "swirl/math/vec2.hpp"

namespace swirl {

/// The properties of a body that the collision law uses, at the instant of contact.
struct Body {
    Vec2 velocity;
    double spin, radius;
    double inverse_mass, inverse_inertia;
};

/// A sphere has two more spins (ω_x, ω_y). `inverse_inertia` is that of these two.
struct SphereBody : Body {
    Vec2 rolling_spin;
    double can_spin = 1.0;  // Disc::can_spin, about the vertical axis
};

/// 1/I for the spin about the vertical axis.
SWIRL_INLINE constexpr double inverse_spin_inertia(const Body& body) {
    return body.inverse_inertia;
}
SWIRL_INLINE constexpr double inverse_spin_inertia(const SphereBody& body) {
    return body.can_spin * body.inverse_inertia;
}

/// The wall has infinite mass and does not turn.
SWIRL_INLINE constexpr Body wall_body(const Vec2& velocity) {
    return {.velocity = velocity,
            .spin = 0.0,
            .radius = 0.0,
            .inverse_mass = 0.0,
            .inverse_inertia = 0.0};
}
SWIRL_INLINE constexpr SphereBody wall_for_spheres(const Vec2& velocity) {
    return {wall_body(velocity), {0.0, 0.0}};
}

}  // namespace swirl
