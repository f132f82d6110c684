// Values read from a file must be possible in a run: sizes and masses in the ranges of its
// parameters (physics/limits.hpp), and no NaN where a number is needed. Every Snapshot that does
// not come from a simulation is checked here.
#pragma once

#include <string>

#include "swirl/physics/snapshot.hpp"

namespace swirl {

enum class Spins {
    known,          // recordings of a simulation
    maybe_unknown,  // a camera's tracks: spins, angles and moments of inertia may be NaN
};

/// Throws FileError if a value is out of range. The message gives the value, the disc, and `file`
/// if it is not empty.
void require_possible(const Snapshot& snapshot, Spins spins, const std::string& file = "");

/// Throws FileError if two bodies overlap, or if one is outside of the container. Only for
/// recordings of a simulation, since a camera's positions have errors.
void require_separate_bodies(const Snapshot& snapshot, const std::string& file);

}  // namespace swirl
