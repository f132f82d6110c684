// Output of the subcommands: messages, files, folders and standard output.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace swirl {

/// Called before any work is done. Throws Failure or UsageError if the file cannot be written.
void reject_unwritable(const std::filesystem::path& file);

/// The absolute name of a file with links resolved. The file need not exist.
std::filesystem::path canonical_name(const std::filesystem::path& file);

/// Throws UsageError if two of these names are the same file, or if two are "-" (standard output).
/// Empty names are ignored.
void reject_same_files(const std::vector<std::filesystem::path>& files);

/// Writes a file atomically (io/atomic_file.hpp), or the text to a pipe or device. Throws FileError
/// or Failure.
void write_output(const std::filesystem::path& file, const std::string& text);

/// Columns of the terminal that a file descriptor refers to; `otherwise` if it is no terminal.
std::size_t terminal_width(int file, std::size_t otherwise);

/// Creates the folder if it does not exist. Throws Failure if it cannot be written to, or
/// UsageError if its name looks like an option.
void make_folder(const std::filesystem::path& folder);

/// Write "error: TEXT", "warning: TEXT" or "note: TEXT" to standard error. A text may have a second
/// line "hint: …" that says what to do. Warnings are printed with --quiet, too; notes are not.
void print_error(std::string_view text);
void print_warning(std::string_view text);
void print_note(std::string_view text);

/// Writes to standard output. Throws Failure if that fails, for example on a full disk.
void print_all(const std::string& text);

}  // namespace swirl
