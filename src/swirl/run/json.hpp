// A run's configuration and result as JSON: the names are those of the options, the numbers those
// of docs/physics.md, each written so that reading it back gives the same double. What is not known
// (an error from too few blocks) is null.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "swirl/measure/measurement_report.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/result.hpp"

namespace swirl {

/// Every parameter, resolved, in the order of `swirl run --help`.
nlohmann::ordered_json config_json(const RunConfig& config);

/// The same as one line of text.
std::string config_text(const RunConfig& config);

/// The parameters that resolve() to that configuration again. The text is what somebody else may
/// have written: throws WrongCall if it is no configuration.
ParameterTexts parameters_in(const nlohmann::ordered_json& config);
ParameterTexts parameters_in(const std::string& config);

/// {"mean", "error", "effective_samples", "blocks"}
nlohmann::ordered_json estimate_json(const Estimate& estimate);

/// That of its estimate and its details; a number alone where it has no error.
nlohmann::ordered_json row_json(const ReportRow& row);

nlohmann::ordered_json result_json(const RunResult& result);

}  // namespace swirl
