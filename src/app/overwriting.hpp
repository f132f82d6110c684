// What `swirl run` does about files that are there already: a result may have cost days, and is not
// overwritten unless that is asked for.
#pragma once

#include <string>

#include "swirl/run/recorded_run.hpp"

namespace swirl {

/// Asked to go on with --resume, but there is nothing left to do: the result is complete, of this
/// very run, and so are its recordings. `json` may be empty or "-".
bool is_done_already(const RunFiles& files, const std::string& json, const RunConfig& config);

/// Throws Failure if the run would begin anew over a finished result or recording, or over the
/// checkpoint of an interrupted one, without --overwrite.
void refuse_to_overwrite(const RunFiles& files, const std::string& json);

}  // namespace swirl
