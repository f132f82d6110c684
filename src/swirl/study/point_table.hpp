// A table of points for a sweep: which runs does it describe?
//
// A row is a point. A column is a parameter, or `seeds`, the number of replicates of each row. A
// row with the parameter `seed` has that seed and the following ones; the seeds of other rows
// follow from their parameters, as in a product of lists. A table that grows gets further rows, and
// further replicates of the rows that it has. Parameters that were given for all rows hold for
// further rows, too.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "swirl/study/sweep_plan.hpp"

namespace swirl {

struct PointRow {
    std::string where;  // place for messages: "'points.csv', line 4"
    ParameterTexts parameters;
    std::int64_t replicas = 1;
};

/// The rows of a CSV file. Throws UsageError.
std::vector<PointRow> read_points(const std::string& file, std::int64_t replicas);

/// A row from its cells, which may include `seeds`. Throws UsageError.
PointRow point_row(std::string where, const ParameterTexts& cells, std::int64_t replicas);

/// Throws UsageError for a row that cannot be run, and for two rows with the same run. `where`: for
/// messages; by default the numbers of the rows.
void validate_rows(const SweepPlan& plan, const std::vector<std::string>& where = {});

/// `common`: single values for all rows. Throws UsageError, also for a row that cannot be run, and
/// for two rows with the same run.
SweepPlan make_plan(std::vector<PointRow> rows, const ParameterTexts& common);

/// The plan with further rows and replicates of rows. Throws UsageError, also if the rows or
/// `common` contradict the common parameters of the plan.
SweepPlan grown(const SweepPlan& plan, std::vector<PointRow> rows, const ParameterTexts& common,
                const std::vector<std::string>& measure);

/// The points of each row; none if the row is not in the plan.
std::vector<std::vector<std::size_t>> points_of_rows(const SweepPlan& plan,
                                                     std::vector<PointRow> rows);

}  // namespace swirl
