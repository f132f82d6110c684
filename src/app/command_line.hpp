// The words with which this program was called, for the record.
#pragma once

#include <string>

namespace swirl {

/// As one would type it again: words that need it are quoted.
const std::string& command_line();
void remember_command_line(int argc, char** argv);

}  // namespace swirl
