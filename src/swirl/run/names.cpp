#include "swirl/run/names.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace swirl {
namespace {

/// The number of characters to insert, remove or replace, or of neighbours to swap, to get from
/// `a` to `b`.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        before_last = std::exchange(last, row);
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            row[j + 1] = std::min({last[j] + (a[i] != b[j]), row[j] + 1, last[j + 1] + 1});
            if (i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j])
                row[j + 1] = std::min(row[j + 1], before_last[j - 1] + 1);
        }
    }
    return row.back();
}

using NamePair = std::pair<std::string_view, std::string_view>;

/// Parameters whose option has another name than their key in results, recordings and tables. The
/// page has a copy (tests/run/nearest_name_test.cpp).
constexpr NamePair option_of_key[] = {{"path", "motion"}, {"path_phase", "start_angle"}};

/// Former and present names of options of commands that read a configuration file.
constexpr NamePair renamed_options[] = {
    {"frame", "view"},       {"frames", "frames_per_period"},
    {"seeds", "replicates"}, {"omit_paths", "portable"},
    {"nodes", "tasks"},      {"cpus", "cores"},
};

/// Words that users of other programs may try, and other former names; and the names that have this
/// meaning here.
constexpr NamePair names_of_equal_meaning[] = {{"o", "out"},
                                               {"o", "json"},
                                               {"out", "json"},
                                               {"out", "csv"},
                                               {"output", "out"},
                                               {"output", "json"},
                                               {"output", "csv"},
                                               {"friction", "mu"},
                                               {"number", "discs"},
                                               {"spheres", "discs"},
                                               {"particles", "discs"},
                                               {"jobs", "threads"},
                                               {"cores", "threads"},
                                               {"frames", "frame_files"},
                                               {"frames", "max_frames"},
                                               {"path", "motion_out"},
                                               {"path_out", "motion_out"},
                                               {"length", "periods"},
                                               {"max_frames", "frame_count"},
                                               {"smooth", "smooth_discs"},
                                               {"to", "last_frame"},
                                               {"to", "format"},
                                               {"skip", "ignore_frames"},
                                               {"skip", "warmup"},
                                               {"from", "first_frame"},
                                               {"from", "start"},
                                               {"at", "start"},
                                               {"of", "quantity"},
                                               {"misfit", "max_invalid"},
                                               {"turned", "turned_angle"},
                                               {"rest", "finish_others"},
                                               {"hands", "hand_time"},
                                               {"still", "camera_on_container"},
                                               {"bare", "no_annotations"},
                                               {"accept", "correct_frames"},
                                               {"by_time", "mean_by_time"},
                                               {"by_event", "mean_by_event"}};

std::string_view without_dashes(std::string_view option) {
    return option.substr(std::min(option.find_first_not_of('-'), option.size()));
}

/// Plain, and without dashes at the start.
std::string plain_option(std::string_view option) { return plain_name(without_dashes(option)); }

}  // namespace

std::string standard_spelling(std::string_view name) {
    std::string plain(name);
    std::replace(plain.begin(), plain.end(), '-', '_');
    constexpr std::string_view spellings[][2] = {{"colour", "color"}, {"center", "centre"}};
    for (const auto& [other, own] : spellings)
        if (const auto at = plain.find(other); at != plain.npos)
            plain.replace(at, other.size(), own);
    return plain;
}

std::string plain_name(std::string_view name) {
    std::string plain = standard_spelling(name);
    for (const auto& [key, option] : option_of_key)
        if (plain == option) plain = key;
    return plain;
}

std::string user_name(std::string_view key) {
    for (const auto& [other, option] : option_of_key)
        if (key == other) key = option;
    return std::string(key);
}

std::string option_name(std::string_view key) {
    std::string name = user_name(key);
    std::replace(name.begin(), name.end(), '_', '-');
    return "--" + name;
}

std::optional<std::string> present_name(std::string_view name,
                                        const std::vector<std::string>& names) {
    const auto named = [&](std::string_view plain) {
        return std::find_if(names.begin(), names.end(),
                            [&](const std::string& other) { return plain_option(other) == plain; });
    };
    const std::string plain = plain_option(name);
    auto found = named(plain);
    for (const auto& [former, present] : renamed_options)
        if (found == names.end() && plain == former) found = named(present);
    return found == names.end() ? std::nullopt : std::optional(*found);
}

std::optional<std::string> nearest_name(std::string_view unknown,
                                        const std::vector<std::string>& names) {
    if (auto present = present_name(unknown, names)) return present;
    const std::string_view word = without_dashes(unknown);
    for (const auto& [other, own] : names_of_equal_meaning)
        for (const std::string& name : names)
            if (plain_option(word) == other && plain_option(name) == own) return name;
    std::optional<std::string> best;
    std::size_t minimum = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const std::string& name : names) {
        const std::string_view candidate = without_dashes(name);
        const std::size_t distance = edit_distance(word, candidate);
        if (distance >= minimum || 2 * distance >= std::max(word.size(), candidate.size()))
            continue;
        minimum = distance;
        best = name;
    }
    const auto begins = [&](const std::string& name) {
        return !word.empty() && without_dashes(name).starts_with(word);
    };
    if (!best && std::count_if(names.begin(), names.end(), begins) == 1)
        best = *std::find_if(names.begin(), names.end(), begins);
    return best;
}

}  // namespace swirl
