// The error of a mean of few blocks (block_average.hpp): of recordings, and in the report of a run.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "swirl/statistics/block_average.hpp"
#include "swirl/statistics/student.hpp"

namespace swirl {

/// Fewer blocks have no error worth printing.
inline constexpr std::size_t min_blocks_of_an_error = 4;

/// Factor of the error of a mean of few blocks, which is itself uncertain: Student's from 4 to 19
/// blocks, so that ± two errors hold the share of cases that a normal distribution gives. NaN below
/// four blocks.
inline double few_blocks_factor(std::size_t blocks) {
    constexpr std::size_t many_blocks = 20;
    if (blocks < min_blocks_of_an_error) return std::numeric_limits<double>::quiet_NaN();
    return blocks < many_blocks ? student_95(static_cast<double>(blocks - 1)) / normal_95 : 1.0;
}

/// The estimate with this factor. It may have fewer independent blocks than it counts.
inline Estimate corrected(Estimate e,
                          std::size_t at_most = std::numeric_limits<std::size_t>::max()) {
    if (e.blocks > 0) e.error *= few_blocks_factor(std::min(e.blocks, at_most));
    return e;
}

/// The error of a corrected estimate without this factor.
inline double plain_error(const Estimate& e) {
    return e.blocks > 0 ? e.error / few_blocks_factor(e.blocks) : e.error;
}

}  // namespace swirl
