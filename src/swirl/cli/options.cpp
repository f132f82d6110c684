#include "swirl/cli/options.hpp"

#include <algorithm>

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

std::string Subcommand::footer() const {
    return explanation_ ? explanation_() + "\n" + examples_ : examples_;
}

}  // namespace swirl
