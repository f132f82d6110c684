// What was read from a file, a recording of ours or not, must be a dish: sizes and masses in the
// ranges of a run's parameters (physics/limits.hpp), numbers where numbers must be. Everything that
// becomes a Snapshot outside a simulation is asked here, once.
#pragma once

#include <string>

#include "swirl/physics/snapshot.hpp"

namespace swirl {

enum class Spins {
    known,          // in recordings of a simulation
    maybe_unknown,  // NaN, and the moments of inertia too, in a camera's tracks
};

/// Throws FileError, which names `file` if there is one and says which value of which disc cannot
/// be.
void require_possible(const Snapshot& snapshot, Spins spins, const std::string& file = "");

}  // namespace swirl
