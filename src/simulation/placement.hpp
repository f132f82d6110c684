// Where the discs are at the beginning (not in the paper): without overlap, from a seed.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "swirl/math/vec2.hpp"

namespace swirl {

/// One centre for each radius, relative to the centre of the dish, no two discs closer than
/// touching and none through the wall. Nothing if they do not fit, or if no arrangement was found
/// (mixtures close to their densest packing).
///
/// Sites of a triangular lattice about the centre, turned by a random angle, N of them taken at
/// random, each shaken within its free space: at R = 8.6 this holds up to 55 unit discs, since 55
/// sites lie within √13 lattice spacings and (R − r)/√13 = 2.108 > 2. A mixture that does not fit
/// on the lattice of its largest disc starts on a narrower one and is pushed apart until no two
/// overlap.
std::optional<std::vector<Vec2>> place_discs(const std::vector<double>& radii,
                                             double container_radius, std::uint64_t seed);

}  // namespace swirl
