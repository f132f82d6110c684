// The preconditions of Simulation: what a scene must fulfil.
#pragma once

#include <optional>
#include <string>

#include "swirl/engine/simulation.hpp"
#include "swirl/physics/initial_state.hpp"

namespace swirl {

/// Overlaps up to this fraction of the smaller radius are rounding errors of a contact.
inline constexpr double rounding_overlap = 1e-6;

/// Why the scene cannot be simulated, as a sentence; nothing if it can:
///
/// - there is at least one disc; radius, mass and inertia are above 0; a disc that cannot spin has
///   the spin 0
/// - no disc overlaps another disc or the wall by more than `rounding_overlap`, each at its position
///   in the scene and with the container at the start of its path
/// - the container has a radius above 0; its path has a period above 0, begins at time 0, ends after
///   a period where it began, and has no gaps; for spheres and coins its segments are straight
/// - no friction coefficient is negative; restitutions are from 0 to 1
/// - all numbers are finite
std::optional<std::string> validate(const InitialState& scene);

/// The same for a simulation that continues from `progress`, as its constructor requires it. Each
/// disc is then at its own time, so positions are compared only at the start.
std::optional<std::string> validate(const InitialState& scene, const Progress& progress);

/// Stops the program (std::abort) with a line on standard error if there is a problem. The engine has
/// no exceptions. It prints nowhere else.
void stop_if(const std::optional<std::string>& problem);

/// Which discs overlap each other, or the wall of a container at `centre`, by more than the fraction
/// `tolerance` of the smaller radius.
std::optional<std::string> overlap_in(const InitialState& scene, const Vec2& centre,
                                      double tolerance);

}  // namespace swirl
