// A sweep in which each run starts from the final state of its neighbour (SweepPlan::chain), so
// that hysteresis shows: first with rising values of one parameter, then with falling ones. The
// first run of a chain starts from random positions; the falling half starts from the end of the
// rising one.
//
// DIR/states/000012.state is the final state of point 12, in the format of a checkpoint. It is
// written before the result. Each run reads the state from this file, so a repaired chain repeats
// the runs of the first one. A point without a whole state is not done, so a chain always starts
// again from the last point before its first hole.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "swirl/run/run.hpp"
#include "swirl/study/sweep_plan.hpp"

namespace swirl {

/// The points of each chain, in the order in which they run.
std::vector<std::vector<std::size_t>> chains_of(const SweepPlan& plan);

std::filesystem::path state_file(const std::filesystem::path& folder, const SweepPlan& plan,
                                 std::size_t point);
void write_final_state(const std::filesystem::path& folder, const SweepPlan& plan,
                       std::size_t point, FinalState state);
/// Nothing if the file is missing, damaged, or of another point. Throws FileError if it cannot be
/// read, or if another version of the program wrote it.
std::optional<FinalState> find_final_state(const std::filesystem::path& folder,
                                           const SweepPlan& plan, std::size_t point);

}  // namespace swirl
