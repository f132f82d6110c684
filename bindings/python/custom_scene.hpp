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
    std::optional<Numbers> velocity, angle, spin, radius, mass, inertia, cannot_spin;
};

/// Throws UsageError for arrays of wrong shapes. Values that are not given are those of `config`.
/// Discs without velocities move with the container; radii without masses are of one material.
std::vector<Disc> discs_of(const GivenDiscs& given, const RunConfig& config,
                           const Segment& first_segment);

/// A closed polygon through the vertices (N × 2). The container is at each vertex at its time, and
/// at the first one again at the end of the period. Without times its speed is constant. Throws
/// UsageError.
ContainerPath polygon(const Numbers& vertices, const std::optional<Numbers>& times, double period);

/// Throws UsageError if numbers of the discs are out of range, or if discs overlap each other or
/// the wall, with the container at `centre` (run/initial_parameter.hpp).
void require_valid_discs(const InitialState& scene, const Vec2& centre, double tolerance);

}  // namespace swirl::python
