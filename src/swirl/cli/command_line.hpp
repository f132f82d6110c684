// The command line of this call, as stored in results and recordings.
#pragma once

#include <string>

namespace swirl {

/// Throws UsageError if an argument is not UTF-8: results and recordings store the command line and
/// cannot hold anything else.
void reject_invalid_utf8(int argc, char** argv);

/// The command as one would type it, with shell quotes where needed.
const std::string& command_line();
void remember_command_line(int argc, char** argv);

}  // namespace swirl
