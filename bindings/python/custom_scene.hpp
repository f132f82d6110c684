// Discs and a path that the caller gives as arrays, instead of parameters.
#pragma once

#include <optional>
#include <vector>

#include "arrays.hpp"
#include "swirl/physics/initial_state.hpp"
#include "swirl/run/config.hpp"

namespace swirl::python {

/// Columns of discs. Each but `position` may also be one number for all discs.
struct GivenDiscs {
    Numbers position;
    std::optional<Numbers> velocity, angle, spin, radius, mass, inertia;
};

/// Throws UsageError for arrays of wrong shapes and for values out of range. Values that are not
/// given are those of `config`; discs without velocities move with the container, and given radii
/// without masses are those of one material.
std::vector<Disc> discs_of(const GivenDiscs& given, const RunConfig& config,
                           const Segment& first_segment);

/// A closed polygon through the vertices (N × 2). The container is at each vertex at its time, and
/// at the first one again at the end of the period. Without times its speed is constant. Throws
/// UsageError.
ContainerPath polygon(const Numbers& vertices, const std::optional<Numbers>& times, double period);

/// Throws UsageError if a disc has a radius, mass or inertia out of range.
void require_sizes_in_range(const std::vector<double>& radius, const std::vector<double>& mass,
                            const std::vector<double>& inertia);

/// Throws UsageError if discs overlap each other or the wall, with the container at `centre`.
/// Overlaps up to the share `tolerance` of their radii are allowed.
void require_no_overlap(const InitialState& scene, const Vec2& centre, double tolerance);

}  // namespace swirl::python
