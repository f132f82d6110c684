// Parameters whose value may be the name of a file: --motion FILE.csv, --sizes file:FILE.csv and
// --initial FILE.csv. The contents of the file replace its name before the configuration is made. A
// configuration therefore holds these contents, and a resumed run does not depend on the file.
#pragma once

#include <string>
#include <string_view>

#include "swirl/run/parameters.hpp"

namespace swirl {

/// The text of a parameter, with the contents of a file instead of its name. In a list of texts
/// (an axis of a sweep) each is replaced. Throws UsageError if a file cannot be read.
std::string with_file_contents(std::string_view name, const std::string& text);

/// The text of a table, a regular file of at most 16 MB. Throws UsageError.
std::string text_of_table_file(const std::string& option, const std::string& file);

/// Replaces file names by contents in all parameters.
ParameterTexts with_file_contents(ParameterTexts texts);

}  // namespace swirl
