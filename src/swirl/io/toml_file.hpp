// Configurations in TOML. Names and values are those of the command-line options.
//
//     discs = 40               # --discs 40
//     mu_wall = 0.5            # --mu-wall 0.5; mu-wall is the same name
//     inertia = "ring"
//     trajectory = "run.h5"
//
// The plan of a sweep also has lists: discs = [5, 10] or discs = "5:48".
//
// Values are returned as texts, to be read like the option's value on the command line.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace swirl {

inline constexpr std::size_t largest_config = 1 << 20;  // bytes

struct ConfigEntry {
    std::vector<std::string> values;  // a single one unless is_list
    bool is_list = false;
    int line = 0;
};

struct Config {
    std::string text;                                         // unchanged, for the record
    std::map<std::string, ConfigEntry, std::less<>> entries;  // names with underscores
};

/// `name` appears in error messages. Throws FileError with the line of the error: invalid TOML,
/// tables, dates, nested lists, or bytes that are not UTF-8 text.
Config parse_config(std::string text, std::string_view name);

}  // namespace swirl
