// The table and the figure of a sweep, for the subcommands that make one.
#pragma once

#include <filesystem>
#include <string>

namespace swirl {

struct SweepStatus;

/// The options of `swirl collect`.
struct CollectCall {
    std::string folder, table, crossings, loops, quantity, my_points;
    bool plot = false, quiet = false;

    std::string table_file() const {
        return table.empty() ? (std::filesystem::path(folder) / "table.csv").string() : table;
    }
    /// A table on the standard output is alone there.
    bool prints_report() const {
        return !quiet && table_file() != "-" && crossings != "-" && loops != "-";
    }
};

/// Writes the tables, draws the figure and prints the report that a call asks for.
void collect(const CollectCall& call);

/// Writes DIR/table.csv, draws it, and prints how the points of `my_points` compare with its curves
/// (study/own_points.hpp), if that is not empty.
void draw_sweep(const std::string& folder, const std::string& my_points, bool quiet);

/// Prints a warning if results of the sweep are missing or not whole.
void warn_of_damaged_results(const SweepStatus& status, const std::string& folder);

}  // namespace swirl
