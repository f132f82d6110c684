// Validates discs and progress that were read from a file, before a simulation continues from them.
// The engine itself would stop the program (validate.hpp).
#pragma once

#include "swirl/engine/simulation.hpp"
#include "swirl/physics/initial_state.hpp"

namespace swirl {

/// Why no simulation in this container, on this path, can have reached this state; null if it can.
/// The text is a clause without a full stop. The function checks
///   - the time: the clock is within the segment, and the number of ended segments is that of the
///     periods;
///   - each disc: finite numbers, a positive size, a time between the start of the period and the
///     clock, and a position inside the container at the clock.
/// Discs may overlap: rounding errors of a contact remain in the state.
const char* impossible_to_continue(const InitialState& scene, const Progress& progress);

}  // namespace swirl
