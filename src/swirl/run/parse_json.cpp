#include "swirl/run/parse_json.hpp"

namespace swirl {
namespace {

bool is_nested_too_deeply(const std::string& text) {
    constexpr int deepest = 100;  // a result has fewer than 10 levels
    int depth = 0;
    bool is_quoted = false;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const char c = text[k];
        if (c == '"') is_quoted = !is_quoted;
        if (is_quoted && c == '\\') ++k;
        if (is_quoted) continue;
        if ((c == '[' || c == '{') && ++depth > deepest) return true;
        if (c == ']' || c == '}') --depth;
    }
    return false;
}

}  // namespace

nlohmann::ordered_json parse_json(const std::string& text,
                                  const nlohmann::ordered_json::parser_callback_t& callback) {
    if (is_nested_too_deeply(text)) return nlohmann::ordered_json::value_t::discarded;
    return nlohmann::ordered_json::parse(text, callback, false);
}

bool RepeatedNames::operator()(int, nlohmann::ordered_json::parse_event_t event,
                               nlohmann::ordered_json& part) {
    using Event = nlohmann::ordered_json::parse_event_t;
    if (event == Event::object_start) names_.emplace_back();
    if (event == Event::object_end) names_.pop_back();
    if (event == Event::key && !names_.back().insert(part.get<std::string>()).second &&
        first_.empty())
        first_ = part.get<std::string>();
    return true;
}

}  // namespace swirl
