// The table of a sweep: the results of its runs, averaged over the replicas.
#pragma once

#include <array>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "swirl/io/table.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/study/hysteresis.hpp"
#include "swirl/study/sweep_plan.hpp"

namespace swirl {

struct CollectedRow {
    ParameterTexts parameters;
    std::array<Estimate, rotation_rates.size()> rotation = {};  // means over the replicas
};

struct CollectedSweep {
    Table table;
    std::vector<CollectedRow> rows = {};
    std::vector<LoopAreas> loops = {};  // empty unless a chain (hysteresis.hpp)
    std::vector<std::string> loop_quantities = {};
    std::size_t disagreeing = 0;      // rows whose replicas scatter more than their errors explain
    std::size_t with_short_runs = 0;  // rows with a run too short to count (replicates.hpp)
    std::size_t not_steady = 0;       // rows with a replica that is not steady or too short to test
    std::size_t without_period = 0;   // runs without a whole period after the warm-up
    std::set<std::string> versions = {};  // programs that made the runs
};

/// One row for each combination of parameters: the mean over the finished replicas and its standard
/// error within and between them (statistics/replicates.hpp), for the rotation and every measured
/// number. Further columns: whether all replicas are steady, and the scatter of their rotation by
/// time in units of their errors. The table does not depend on which process made which run. Throws
/// FileError for a damaged result and for one of another version.
CollectedSweep collect_sweep(const std::filesystem::path& folder, const SweepPlan& plan);

/// The value of a parameter in a table: a number if the text is one.
Table::Cell cell_of(const std::string& text);

/// "at 2 of 40 rows, the replicates scatter more …", for sweeps and searches.
std::string disagreement_warning(std::int64_t count, const std::string& of_what);

/// Reasons to distrust the table, as warnings.
std::vector<std::string> warnings(const CollectedSweep& collected);

/// The sign changes of the rotation in a collected sweep (statistics/zero_crossing.hpp), by time
/// and by the other rates: a row for each combination of the parameters other than the number of
/// discs. Throws UsageError if the number of discs is not a parameter of the sweep.
Table crossings_in(const SweepPlan& plan, const CollectedSweep& collected);

}  // namespace swirl
