// The table and the figure of a complete sweep, for the subcommands that make one.
#pragma once

#include <string>

namespace swirl {

/// Writes DIR/table.csv, draws it, and prints how the points of `my_points` compare with its curves
/// (study/own_points.hpp), if that is not empty.
void draw_sweep(const std::string& folder, const std::string& my_points, bool quiet);

}  // namespace swirl
