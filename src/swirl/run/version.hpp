// Version and build of the program, stored in every result.
#pragma once

#include <string>

#include "swirl/physics/floor.hpp"

namespace swirl {

/// "1.0.0 (0123456789ab)": version and commit.
std::string version();
/// Compiler, its version, and the flags that affect the results.
std::string build_description();

/// Version of the equations of motion of a body. Increase it when a change of the physics changes
/// trajectories: checkpoints with another version are rejected.
constexpr int law_of(Shape shape) {
    switch (shape) {
        case Shape::disc:
            return 1;
        case Shape::sphere:
            return 2;
        case Shape::coin:
            return 1;
    }
    return 0;
}

/// The random number generator (math/random.hpp).
inline constexpr const char* random_generator = "SplitMix64";

}  // namespace swirl
