// Which program this is: it goes into every result.
#pragma once

#include <string>

#include "swirl/physics/floor.hpp"

namespace swirl {

/// "0.1.0 (0123456789ab)": version and commit.
std::string version();
/// Compiler, its version, and the flags that decide about the numbers.
std::string build_description();

/// The number of the law by which such bodies move. Raise it where a change of the physics changes
/// their trajectories: a checkpoint of another law is rejected.
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

/// What makes random numbers out of a seed (math/random.hpp).
inline constexpr const char* random_generator = "SplitMix64";

}  // namespace swirl
