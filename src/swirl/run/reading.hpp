// Numbers and names as people write them, the same for options, configuration files and tables.
//
// A name is one word with underscores in files and in code (mu_disc), and the same with hyphens as
// an option (--mu-disc). Both spellings are read everywhere.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace swirl {

/// Reads a finite number ("0.5", "1e6"), or a whole one that fits 64 bits; nothing otherwise.
std::optional<double> read_number(std::string_view text);
std::optional<std::int64_t> read_whole_number(std::string_view text);

/// "mu_disc", however it was spelled.
std::string plain_name(std::string_view name);
/// "--mu-disc"
std::string option_name(std::string_view name);

/// The name nearest to `wrong`, if any is near enough to be what was meant.
std::optional<std::string> nearest_name(std::string_view wrong,
                                        const std::vector<std::string>& names);

}  // namespace swirl
