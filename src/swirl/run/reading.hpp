// Reads numbers and lists from text, in the same way for options, configuration files and tables;
// and writes some.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "swirl/io/read_number.hpp"
#include "swirl/run/message.hpp"
#include "swirl/run/names.hpp"

namespace swirl {

/// A whole number that fits into 64 bits ("12", "1e6"); nothing otherwise.
std::optional<std::int64_t> read_whole_number(std::string_view text);

/// Width and height in pixels.
struct ImageSides {
    std::int64_t width = 0, height = 0;
};
/// Reads "1280x720"; nothing for any other text.
std::optional<ImageSides> read_image_size(std::string_view text);

/// The parts between separators, any of these characters. Parts may be empty.
std::vector<std::string_view> split(std::string_view text, std::string_view separators);

/// "1 disc", "48 discs"
std::string counted(std::int64_t number, std::string_view noun);

/// Adds the hint "did you mean 'disc'?" if a name is near.
void add_nearest_value(Message& message, std::string_view text,
                       const std::vector<std::string>& names);
/// The same hint as text; "" if none is near.
std::string nearest_value_hint(std::string_view text, const std::vector<std::string>& names);
/// Throws UsageError: the value of the option `name` must be one of `choices`.
[[noreturn]] void reject_choice(std::string_view name, std::string_view text,
                                const std::vector<std::string>& choices);

}  // namespace swirl
