#include "swirl/run/names.hpp"

#include <algorithm>
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

/// Words that users of other programs may try, and names of earlier versions; and the names that
/// have this meaning here.
constexpr std::pair<std::string_view, std::string_view> names_of_equal_meaning[] = {
    {"o", "out"},
    {"o", "json"},
    {"out", "json"},
    {"out", "csv"},
    {"output", "out"},
    {"output", "json"},
    {"output", "csv"},
    {"friction", "mu"},
    {"number", "discs"},
    {"replicates", "seeds"},
    {"spheres", "discs"},
    {"particles", "discs"},
    {"jobs", "threads"},
    {"cores", "threads"},
    {"frames", "frame-files"},
    {"frames", "max-frames"},
    {"path", "path-out"},
    {"to", "format"},
    {"skip", "warmup"},
    {"from", "start"},
    {"at", "start"},
    {"of", "quantity"},
    {"misfit", "max-invalid"},
    {"turned", "turned-angle"},
    {"rest", "finish-others"},
    {"hands", "hand-time"},
    {"still", "camera-on-container"},
    {"bare", "no-annotations"},
    {"accept", "correct-frames"},
    {"by_time", "mean_by_time"},
    {"by_event", "mean_by_event"}};

std::string_view without_dashes(std::string_view option) {
    return option.substr(std::min(option.find_first_not_of('-'), option.size()));
}

/// True for one name in two spellings, such as "--path-out" and "path_out".
bool is_same_name(std::string_view a, std::string_view b) {
    return plain_name(without_dashes(a)) == plain_name(without_dashes(b));
}

}  // namespace

std::string plain_name(std::string_view name) {
    std::string plain(name);
    std::replace(plain.begin(), plain.end(), '-', '_');
    constexpr std::string_view spellings[][2] = {{"colour", "color"}, {"center", "centre"}};
    for (const auto& [other, own] : spellings)
        if (const auto at = plain.find(other); at != plain.npos)
            plain.replace(at, other.size(), own);
    return plain;
}

std::string option_name(std::string_view name) {
    std::string option(name);
    std::replace(option.begin(), option.end(), '_', '-');
    return "--" + option;
}

std::optional<std::string> nearest_name(std::string_view unknown,
                                        const std::vector<std::string>& names) {
    const std::string_view word = without_dashes(unknown);
    for (const auto& [other, own] : names_of_equal_meaning)
        for (const std::string& name : names)
            if (is_same_name(word, other) && is_same_name(name, own)) return name;
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
