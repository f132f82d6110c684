// Configurations in TOML: the names of the options and their values, as the command line takes
// them.
//
//     discs = 40               # --discs 40
//     mu_wall = 0.5            # --mu-wall 0.5; mu-wall means the same
//     inertia = "ring"
//     trajectory = "run.h5"
//
// and in the plan of a sweep lists: discs = [5, 10] or discs = "5:48".
//
// Texts are kept as written in the file, so that a number reads back as the option would read it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace swirl {

inline constexpr std::size_t largest_config = 1 << 20;  // bytes

struct ConfigEntry {
    std::vector<std::string> values;  // one, unless it is a list
    bool is_list = false;
    int line = 0;
};

struct Config {
    std::string text;                                         // as it was, for the output
    std::map<std::string, ConfigEntry, std::less<>> entries;  // names with underscores
};

/// `name` is for messages. Throws FileError with the line of what is wrong: not TOML, tables,
/// dates, lists within lists, bytes that are no text.
Config parse_config(std::string text, std::string_view name);
Config read_config(const std::filesystem::path& path);

}  // namespace swirl
