// The options of the files that a run leaves behind, and the run as a configuration file.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "swirl/cli/options.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/recorded_run.hpp"

namespace swirl {

/// --trajectory, --log-events, --checkpoint … and the configuration file.
struct RecordingCall {
    std::string config_file;
    ParameterTexts texts;  // names of options and what was given
    bool resume = false, overwrite = false, keep_checkpoint = false;
};

std::shared_ptr<RecordingCall> add_recording_options(Subcommand& subcommand);

/// The names of the options above, as they stand in a configuration file.
std::vector<std::string> recording_option_names();
/// Adds what a file says to what the command line did not say.
void take_recording_options(RecordingCall& recording, ParameterTexts from_file);

/// `json` is where the result goes: the checkpoint is named after it, or after another file of the
/// run, or after its parameters and what is `measured`.
RunFiles run_files(const RecordingCall& recording, const RunConfig& config,
                   const std::vector<std::string>& measured, const std::string& json);

/// What a run would be, as a configuration file.
std::string config_file_text(const RunConfig& config, const RecordingCall& recording,
                             const std::map<std::string, std::string*>& others);

}  // namespace swirl
