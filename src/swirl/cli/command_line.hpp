// The command line of this call, as stored in results and recordings.
#pragma once

#include <string>

#include "swirl/cli/options.hpp"

namespace swirl {

/// --portable: results and recordings do not tell where files are, which may contain a user name.
Option omit_paths_option();

/// Throws UsageError if an argument is not UTF-8: results and recordings store the command line and
/// cannot hold anything else.
void reject_invalid_utf8(int argc, char** argv);

/// The command as you would type it, with shell quotes where needed; with --portable it has file
/// names without folders.
std::string command_line();
/// What results store of the name of a file, and of the text of a configuration file.
std::string stored_path(const std::string& file);
std::string stored_config(const std::string& text);
void remember_command_line(const char* command, int argc, char** argv);

}  // namespace swirl
