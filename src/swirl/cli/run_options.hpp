// The options that describe a run, the same for every subcommand that needs one.
#pragma once

#include <memory>
#include <vector>

#include "swirl/cli/options.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {

/// Adds one option for every one of run_parameters but those named in `without`. After parsing,
/// what was given stands in the texts returned; resolve() makes the configuration of it. Where
/// `defaults` has another default than the row, help says so; the caller overrides them
/// (overridden) with what was given.
std::shared_ptr<ParameterTexts> add_run_options(Subcommand& subcommand,
                                                const std::vector<std::string>& without = {},
                                                const ParameterTexts& defaults = {});

}  // namespace swirl
