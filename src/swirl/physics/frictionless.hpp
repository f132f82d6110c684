// Kinds of contact that may lack friction, to find out what each kind causes.
#pragma once

#include <cstdint>

namespace swirl {

/// Contacts with the wall; those of two discs that are both at the wall (`boundary`); or all other
/// contacts of two discs (`bulk`).
enum class Frictionless : std::uint8_t { none, wall, boundary, bulk };

/// A disc is at the wall if its centre is less than this many of its radii from the wall.
inline constexpr double boundary_layer = 1.5;

}  // namespace swirl
