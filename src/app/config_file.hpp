// A configuration file in place of options: `swirl run study.toml`, `swirl sweep plan.toml`.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "swirl/run/parameters.hpp"

namespace swirl {

/// What stands in the file; a list is its values with commas between.
struct ConfigFile {
    std::string text;           // as it was, for the record
    ParameterTexts parameters;  // of the run
    ParameterTexts others;      // the further options
};

enum class Lists { refused, taken };

/// `others` are the names of the options it may hold besides the parameters of a run; `command` is
/// whose --help lists them. Throws WrongCall for names that do not exist, for what is no TOML, and
/// if there is no such file.
ConfigFile read_config_file(const std::string& file, const std::vector<std::string>& others,
                            Lists lists, const std::string& command);

/// Fills the texts that the command line left empty.
void take_others(const ParameterTexts& from_file, const std::map<std::string, std::string*>& texts);

}  // namespace swirl
