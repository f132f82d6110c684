#include "swirl/app/run_options.hpp"

#include <algorithm>

namespace swirl {

std::shared_ptr<ParameterTexts> add_run_options(CLI::App& subcommand,
                                                const std::vector<std::string>& without) {
    auto texts = std::make_shared<ParameterTexts>();
    for (const RunParameter& p : run_parameters()) {
        if (std::find(without.begin(), without.end(), p.name) != without.end()) continue;
        const std::string name = p.name;
        subcommand
            .add_option_function<std::string>(
                "--" + name, [texts, name](const std::string& text) { (*texts)[name] = text; },
                p.description)
            ->type_name(p.value)
            ->group(p.group);
    }
    return texts;
}

}  // namespace swirl
