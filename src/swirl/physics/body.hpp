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

/// A sphere has two more spins (ω_x, ω_y).
struct SphereBody : Body {
    Vec2 rolling_spin;
};

/// The wall has infinite mass and does not turn.
SWIRL_INLINE constexpr Body wall_body(const Vec2& velocity) {
    return {velocity, 0.0, 0.0, 0.0, 0.0};
}
SWIRL_INLINE constexpr SphereBody wall_for_spheres(const Vec2& velocity) {
    return {wall_body(velocity), {0.0, 0.0}};
}

}  // namespace swirl
