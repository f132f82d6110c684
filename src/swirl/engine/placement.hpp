// The positions of the discs at the beginning (not from the paper): without overlap, from a seed.
// All three functions stop the program if a radius is not above 0 and finite
// (problem_with_radii()).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "swirl/math/vec2.hpp"

namespace swirl {

/// An upper bound for the number of discs of this radius in the container. Their centres are at
/// least 2r apart in a circle of radius R − r. A convex set of area A and perimeter P holds at most
/// 2A/√3 + P/2 + 1 points at distances of at least 1 (Oler 1961, doi:10.1007/BF02546388).
double max_discs_in_container(double radius, double container_radius);

/// The number of discs of this radius in the densest known arrangement in the container. Known for
/// containers that hold at least 10 and at most 64 discs, else no value. Only for some of these
/// numbers the arrangement is proven to be the densest.
std::optional<std::int64_t> discs_in_densest_known_arrangement(double radius,
                                                               double container_radius);

/// Returns one centre for each radius, relative to the centre of the container, without overlaps of
/// discs or with the wall. Returns nothing in three cases: the discs do not fit; no arrangement was
/// found within a fixed amount of work of some seconds (near the densest packing); or `is_stopped`,
/// which is polled every few hundredths of a second, returned true. The method depends on the
/// density:
///
/// 1. Dilute: a triangular lattice about the centre is rotated by a random angle, and N of its
///    sites are chosen at random. Each disc is then displaced within its free space. At R = 8.6
///    this works for up to 55 unit discs: 55 sites lie within √13 lattice spacings, and
///    (R − r)/√13 = 2.108 > 2.
/// 2. A mixture that does not fit on the lattice of its largest disc starts on a narrower one. Its
///    discs are then pushed apart until none of them overlap. Discs at least 16 times smaller than
///    the largest are put on a lattice of their own, in the gaps between larger ones.
/// 3. Dense: discs start at random positions, and the energy of their overlaps is minimised until
///    there are none. The paper's container thus takes up to 59 discs.
/// 4. Two discs, or up to nine of one size, in a container that hardly holds them: they get their
///    densest arrangement.
///
/// Above 4,000 discs, those of one radius are numbered along Morton's curve (1966, "A computer
/// oriented geodetic data base"), so that neighbours are near each other in memory.
std::optional<std::vector<Vec2>> place_discs(const std::vector<double>& radii,
                                             double container_radius, std::uint64_t seed,
                                             const std::function<bool()>& is_stopped = {});

}  // namespace swirl
