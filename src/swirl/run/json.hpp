// Configuration and result of a run as JSON. The keys are the names of the options. A number that
// is read back gives the same double. Unknown values, such as an error from too few blocks, are
// null.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "swirl/measure/measurement_report.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/period_series.hpp"
#include "swirl/run/result.hpp"

namespace swirl {

/// All parameters, resolved, in the order of `swirl run --help`.
nlohmann::ordered_json config_json(const RunConfig& config);

/// config_json() as one line of text.
std::string config_text(const RunConfig& config);

/// The parameters from which resolve() makes this configuration. The text may come from a file:
/// throws UsageError if it is not a configuration.
ParameterTexts parameters_in(const nlohmann::ordered_json& config);
ParameterTexts parameters_in(const std::string& config);

/// {"mean", "error", "effective_samples", "blocks"}
nlohmann::ordered_json estimate_json(const Estimate& estimate);

/// estimate_json() with the details of the row, or a number if the row has no error.
nlohmann::ordered_json row_json(const ReportRow& row);

nlohmann::ordered_json result_json(const RunResult& result);

/// {"r", "v", "m"}: the units of all numbers, in the units of the configuration.
nlohmann::ordered_json units_json(const MeasuredUnits& units);

/// {"periods", "averages": {NAME: estimate_json() with "unit", "autocorrelation_time" and, without
/// ramps, "fluctuations"}}
nlohmann::ordered_json series_json(const PeriodSeries& series);

}  // namespace swirl
