// The options of the files that a run leaves behind, and the configuration file it may come from.
#pragma once

#include <CLI/CLI.hpp>

#include <memory>
#include <string>

#include "swirl/run/parameters.hpp"
#include "swirl/run/recorded_run.hpp"

namespace swirl {

/// --trajectory, --log-events, --checkpoint … and the configuration file.
struct RecordingCall {
    std::string config_file;
    ParameterTexts texts;  // names of options and what was given
    bool resume = false, overwrite = false;
};

std::shared_ptr<RecordingCall> add_recording_options(CLI::App& subcommand);

/// Reads the configuration file, if one was given, and adds what it says to what the command line
/// did not say: to `parameters`, to the recording, and to `others` (further options, whose names
/// must be in there). Returns the text of the file. Throws WrongCall for names that do not exist.
std::string take_config_file(RecordingCall& recording, ParameterTexts& parameters,
                             std::map<std::string, std::string*> others);

/// `json` is where the result goes: the checkpoint is named after it, or after another file of the
/// run, or after its parameters.
RunFiles run_files(const RecordingCall& recording, const RunConfig& config,
                   const std::string& json);

/// What a run would be, as a configuration file.
std::string config_file_text(const RunConfig& config, const RecordingCall& recording,
                             const std::map<std::string, std::string*>& others);

}  // namespace swirl
