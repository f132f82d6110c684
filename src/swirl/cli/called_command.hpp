// Commands of swirl that another command calls, so that it needs neither their code nor their
// libraries.
#pragma once

#include <string>
#include <vector>

namespace swirl {

/// Runs a command of swirl to its end and returns what it prints. Throws Interrupted with the text
/// `stopped` after a signal, or Failure with the command's own error, after `before_error`.
std::string output_of_command(std::vector<std::string> words, const std::string& stopped,
                              const std::string& before_error = "");

}  // namespace swirl
