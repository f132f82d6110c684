// The options that describe a run, shared by all subcommands that make runs.
#pragma once

#include <memory>
#include <vector>

#include "swirl/cli/options.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {

/// Adds an option for each of run_parameters except those in `excluded`. After parsing, the
/// returned texts hold the given values; resolve() makes the configuration. `defaults` replace the
/// defaults of the table in the help; the caller must combine them with the given values
/// (overridden()).
std::shared_ptr<ParameterTexts> add_run_options(Subcommand& subcommand,
                                                const std::vector<std::string>& excluded = {},
                                                const ParameterTexts& defaults = {});

/// --measure
Option measure_option(std::string& list, const char* description);

}  // namespace swirl
