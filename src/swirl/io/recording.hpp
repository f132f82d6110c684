// Functions for trajectories and event logs while they are recorded. Until a recording is complete
// its name is NAME.partial. The provenance entry `run` identifies the run it belongs to:
// recordings with the same entry contain the same frames and events.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "swirl/io/hdf5.hpp"

namespace swirl {

inline constexpr const char* run_entry = "run";

/// The name of a recording until it is complete.
std::filesystem::path partial_name(const std::filesystem::path& path);

/// Throws FileError if NAME.partial is damaged, or a recording of another or an unknown run.
void reject_foreign_recording(const std::filesystem::path& path, const std::string& run);

/// The provenance entry `name` of a recording, "" if there is none.
std::string recorded_entry(const std::filesystem::path& file, const std::string& name);

/// Opens a recording to continue it. Throws DamagedFile, without a hint, if it is missing, belongs
/// to another run, or has no such dataset and is therefore a recording of another kind. If the
/// process was killed after the recording was published and before the result was written, the
/// recording gets its partial name back.
Hdf5File reopen_recording(const std::filesystem::path& path, const std::string& run,
                          const std::string& dataset);

/// Throws DamagedFile if a recording has fewer `items` ("frames" or "events") than the checkpoint
/// that continues it.
void require_recorded(const std::filesystem::path& path, const char* items, std::uint64_t recorded,
                      std::uint64_t in_checkpoint);

/// The number of rows that all columns of a recording have. If writing was interrupted between two
/// columns, this is the shortest length. Throws FileError if the recording is complete and the
/// lengths differ.
std::uint64_t common_length(const std::filesystem::path& path, bool complete,
                            const std::vector<std::uint64_t>& lengths);

/// Throws FileError: the content of the file contradicts itself, as `what` says.
[[noreturn]] void throw_inconsistent(const std::filesystem::path& path, const std::string& what);

}  // namespace swirl
