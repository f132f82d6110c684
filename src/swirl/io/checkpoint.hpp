// The state of a run between two events. A run that is continued from it is bitwise identical to
// one that was not interrupted. The event queue is not stored but rebuilt: a prediction depends
// only on the states of its two partners.
//
//   swirl checkpoint 12 NEWLINE
//   u64 length, JSON: identity of the run ("about")
//   u64 length, bytes: discs, clock, counters, and the sums of the averages (state_archive.hpp)
//   u64 CRC-64 of everything before
//
// A checkpoint is written atomically: there is always the old one or the new one.
#pragma once

#include <filesystem>
#include <string>

namespace swirl {

struct Checkpoint {
    std::string about;  // JSON
    std::string state;
};

void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// Throws DamagedFile if the content does not match its checksum, as in a file that was cut off,
/// and FileError if the file cannot be read, is of another version, or is not a checkpoint.
Checkpoint read_checkpoint(const std::filesystem::path& path);

}  // namespace swirl
