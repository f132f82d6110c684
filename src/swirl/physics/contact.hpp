// The surfaces of a contact and the impulses it transfers, without the collision law that relates
// them (collision_law.hpp). Code that only describes surfaces or reads events needs no more.
#pragma once

#include <cstdint>

namespace swirl {

/// The kind of contact in which discs have no friction, to find out what each kind causes: those
/// with the wall; those of two discs that are both at the wall (`boundary`); or all other contacts
/// of two discs (`bulk`).
enum class Frictionless : std::uint8_t { none, wall, boundary, bulk };

/// A disc is at the wall if its centre is less than this many of its radii from the wall.
inline constexpr double boundary_layer = 1.5;

/// The properties of a contact: friction coefficient μ ≥ 0, normal restitution e ∈ [0, 1],
/// tangential restitution β ∈ [0, 1], and the duration t_c of a contact, which matters only for e <
/// 1.
struct Surface {
    double mu = 1.0;
    double restitution = 1.0;
    double tangential_restitution = 0.0;
    double contact_duration = 0.0;
    double vertical_friction = 1.0;  // κ ∈ [0, 1], spheres only; 0: friction is horizontal
};

/// Impulses on body j, along n and along r; body i receives the opposite.
struct Impulse {
    double normal, tangential;
    bool sticks;            // friction is sufficient to stop the slip
    double vertical = 0.0;  // spheres: along z; `tangential` is the horizontal component
};

}  // namespace swirl
