// What `swirl run` does about files that are there already: a result may have cost days, and is not
// overwritten unless that is asked for.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "swirl/run/recorded_run.hpp"

namespace swirl {

/// Asked to go on with --resume, but there is nothing left to do: the result is complete, of this
/// very run, with all that is to be measured, and so are its recordings and tables. `json` may be
/// empty or "-".
bool is_done_already(const RunFiles& files, const std::string& json, const RunConfig& config,
                     const std::vector<std::string>& measured,
                     const std::vector<std::filesystem::path>& tables);

/// Throws Failure if the run would begin anew over a finished result or recording, or over the
/// checkpoint of an interrupted one, without --overwrite; or if it would go on over those of
/// another run.
void reject_to_overwrite(const RunFiles& files, const std::string& json);

/// Writes the result of a run that has ended and returns where it went: to `json`, or beside it if
/// another run has left there meanwhile, if only at the same instant, what this one does not have:
/// another run's result, one with further measurements, or a complete one where this was stopped.
std::filesystem::path write_result(const RunFiles& files, const std::string& json,
                                   const nlohmann::ordered_json& result);

}  // namespace swirl
