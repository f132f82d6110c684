#include "swirl/run/parse_json.hpp"

#include <nlohmann/json.hpp>
#include <set>
#include <vector>

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;
using ParserEvent = Json::parse_event_t;

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

Json parse(const std::string& text, const Json::parser_callback_t& callback) {
    if (is_nested_too_deeply(text)) return Json::value_t::discarded;
    return Json::parse(text, callback, false);
}

}  // namespace

Json parse_json(const std::string& text) { return parse(text, nullptr); }

Json parse_json(const std::string& text, std::string& repeated_name) {
    std::vector<std::set<std::string>> names;  // names in the enclosing objects
    return parse(text, [&](int, ParserEvent event, const Json& part) {
        if (event == ParserEvent::object_start) names.emplace_back();
        if (event == ParserEvent::object_end) names.pop_back();
        if (event == ParserEvent::key && !names.back().insert(part.get<std::string>()).second &&
            repeated_name.empty())
            repeated_name = part.get<std::string>();
        return true;
    });
}

Json parse_json(const std::string& text, bool (*is_needed)(int depth, std::string_view name)) {
    return parse(text, [&](int depth, ParserEvent event, const Json& part) {
        return event != ParserEvent::key || is_needed(depth, part.get_ref<const std::string&>());
    });
}

}  // namespace swirl
