// A run that also writes files: frames, events, and checkpoints from which it can be resumed. None
// of this changes the trajectory or the result.
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

/// The times of the frames: at equal phases, unless `interval` or `events` is given. Each frame is
/// the exact state at the exact time.
struct FrameTimes {
    int per_period = 30;                 // frames at k T / per_period; 1 is stroboscopic
    std::optional<double> interval;      // time between frames
    std::optional<std::int64_t> events;  // number of events between frames
};

struct RunFiles {
    std::filesystem::path trajectory;  // empty: none
    FrameTimes frames;
    int compression = default_compression;
    std::filesystem::path event_log;  // empty: none
    /// Table of the averages of every period (RunControl::series is then set); empty: none. Written
    /// at the end of the run, also if it is stopped.
    std::filesystem::path series;

    std::filesystem::path checkpoint;  // empty: none
    double checkpoint_every = 60.0;    // seconds
    /// If false and a checkpoint cannot be written, the run continues without checkpoints and calls
    /// `warn`.
    bool checkpoint_needed = true;
    std::function<void(const std::string&)> warn;
    bool resume = false;  // continue from the checkpoint, if it exists
    /// Also write a checkpoint at the end, from which the run can be extended.
    bool keep_checkpoint = false;
    /// Start again and replace the unfinished recording of another run. An existing checkpoint is
    /// renamed to backup_name().
    bool overwrite = false;
    /// The files are part of a folder of runs, and not named by the user.
    bool in_folder_of_runs = false;
    /// The options of the call, stored in the checkpoint so that --resume needs no other option.
    ParameterTexts call;
};

/// The part of a checkpoint that identifies its run.
struct CheckpointedCall {
    std::string configuration;  // the text of config_json()
    ParameterTexts options;     // RunFiles::call
    bool overwrites = false;    // the run was started with RunFiles::overwrite
    std::string run;            // the run's name in its recordings
};
CheckpointedCall call_in_checkpoint(const std::filesystem::path& checkpoint);

/// Throws FileError, or UsageError if the checkpoint belongs to another run. Recordings are
/// published when the run is complete. The checkpoint stays until remove_checkpoint(), so that
/// nothing is lost before the result is on the disk, too.
RunResult run_recorded(const RunConfig& config, const RunFiles& files, const RunControl& control,
                       const Provenance& provenance);

/// True if the trajectory of this run is there, complete, and not cut off. Throws FileError if it
/// cannot be read.
bool has_whole_trajectory(const RunConfig& config, const RunFiles& files);

/// The provenance entry `frames` of a trajectory with these frame times.
std::string frames_entry(const RunFiles& files);

void remove_checkpoint(const RunFiles& files);

/// The new name of a checkpoint when a run starts again: NAME.backup, NAME.backup-2, -3, …, the
/// first that does not exist.
std::filesystem::path backup_name(const std::filesystem::path& checkpoint);

/// Version, build, resolved parameters, seed, generator, command, and text of the configuration
/// file (empty if there is none).
Provenance provenance_of(const RunConfig& config, const std::string& command,
                         const std::string& config_text);

}  // namespace swirl
