// What every subcommand does with its output.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace swirl {

/// Throws Failure or WrongCall, before any work is done, if no file could be written there.
void reject_unwritable(const std::filesystem::path& file);

/// The one name of a file, however it was written: whole, and through links. It need not be there.
std::filesystem::path whole_name(const std::filesystem::path& file);

/// Throws WrongCall if two of these, read or written, are one file, however they are written, or if
/// two are "-", standard output; empty names are none.
void reject_same_files(const std::vector<std::filesystem::path>& files);

/// Writes a file whole or not at all (io/atomic_file.hpp); a pipe or a device gets the text as it
/// is. Throws FileError or Failure.
void write_output(const std::filesystem::path& file, const std::string& text);

/// Makes the folder if it is not there; throws Failure if it cannot be written to, or WrongCall if
/// its name is that of an option.
void make_folder(const std::filesystem::path& folder);

/// Write "error: TEXT", "warning: TEXT" or "note: TEXT" to standard error. A text may have a second
/// line "hint: …" that says what to do. Warnings are printed with --quiet, too; notes are not.
void print_error(std::string_view text);
void print_warning(std::string_view text);
void print_note(std::string_view text);

/// Writes to standard output; throws Failure if that fails (a full disk).
void print_all(const std::string& text);

}  // namespace swirl
