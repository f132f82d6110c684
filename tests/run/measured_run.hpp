// A run with its measurements as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "swirl/run/measurements.hpp"

namespace swirl {

struct MeasuredRun {
    RunResult run;
    nlohmann::ordered_json measured;
};

inline MeasuredRun measured_run(const RunConfig& config, const std::vector<std::string>& names) {
    Observation observation = observation_of(config, names);
    RunControl control;
    if (!names.empty()) control.observation = &observation;
    const RunResult result = run(config, control);
    return {result, measured_json(observation.report())};
}

}  // namespace swirl
