// How `swirl run` treats existing files. A result may have taken days, so it is overwritten only on
// request.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "swirl/run/recorded_run.hpp"

namespace swirl {

/// True if a call with --resume has nothing left to do: the result is complete, belongs to this
/// run, has all `measured` quantities, and its recordings and tables exist. `json` may be empty or
/// "-".
bool is_done_already(const RunFiles& files, const std::string& json, const RunConfig& config,
                     const std::vector<std::string>& measured,
                     const std::vector<std::filesystem::path>& tables);

/// Without --overwrite, throws Failure if the run would replace a finished result, a recording, or
/// the checkpoint of an interrupted run; or if it would continue over the files of another run.
void reject_overwriting(const RunFiles& files, const std::string& json, const RunConfig& config);

/// Writes the result of a finished run and returns the name of the file. This is `json`, or
/// NAME.second if another process has meanwhile written something there that this result must not
/// replace: the result of another run, more measurements, or a complete result while this run was
/// stopped.
std::filesystem::path write_result(const RunFiles& files, const std::string& json,
                                   const nlohmann::ordered_json& result);

}  // namespace swirl
