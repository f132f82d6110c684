// The options that say what is drawn or filmed: a recording, a run, a second dish beside it, or the
// minimal model.
#pragma once

#include <CLI/CLI.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lab/footage.hpp"
#include "lab/run_parameters.hpp"

namespace swirl {

struct FootageTexts {
    std::shared_ptr<ParameterTexts> parameters;
    std::string file;
    std::optional<std::int64_t> beside;
    std::optional<double> slip;
    double ball_radius = 0.5 * paper_container_radius;
};

std::shared_ptr<FootageTexts> add_footage_options(CLI::App& subcommand);

/// One dish or two. Throws WrongCall or Failure.
std::vector<Footage> footage(const FootageTexts& texts);

}  // namespace swirl
