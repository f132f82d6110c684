// Where the discs are at the beginning (not in the paper): without overlap, from a seed.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "swirl/math/vec2.hpp"

namespace swirl {

/// No more discs of this radius than that fit into the dish. Their centres are at least 2r apart in
/// a circle of radius R − r, and a convex set of area A and perimeter P holds at most
/// 2A/√3 + P/2 + 1 points that are no closer than 1 (Oler 1961, doi:10.1007/BF02546388).
double max_discs_in_container(double radius, double container_radius);

/// One centre for each radius, relative to the centre of the dish, no two discs closer than
/// touching and none through the wall. Nothing if they do not fit, or if no arrangement was found
/// in some seconds (close to the densest packing there is), or if `is_stopped`, which is asked
/// every few hundredths of a second, said so.
///
/// Sites of a triangular lattice about the centre, turned by a random angle, N of them taken at
/// random, each shaken within its free space: at R = 8.6 this holds up to 55 unit discs, since 55
/// sites lie within √13 lattice spacings and (R − r)/√13 = 2.108 > 2. A mixture that does not fit
/// on the lattice of its largest disc starts on a narrower one and is pushed apart until no two
/// overlap; discs 16 times as small as the largest, or smaller, go onto a lattice of their own in
/// the gaps that the larger leave. What is denser still starts from random places and slides down
/// the energy of its overlaps until there are none; so the paper's dish takes up to 59 discs. Two
/// discs, or up to nine of one size, in a container that hardly holds them stand in their densest
/// arrangement.
///
/// Of more than 4,000 discs, those of one radius are numbered along Morton's curve (1966, "A
/// computer oriented geodetic data base"): whoever is near has a near number and is near in memory.
std::optional<std::vector<Vec2>> place_discs(const std::vector<double>& radii,
                                             double container_radius, std::uint64_t seed,
                                             const std::function<bool()>& is_stopped = {});

}  // namespace swirl
