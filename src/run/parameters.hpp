// The parameters of a run as people write them: names and texts, the same on the command line, in a
// configuration file and in a sweep; and what they resolve to.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "swirl/run/config.hpp"

namespace swirl {

struct RunParameter {
    const char* name;         // "mu-disc": the option is --mu-disc
    const char* value;        // what to write after it: "NUMBER"
    const char* description;  // with the default
    const char* group;
};

/// In the order of `swirl run --help`.
const std::vector<RunParameter>& run_parameters();

/// Name to text, as given by the user; what is not given takes the paper's value.
using ParameterTexts = std::map<std::string, std::string, std::less<>>;

/// Throws WrongCall, with one sentence that names the value, if a text cannot be read, a name is
/// unknown, two texts contradict each other, or the whole has a problem().
RunConfig resolve(const ParameterTexts& given);

/// Reads a finite number ("0.5", "1e6"), or a whole one that fits 64 bits; nothing otherwise.
std::optional<double> read_number(std::string_view text);
std::optional<std::int64_t> read_whole_number(std::string_view text);

/// The name nearest to `wrong`, if any is near enough to be what was meant.
std::optional<std::string> nearest_name(std::string_view wrong,
                                        const std::vector<std::string>& names);

}  // namespace swirl
