// Reads numbers and names from text, in the same way for options, configuration files and tables;
// and writes some.
//
// A name has underscores in files and in code (mu_disc), and hyphens as an option (--mu-disc). Both
// spellings are accepted everywhere, and so are colour and color, centre and center.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "swirl/io/read_number.hpp"
#include "swirl/run/message.hpp"

namespace swirl {

/// A whole number that fits into 64 bits ("12", "1e6"); nothing otherwise.
std::optional<std::int64_t> read_whole_number(std::string_view text);

/// The parts between separators, any of these characters. Parts may be empty.
std::vector<std::string_view> split(std::string_view text, std::string_view separators);

/// "mu_disc" for both spellings; "color" and "centre" for British and American ones.
std::string plain_name(std::string_view name);
/// "--mu-disc"
std::string option_name(std::string_view name);

/// "1 disc", "48 discs"
std::string counted(std::int64_t number, std::string_view noun);

/// The name that the user probably means: first one of equal meaning ("json" for "out"), then the
/// one with the smallest edit distance, then the only one that begins with `unknown`. The distance
/// must not exceed 2 or a third of the length of `unknown`, whichever is larger, and must be less
/// than half of the length of the longer name. Dashes at the start do not count.
std::optional<std::string> nearest_name(std::string_view unknown,
                                        const std::vector<std::string>& names);

/// Adds the hint "did you mean 'disc'?" if a name is near.
void add_nearest_value(Message& message, std::string_view text,
                       const std::vector<std::string>& names);
/// The same hint as text; "" if none is near.
std::string nearest_value_hint(std::string_view text, const std::vector<std::string>& names);

}  // namespace swirl
