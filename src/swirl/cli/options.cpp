#include "swirl/cli/options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "swirl/run/failure.hpp"
#include "swirl/run/reading.hpp"

namespace swirl {

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
