// A sweep in which each run starts from the final state of its neighbour (SweepPlan::chain), so
// that hysteresis shows: first with rising values of one parameter, then with falling ones. The
// first run of a chain starts from random positions; the falling half starts from the end of the
// rising one.
//
// DIR/states/000012.state is the final state of point 12, in the format of a checkpoint. It is
// written before the result, so a point with a result has a state, and a stopped sweep continues
// its chains.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "swirl/run/run.hpp"
#include "swirl/study/sweep_plan.hpp"

namespace swirl {

/// The points of each chain, in the order in which they run.
std::vector<std::vector<std::size_t>> chains_of(const SweepPlan& plan);

void write_final_state(const std::filesystem::path& folder, const SweepPlan& plan,
                       std::size_t point, FinalState state);
/// Throws FileError if the file is missing, damaged, or of another point.
FinalState read_final_state(const std::filesystem::path& folder, const SweepPlan& plan,
                            std::size_t point);

}  // namespace swirl
