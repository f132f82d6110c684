// The parameter --motion: its texts, and the container's path that follows from a configuration.
//
//     polygon | circle | line | ellipse:RATIO | lissajous:P:Q[:DEGREES] | points T:X:Y T:X:Y …
//
// "points" holds the whole path, so that a configuration does not depend on a file. A file name is
// replaced by the points in the file (parameter_files.hpp) before the text is read here.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "swirl/physics/container_path.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {

/// A larger path makes every configuration and every result file large.
inline constexpr std::size_t max_path_points = 20'000;

/// True for the words and forms above, whatever their numbers; otherwise a text is a file name.
bool is_path_shape(std::string_view text);

/// Why the path of this configuration is not possible; nothing if it is.
std::optional<Message> problem_with_path(const RunConfig& config);

/// Events at vertices of the path in one period.
std::int64_t path_vertices(const RunConfig& config);

/// Largest distance of the container's centre from the swirl centre.
double path_reach(const RunConfig& config);

/// The M-frame exists if the container moves round the swirl centre at a nearly constant distance
/// and angular velocity: on the polygon, on the circle, and on a path from points
/// that is within 10 % of such a circle. A container at rest has one by convention.
bool has_m_frame(const RunConfig& config);

/// If parameters exclude each other, removes those that only the file gives: a path from points has
/// its own amplitude and period, and neither it nor a circle has sides.
void keep_path_or_sides(ParameterTexts& texts, const ParameterTexts& command_line);

}  // namespace swirl
