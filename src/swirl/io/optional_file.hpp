// Files that may be absent. A file is absent only if the system says that no file has its name. Any
// other error, such as a disk that does not answer, a stale network handle or too many open files,
// says nothing about the file, and throws: a program that took it for absence would repeat finished
// work, omit a result from a mean, or replace a file that it could not see.
//
// All code that opens a file which need not exist uses these functions.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace swirl {

/// The content of a regular file; nothing if there is none of this name. Throws FileError.
std::optional<std::string> read_optional_file(const std::filesystem::path& path);

/// True if a file, a folder or a device has this name. Throws FileError if the system cannot tell.
bool file_exists(const std::filesystem::path& path);

/// True for a regular file, or a link to one. Throws FileError if the system cannot tell.
bool regular_file_exists(const std::filesystem::path& path);

/// The names in a folder, in any order; none if there is no such folder. Throws FileError.
std::vector<std::string> names_in_folder(const std::filesystem::path& folder);

}  // namespace swirl
