// Whether a simulation can continue from discs and a progress that a file says it had reached. A
// file can hold anything; the engine believes what it is given.
#pragma once

#include "swirl/engine/simulation.hpp"
#include "swirl/physics/initial_state.hpp"

namespace swirl {

/// What no simulation in this container on this path can have reached: the end of a sentence that
/// begins with "it says that". Null if there is nothing. Checked are
///   - the time: the clock lies on the leg, and as many legs have ended as the swirls have;
///   - each disc: finite numbers, a positive size, a time between the start of the swirl and the
///     clock, and a position inside the container at the clock.
/// Discs may overlap: the overlap of a contact is in its event.
const char* impossible_to_continue(const InitialState& scene, const Progress& progress);

}  // namespace swirl
