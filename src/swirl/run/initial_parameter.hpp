// The parameter --initial: states of all discs at the start of a run, instead of random ones.
//
//     states X:Y:VX:VY:SPIN X:Y:VX:VY:SPIN …    one entry per disc, in the lab frame
//
// A file name is replaced by this text (parameter_files.hpp) before the text is read. Radii and
// masses are those of the other parameters. The same function validates the arrays of Python.
#pragma once

#include <optional>
#include <string>

#include "swirl/physics/initial_state.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {

/// Discs of a snapshot may be in contact, and then overlap by a rounding error.
inline constexpr double initial_overlap = 1e-9;

/// Why a user's discs cannot be simulated, as an error message; nothing if they can: their numbers
/// are in range, and no disc overlaps another one or the wall of a container at `centre` by more
/// than the fraction `tolerance` of the smaller radius.
std::optional<std::string> problem_with_given_discs(const InitialState& scene, const Vec2& centre,
                                                    double tolerance);
/// The same for --initial; nothing if it is not given.
std::optional<Message> problem_with_initial(const RunConfig& config);

/// The scene of --initial, which must be given. Throws UsageError if there is a problem.
InitialState given_initial_state(const RunConfig& config);

}  // namespace swirl
