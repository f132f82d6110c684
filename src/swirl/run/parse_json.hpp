// Reads JSON from files, which may hold anything.
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace swirl {

/// The value in a text; is_discarded() if the text is not JSON, or if its nesting would exhaust the
/// stack: the parser does not recurse, but copying, comparing and writing a value do.
nlohmann::ordered_json parse_json(
    const std::string& text, const nlohmann::ordered_json::parser_callback_t& callback = nullptr);

/// A callback that notes the first name that an object gives twice: the parser takes one of both.
class RepeatedNames {
  public:
    bool operator()(int depth, nlohmann::ordered_json::parse_event_t event,
                    nlohmann::ordered_json& part);
    const std::string& first() const { return first_; }

  private:
    std::vector<std::set<std::string>> names_;  // names in the enclosing objects
    std::string first_;
};

}  // namespace swirl
