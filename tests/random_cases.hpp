// Random cases for the property tests: numbers that RapidCheck can shrink, and a seed that is the
// same in every run unless RC_PARAMS says otherwise.
#pragma once

#include <rapidcheck/gtest.h>

#include <cstdlib>

#include "swirl/math/vec2.hpp"

namespace swirl {

// RapidCheck reads its parameters at the first property, after this.
inline const int fixed_cases = setenv("RC_PARAMS", "seed=20211121 max_success=400", 0);

/// In [low, high], a multiple of a millionth of the range.
inline double draw(double low, double high) {
    return low + (high - low) * 1e-6 * *rc::gen::inRange(0, 1000001);
}
inline Vec2 draw_vector(double reach) {
    const double x = draw(-reach, reach);
    return {x, draw(-reach, reach)};
}

}  // namespace swirl
