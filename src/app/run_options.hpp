// The options that describe a run, the same for every subcommand that needs one.
#pragma once

#include <CLI/CLI.hpp>

#include <memory>
#include <vector>

#include "swirl/run/parameters.hpp"

namespace swirl {

/// Adds one option for every one of run_parameters() but those named in `without`. After parsing,
/// what was given stands in the texts returned; resolve() makes the configuration of it.
std::shared_ptr<ParameterTexts> add_run_options(CLI::App& subcommand,
                                                const std::vector<std::string>& without = {});

}  // namespace swirl
