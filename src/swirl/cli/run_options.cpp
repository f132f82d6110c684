#include "swirl/cli/run_options.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace swirl {

std::shared_ptr<ParameterTexts> add_run_options(Subcommand& subcommand,
                                                const std::vector<std::string>& without,
                                                const ParameterTexts& defaults) {
    auto texts = std::make_shared<ParameterTexts>();
    for (const Parameter& p : run_parameters) {
        if (!p.can_be_given()) continue;
        if (std::find(without.begin(), without.end(), p.name) != without.end()) continue;
        const std::string name = p.name;
        const auto other = defaults.find(name);
        const std::string by_default = other == defaults.end() ? default_of(p) : other->second;
        subcommand
            .add_option_function(
                option_name(name),
                [texts, name](const std::string& text) { (*texts)[name] = text; },
                by_default.empty() ? p.description
                                   : fmt::format("{} [{}]", p.description, by_default))
            ->type_name(p.form)
            ->group(p.group);
    }
    return texts;
}

}  // namespace swirl
