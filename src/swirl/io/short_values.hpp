// Messages quote what the user gave, which may be a megabyte.
#pragma once

#include <string>
#include <string_view>

namespace swirl {

/// The most characters of a value in a message, and of a text with a slash, which may be a path.
inline constexpr std::size_t max_quoted = 80, max_quoted_path = 400;

/// The text, or its beginning and its end with "..." between them if it has more characters.
std::string shortened(std::string_view text, std::size_t max_characters = max_quoted);

/// The message with its quoted values, and words without quotation marks, shortened. All exceptions
/// with a message for the user call it.
std::string with_short_values(std::string_view message);

}  // namespace swirl
