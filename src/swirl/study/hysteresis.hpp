// The area of the hysteresis loop of a chain (sweep_chain.hpp):
//
//     ∮ = ∫ (q_down − q_up) dx   over the values x of the parameter, by the trapezoidal rule,
//
// for each quantity q of a run. It is positive if the quantity is larger with falling values. Each
// replica has a loop of its own. The error is that of the scatter between the replicas' areas
// (statistics/replicates.hpp). The errors of the runs do not contribute: runs of a chain start from
// the final state of the run before, and what they share cancels in the difference. A single loop
// has the errors of its runs, added as if the runs were independent, which is too large.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "swirl/io/table.hpp"
#include "swirl/statistics/block_average.hpp"
#include "swirl/study/point_result.hpp"
#include "swirl/study/sweep_plan.hpp"

namespace swirl {

/// The loops with one combination of the other parameters.
struct LoopAreas {
    ParameterTexts parameters;
    std::int64_t replicas = 0;  // those with complete loops
    std::vector<Estimate> areas = {};
};

/// For each combination of the other parameters, the areas of these quantities. `results` are in
/// the order of the product of the axes (SweepPlan::product_index).
std::vector<LoopAreas> loop_areas(const SweepPlan& plan, const std::vector<PointResult>& results,
                                  const std::vector<std::string>& quantities);

Table loop_table(const SweepPlan& plan, const std::vector<LoopAreas>& loops,
                 const std::vector<std::string>& quantities);

}  // namespace swirl
