// The words with which this program was called, for the record.
#pragma once

#include <string>

namespace swirl {

/// Throws WrongCall if a word is not UTF-8: what it names would be computed, and then could not be
/// written down.
void reject_what_is_no_text(int argc, char** argv);

/// As one would type it again: words that need it are quoted.
const std::string& command_line();
void remember_command_line(int argc, char** argv);

}  // namespace swirl
