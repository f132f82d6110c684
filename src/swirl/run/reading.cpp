#include "swirl/run/reading.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "swirl/run/failure.hpp"

namespace swirl {

std::optional<std::int64_t> read_whole_number(std::string_view text) {
    std::int64_t whole_value = 0;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, whole_value);
    if (error == std::errc() && end == last) return whole_value;
    const auto value = read_number(text);  // "1e6"
    if (!value || std::trunc(*value) != *value || std::fabs(*value) > 1e18) return {};
    return static_cast<std::int64_t>(*value);
}

std::optional<ImageSides> read_image_size(std::string_view text) {
    const auto sides = split(text, "x");
    if (sides.size() != 2) return {};
    const auto width = read_whole_number(sides[0]), height = read_whole_number(sides[1]);
    if (!width || !height) return {};
    return ImageSides{*width, *height};
}

std::vector<std::string_view> split(std::string_view text, std::string_view separators) {
    std::vector<std::string_view> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
        parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

std::string counted(std::int64_t number, std::string_view noun) {
    return std::to_string(number) + " " + std::string(noun) + (number == 1 ? "" : "s");
}

void add_nearest_value(Message& message, std::string_view text,
                       const std::vector<std::string>& names) {
    if (const auto nearest = nearest_name(text, names))
        message += Message("did_you_mean", {{"name", *nearest}});
}

std::string nearest_value_hint(std::string_view text, const std::vector<std::string>& names) {
    const auto nearest = nearest_name(text, names);
    return nearest ? Message("did_you_mean", {{"name", *nearest}}).english() : "";
}

void reject_choice(std::string_view name, std::string_view text,
                   const std::vector<std::string>& choices) {
    Message message("not_a_choice",
                    {{"name", option_name(name)}, {"text", text}, {"choices", choices}});
    add_nearest_value(message, text, choices);
    throw_usage_error(message);
}

}  // namespace swirl
