// The options for the files that a run writes, and the run as a configuration file.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "swirl/cli/options.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/recorded_run.hpp"

namespace swirl {

/// The options of the group Files, such as --trajectory, and the configuration file.
struct RecordingCall {
    std::string config_file;
    ParameterTexts texts;  // values by option name
    bool resume = false, overwrite = false, keep_checkpoint = false;
};

std::shared_ptr<RecordingCall> add_recording_options(Subcommand& subcommand);

/// The names of these options in a configuration file.
std::vector<std::string> recording_option_names();
/// Adds the options of a configuration file that the command line does not give.
void add_options_from_file(RecordingCall& recording, ParameterTexts from_file);

/// Checks the options and names the files. `json` is the file of the result. The checkpoint is
/// named after it, or after another file of the run, or after the parameters and the measurements.
RunFiles run_files(const RecordingCall& recording, const RunConfig& config,
                   const std::vector<std::string>& measured, const std::string& json);

/// The run as a configuration file.
std::string config_file_text(const RunConfig& config, const RecordingCall& recording,
                             const std::map<std::string, std::string*>& others);

}  // namespace swirl
