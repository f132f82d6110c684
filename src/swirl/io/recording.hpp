// What trajectories and event logs have in common while they are recorded: the name NAME.partial
// until they are complete, and the run that they belong to. The provenance entry `run` names it;
// recordings with the same entry hold the same frames and events, whoever wrote them.
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

/// Throws FileError if NAME.partial holds something of another run, or of nobody knows which.
void reject_foreign_recording(const std::filesystem::path& path, const std::string& run);

/// What a recording says of itself under this name (parameters/NAME), "" if nothing.
std::string recorded_entry(const std::filesystem::path& file, const std::string& name);

/// Throws FileError if this recording belongs to another run.
void reject_recording_of_another(const std::filesystem::path& file, const std::string& run);

/// Opens a recording to go on with it. Throws FileError if it belongs to another run. A kill can
/// come after a recording got its name and before the result that belongs to it was written: it
/// then gets its partial name back.
Hdf5File reopen_recording(const std::filesystem::path& path, const std::string& run);

/// How far all columns of a recording go, of which these are the lengths. One that was cut off
/// between two columns counts as far as that; throws FileError if it is complete and they differ.
std::uint64_t common_length(const std::filesystem::path& path, bool complete,
                            const std::vector<std::uint64_t>& lengths);

}  // namespace swirl
