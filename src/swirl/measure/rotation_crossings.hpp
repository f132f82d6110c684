// N_c by each of the rotation rates, which cross zero at different numbers of discs.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/statistics/zero_crossing.hpp"

namespace swirl {

/// ϖ(N) for each of rotation_rates.
using RotationCurves = std::array<std::vector<RotationPoint>, rotation_rates.size()>;
using Crossings = std::array<Crossing, rotation_rates.size()>;

inline Crossings find_crossings(const RotationCurves& curves) {
    Crossings found;
    for (std::size_t r = 0; r < curves.size(); ++r) found[r] = find_crossing(curves[r]);
    return found;
}

}  // namespace swirl
