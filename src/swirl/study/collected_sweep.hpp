// The table of a sweep: what its runs found, over the replicas.
#pragma once

#include <array>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "swirl/io/table.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/study/sweep_plan.hpp"

namespace swirl {

struct CollectedRow {
    ParameterTexts parameters;
    std::array<Estimate, rotation_rates.size()> rotation = {};  // over the replicas
};

struct CollectedSweep {
    Table table;
    std::vector<CollectedRow> rows = {};
    std::size_t disagreeing = 0;  // whose replicas scatter more than their own errors can explain
    std::size_t not_steady = 0;   // with a replica that is not steady or too short to tell
    /// Runs without a whole swirl after the warm-up: there is nothing to average of them.
    std::size_t without_swirl = 0;
    std::set<std::string> versions = {};  // of the programs that made the runs
};

/// One row for each combination of parameters: mean over the replicas that are done, and its
/// standard error within and between them (statistics/replicates.hpp), of the rotation and of every
/// number that was measured; whether all are steady; and the scatter of the replicas' rotation by
/// time in units of their own errors. The same bytes whoever did the work. Throws FileError for a
/// result that is damaged or of another version.
CollectedSweep collect_sweep(const std::filesystem::path& folder, const SweepPlan& plan);

/// Where the rotation of a collected sweep changes its sign (statistics/zero_crossing.hpp), by time
/// and by the other rates: a row for each combination of the parameters but the number of discs.
/// Throws WrongCall if that is none of them.
Table crossings_in(const SweepPlan& plan, const CollectedSweep& collected);

}  // namespace swirl
