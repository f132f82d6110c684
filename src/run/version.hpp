// Which program this is: it goes into every result.
#pragma once

#include <string>

namespace swirl {

/// "0.1.0 (0123456789ab)": version and commit.
std::string version();
/// Compiler, its version, and the flags that decide about the numbers.
std::string build_description();

/// What makes random numbers out of a seed (math/random.hpp).
inline constexpr const char* random_generator = "SplitMix64";

}  // namespace swirl
