// Reading the results of points, and the columns that tables have in common.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "swirl/io/table.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// True if this is the result of a run that failed.
bool failed(const Json& result);

/// result["a"]["b"]…, or null if it does not exist, as in the result of a failed run.
const Json& at(const Json& result, std::initializer_list<std::string_view> path);

/// A number; NaN for null.
double number(const Json& value);
/// An integer as a table cell; an empty cell for null.
Table::Cell whole(const Json& value);
/// The means and errors of an average, as two cells.
void add_mean(std::vector<Table::Cell>& row, const Json& average);

/// "steady", "drifting", "jumping", "switching", "too short to tell", or "failed".
std::string steadiness(const Json& result);

/// Columns for these measured quantities and their errors. A quantity is "slip.cluster"; its column
/// is "cluster", or what follows a "=", as in "slip.stays=slip_resident".
std::vector<std::string> number_columns(const std::vector<std::string>& quantities);
void add_numbers(std::vector<Table::Cell>& row, const std::vector<std::string>& quantities,
                 const Json& result);

/// `front` followed by `back`.
std::vector<std::string> joined(std::vector<std::string> front,
                                const std::vector<std::string>& back);

}  // namespace swirl
