// A configuration file instead of options: `swirl run study.toml`, `swirl sweep plan.toml`,
// `swirl movie movie.toml`. Options of the command line override it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "swirl/cli/options.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {

/// The content of the file. The values of a list are joined by commas.
struct ConfigFile {
    std::string text;           // unchanged, for the record
    ParameterTexts parameters;  // parameters of the run
    ParameterTexts others;      // all other options
};

enum class Lists { rejected, accepted };

/// `names` are the allowed option names; `command` appears in error messages. --measure and
/// --figure may always be lists. Throws UsageError if a name is unknown, the file is not valid
/// TOML, or it does not exist.
ConfigFile read_config_file(const std::string& file, const std::vector<std::string>& names,
                            Lists lists, const std::string& command);

/// Sets the texts that the command line left empty.
void fill_empty(const ParameterTexts& from_file, const std::map<std::string, std::string*>& texts);

/// True if the argument names a configuration file, not a recording.
bool is_config_file(const std::string& argument);

/// For commands that accept all their options in the file: sets the options that the command line
/// does not give, and `parameters`. Options of one group in `alternatives` exclude each other: if
/// the command line gives one of them, the file's others are ignored. Throws UsageError.
void take_config_file(const Subcommand& subcommand, const std::string& file,
                      ParameterTexts& parameters, Lists lists, const std::string& command,
                      const std::vector<std::vector<std::string>>& alternatives = {});

}  // namespace swirl
