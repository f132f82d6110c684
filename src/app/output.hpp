// What every subcommand does with its output.
#pragma once

#include <filesystem>
#include <string>

namespace swirl {

/// Throws Failure or WrongCall, before any work is done, if no file could be written there.
void refuse_unwritable(const std::filesystem::path& file);

/// Makes the folder if it is not there; throws Failure if it cannot be written to.
void make_folder(const std::filesystem::path& folder);

/// Writes to standard output; throws Failure if that fails (a full disk).
void print_all(const std::string& text);

}  // namespace swirl
