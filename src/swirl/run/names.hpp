// Names of options, values and commands: their spellings, and the one that a wrong name stands for.
//
// A name has underscores in files and in code (mu_disc), and hyphens as an option (--mu-disc). Both
// spellings are accepted everywhere, and so are colour and color, centre and center. Users write
// `--motion` and `--start-angle`. Results, recordings and tables have the keys `path` and
// `path_phase`, so that their bytes, and the identity of a run, stay the same.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace swirl {

/// "mu_disc" for both spellings; "color" and "centre" for British and American ones.
std::string standard_spelling(std::string_view name);
/// The key of a parameter in results, recordings and tables: "mu_disc" for "mu-disc", but "path"
/// for "motion".
std::string plain_name(std::string_view name);
/// The name of a parameter for users, in configuration files and in Python: "motion" for "path".
std::string user_name(std::string_view key);
/// The option of a parameter: "--mu-disc" for "mu_disc", and "--motion" for "path".
std::string option_name(std::string_view key);

/// The one of `names` that is this one, in another spelling or under its present name: "view" for
/// "frame". Files may have either; the command line has the present name only.
std::optional<std::string> present_name(std::string_view name,
                                        const std::vector<std::string>& names);

/// The name that the user probably means: first one of equal meaning ("json" for "out"), then the
/// one with the smallest edit distance, then the only one that begins with `unknown`. The distance
/// must not exceed 2 or a third of the length of `unknown`, whichever is larger, and must be less
/// than half of the length of the longer name. Dashes at the start do not count.
std::optional<std::string> nearest_name(std::string_view unknown,
                                        const std::vector<std::string>& names);

}  // namespace swirl
