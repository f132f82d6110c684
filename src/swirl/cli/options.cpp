#include "swirl/cli/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "swirl/run/failure.hpp"
#include "swirl/run/reading.hpp"

namespace swirl {

std::string one_of(const std::vector<std::string>& values) {
    return fmt::format("{}", fmt::join(values, "|"));
}

std::vector<std::string> values_of(const Option& option) {
    if (!option.values.empty()) return option.values;
    std::vector<std::string> values;
    const std::vector<std::string_view> parts = split(option.value_form, "|");
    const auto is_word = [](std::string_view part) {
        const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
        return !part.empty() && part.front() >= 'a' && part.front() <= 'z' &&
               std::none_of(part.begin(), part.end(), is_capital);
    };
    for (const std::string_view part : parts)
        if (parts.size() > 1 && is_word(part)) values.emplace_back(part);
    return values;
}

bool Subcommand::is_main(const Option& option) const {
    return main_options_.empty() || option.is_required || !option.name.starts_with('-') ||
           std::find(main_options_.begin(), main_options_.end(), option.name) !=
               main_options_.end();
}

void Subcommand::set_examples(const std::vector<std::string>& examples) {
    examples_ = "Examples:";
    for (const std::string& example : examples) examples_ += "\n  " + example;
}

std::int64_t whole_number(const char* name, const std::string& text, std::int64_t default_value,
                          std::int64_t maximum, std::int64_t minimum) {
    if (text.empty()) return default_value;
    const auto value = read_whole_number(text);
    if (!value || *value < minimum || *value > maximum)
        throw UsageError(fmt::format("{} is '{}', but it must be a whole number from {} to {}.",
                                     option_name(name), text, minimum, maximum));
    return *value;
}

}  // namespace swirl
