// A nearly normally distributed number with variance 1: the sum of twelve uniform numbers.
#pragma once

#include "swirl/math/random.hpp"

namespace swirl {

inline double deviate(Random& random) {
    double sum = -6.0;
    for (int k = 0; k < 12; ++k) sum += random.uniform();
    return sum;
}

}  // namespace swirl
