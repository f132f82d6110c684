// Reads a number from text, in the same way for options, configuration files and tables.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace swirl {

/// A finite number ("0.5", "1e6"); nothing otherwise.
std::optional<double> read_number(std::string_view text);

/// The text without spaces, tabs and carriage returns at its ends.
std::string_view trimmed(std::string_view text);

/// The text with A to Z in lower case.
std::string in_lower_case(std::string_view text);

}  // namespace swirl
