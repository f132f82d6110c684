// A configuration file in place of options: `swirl run study.toml`, `swirl sweep plan.toml`,
// `swirl movie film.toml`. What is given by hand wins over it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "swirl/cli/options.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {

/// What stands in the file; a list is its values with commas between.
struct ConfigFile {
    std::string text;           // as it was, for the record
    ParameterTexts parameters;  // of the run
    ParameterTexts others;      // the further options
};

enum class Lists { rejected, taken };

/// `names` are those of the options it may hold; `command` is whose --help lists them. What to
/// measure may always be a list. Throws WrongCall for names that do not exist, for what is no TOML,
/// and if there is no such file.
ConfigFile read_config_file(const std::string& file, const std::vector<std::string>& names,
                            Lists lists, const std::string& command);

/// Fills the texts that the command line left empty.
void take_others(const ParameterTexts& from_file, const std::map<std::string, std::string*>& texts);

/// Whether the argument names a configuration file, and no recording.
bool is_config_file(const std::string& argument);

/// For a command all of whose options may stand in the file: gives those that the call left out
/// what the file says, and `parameters` those of a run. Options of one group in `instead` replace
/// each other: if one of them is given by hand, the file's others do not count. Throws WrongCall.
void take_config_file(const Subcommand& subcommand, const std::string& file,
                      ParameterTexts& parameters, Lists lists, const std::string& command,
                      const std::vector<std::vector<std::string>>& instead = {});

}  // namespace swirl
