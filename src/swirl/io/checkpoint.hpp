// A run interrupted between two events: enough to go on bit for bit. Not the queue of the events to
// come, which is rebuilt: a prediction depends only on the states of the two partners.
//
//   swirl checkpoint 8 NEWLINE
//   u64 length, JSON: what run it is ("about")
//   u64 length, bytes: discs, clock, counters, and the sums behind the averages (state_archive.hpp)
//   u64 CRC-64 of everything before
//
// Written aside, onto the disk, and renamed; so there is the last checkpoint or the new one.
#pragma once

#include <filesystem>
#include <string>

namespace swirl {

struct Checkpoint {
    std::string about;  // JSON
    std::string state;
};

void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// Throws FileError, with a sentence about what is wrong, if it is damaged, cut off, of another
/// version, or no checkpoint at all.
Checkpoint read_checkpoint(const std::filesystem::path& path);

}  // namespace swirl
