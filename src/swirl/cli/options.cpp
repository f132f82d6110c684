#include "swirl/cli/options.hpp"

namespace swirl {

void Subcommand::set_examples(const std::vector<std::string>& examples) {
    examples_ = "Examples:";
    for (const std::string& example : examples) examples_ += "\n  " + example;
}

std::string Subcommand::footer() const {
    return explanation_.empty() ? examples_ : explanation_ + "\n" + examples_;
}

}  // namespace swirl
