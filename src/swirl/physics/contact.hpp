// The surfaces of a contact and the impulses it transfers, without the collision law that relates
// them (collision_law.hpp). Code that only describes surfaces or reads events needs no more.
#pragma once

#include "swirl/math/by_name.hpp"

namespace swirl {

/// The coefficients of the collision law. Each is a number that a contact has in all collisions; a
/// law of your own makes them depend on the impact (contact_law.hpp). A collision that the TC model
/// makes elastic has a restitution of 1 here (at_contact() in collision_law.hpp), so what changes
/// the restitution further must leave 1 as it is.
struct Surface {
    [[no_unique_address]] ByName by_name{};
    double mu = 1.0;                      // friction coefficient μ ≥ 0
    double restitution = 1.0;             // normal restitution e ∈ [0, 1]
    double tangential_restitution = 0.0;  // β ∈ [0, 1]
    double contact_duration = 0.0;        // t_c; matters only for e < 1 or on a floor
    double vertical_friction = 1.0;       // κ ∈ [0, 1], spheres only; 0: friction is horizontal
};

/// A coefficient with its name in messages and its allowed range.
struct Coefficient {
    const char* name;
    double Surface::*member;
    bool is_share;  // its range is 0 to 1; otherwise it is any number that is not negative
};
inline constexpr Coefficient coefficients[] = {
    {.name = "mu", .member = &Surface::mu, .is_share = false},
    {.name = "restitution", .member = &Surface::restitution, .is_share = true},
    {.name = "tangential_restitution",
     .member = &Surface::tangential_restitution,
     .is_share = true},
    {.name = "contact_duration", .member = &Surface::contact_duration, .is_share = false},
    {.name = "vertical_friction", .member = &Surface::vertical_friction, .is_share = true},
};
static_assert(sizeof(Surface) == sizeof(coefficients) / sizeof(Coefficient) * sizeof(double),
              "each member of Surface needs a row in `coefficients`");

/// Impulses on body j, along n and along r; body i receives the opposite.
struct Impulse {
    double normal, tangential;
    bool sticks;            // friction is sufficient to stop the slip
    double vertical = 0.0;  // spheres: along z; `tangential` is the horizontal component
};

}  // namespace swirl
