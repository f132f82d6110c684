#include "swirl/cli/run_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "swirl/run/measurements.hpp"
#include "swirl/run/parameter_files.hpp"

namespace swirl {

std::shared_ptr<ParameterTexts> add_run_options(Subcommand& subcommand,
                                                const std::vector<std::string>& excluded,
                                                const ParameterTexts& defaults) {
    auto texts = std::make_shared<ParameterTexts>();
    std::vector<std::string> missing;
    for (const Parameter& p : run_parameters) {
        if (!p.is_settable()) continue;
        if (std::find(excluded.begin(), excluded.end(), p.name) != excluded.end()) {
            missing.push_back(option_name(p.name));
            continue;
        }
        const std::string name = p.name;
        const auto other = defaults.find(name);
        const std::string default_text = other == defaults.end() ? default_of(p) : other->second;
        const auto take = [texts, name](const std::string& text) {
            (*texts)[name] = with_file_contents(name, text);
        };
        const std::string shown_default =
            default_text.empty() ? "" : fmt::format(" [{}]", default_text);
        Option option{option_name(name), take, p.description + shown_default, p.form};
        option.is_of_run = other == defaults.end();
        if (name == "ramp") option.joined_by = ';';
        subcommand.in(p.group).add_one(std::move(option));
    }
    subcommand.refer_to_run(std::move(missing));
    return texts;
}

Option measure_option(std::string& list, const char* description) {
    Option option{"--measure", &list, description, "LIST"};
    for (const MeasurementKind& kind : measurement_kinds()) option.values.emplace_back(kind.name);
    option.values.emplace_back("all");
    return option;
}

}  // namespace swirl
