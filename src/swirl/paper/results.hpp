// Reading the results of points, and the columns that tables have in common.
#pragma once

#include <nlohmann/json.hpp>

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "swirl/io/table.hpp"
#include "swirl/paper/paper.hpp"

namespace swirl {

/// True if this is the result of a run that failed.
bool failed(const Json& result);

/// result["a"]["b"]…, or null if it does not exist, as in the result of a failed run.
const Json& at(const Json& result, std::initializer_list<std::string_view> path);

/// A number; NaN for null.
double number(const Json& value);
/// An integer as a table cell; an empty cell for null.
Table::Cell whole(const Json& value);
/// "0.123 ± 0.004" from an object with "mean" and "error"; "n/a" if it has none.
std::string mean_in_words(const Json& average);
/// The means and errors of an average, as two cells.
void add_mean(std::vector<Table::Cell>& row, const Json& average);

/// The columns about the rotation, in the order of add_rotation(); empty cells for a failed run.
std::vector<std::string> rotation_columns();
void add_rotation(std::vector<Table::Cell>& row, const Json& result);
/// Number of runs behind its averages. Their errors have one degree of freedom fewer
/// (paper/verdicts.py).
Table::Cell averaged_runs(const Json& result);
/// The name of its point, by which verdicts ask for more seeds.
std::string name_of_point(const Json& result);
/// "steady", "drifting", "jumping", "switching", "too short to tell", or "failed".
std::string steadiness(const Json& result);

/// Columns for these measured quantities and their errors. A quantity is "slip.cluster"; its column
/// is "cluster", or what follows a "=", as in "slip.stays=slip_resident".
std::vector<std::string> number_columns(const std::vector<std::string>& quantities);
void add_numbers(std::vector<Table::Cell>& row, const std::vector<std::string>& quantities,
                 const Json& result);

void add_estimate(std::vector<Table::Cell>& row, const Estimate& estimate);

/// `front` followed by `back`.
std::vector<std::string> joined(std::vector<std::string> front,
                                const std::vector<std::string>& back);

}  // namespace swirl
