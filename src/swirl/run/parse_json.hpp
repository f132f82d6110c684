// Reads JSON from files, which may hold anything.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace swirl {

/// The value in a text; is_discarded() if the text is not JSON, or if its nesting would exhaust the
/// stack: the parser does not recurse, but copying, comparing and writing a value do.
nlohmann::ordered_json parse_json(const std::string& text);
/// Also sets the first name that an object gives twice: the parser takes one of both.
nlohmann::ordered_json parse_json(const std::string& text, std::string& repeated_name);
/// Only the parts whose names are needed; `depth` is 1 in the outermost object.
nlohmann::ordered_json parse_json(const std::string& text,
                                  bool (*is_needed)(int depth, std::string_view name));

}  // namespace swirl
