// A run that leaves files behind while it goes on: frames, events, and checkpoints from which it
// can be resumed. Nothing of it changes a bit of the trajectory or of the result.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "swirl/io/trajectory.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/run.hpp"

namespace swirl {

/// When frames are taken. Each frame is the exact state at the exact time.
struct FrameTimes {
    int per_swirl = 30;                  // by phase: k T / per_swirl; 1 is stroboscopic
    std::optional<double> interval;      // or by time
    std::optional<std::int64_t> events;  // or the state after every so many events
};

struct RunFiles {
    std::filesystem::path trajectory;  // empty: none
    FrameTimes frames;
    int compression = default_compression;
    std::filesystem::path event_log;  // empty: none

    std::filesystem::path checkpoint;  // empty: none
    double checkpoint_every = 60.0;    // seconds
    /// Not asked for: if it cannot be written, the run goes on without, and `complain` says so.
    bool checkpoint_needed = true;
    std::function<void(const std::string&)> complain;
    bool resume = false;  // from the checkpoint, if it is there
    /// The state at the end is kept too, for who wants more of the run.
    bool keep_checkpoint = false;
    /// Begin anew over the unfinished recording of another run; a checkpoint that is there is kept
    /// under backup_name().
    bool overwrite = false;
    /// Options and what was given, kept in the checkpoint for who resumes with nothing else.
    ParameterTexts call;
};

/// What a checkpoint says about the run it belongs to.
struct KeptCall {
    std::string configuration;  // the text of config_json()
    ParameterTexts options;     // RunFiles::call
    bool overwrites = false;    // it began anew over what was there under these names
    std::string run;            // what its recordings name it
};
KeptCall call_in_checkpoint(const std::filesystem::path& checkpoint);

/// Throws FileError, or WrongCall if the checkpoint belongs to another run. The files get their
/// names when the run is complete; the checkpoint stays until forget_checkpoint(), so that nothing
/// is lost before the result is on the disk too.
RunResult run_recorded(const RunConfig& config, const RunFiles& files, const RunControl& control,
                       const Provenance& provenance);

/// What a trajectory with these frames says of them.
std::string frames_entry(const RunFiles& files);

void forget_checkpoint(const RunFiles& files);

/// Where a checkpoint is kept when a run begins anew over it: NAME.backup, or NAME.backup-2, -3, …,
/// the first that is not there.
std::filesystem::path backup_name(const std::filesystem::path& checkpoint);

/// Version, build, resolved parameters, seed and generator; the command and the configuration file
/// where there are any.
Provenance provenance_of(const RunConfig& config, const std::string& command,
                         const std::string& config_text);

}  // namespace swirl
