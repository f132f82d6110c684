#include "swirl/app/config_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "swirl/files/config.hpp"
#include "swirl/files/file_error.hpp"
#include "swirl/files/whole_file.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

/// What is wrong in a configuration is wrong in the call.
Config parsed(const std::string& file, Lists lists) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored))
        throw WrongCall(fmt::format(
            "There is no configuration file '{}'; options begin with --, as in --discs {}.", file,
            lists == Lists::taken ? "5:48" : "48"));
    std::string text = read_whole_file(file);
    try {
        return parse_config(std::move(text), file);
    } catch (const FileError& wrong) {
        throw WrongCall(wrong.what());
    }
}

}  // namespace

ConfigFile read_config_file(const std::string& file, const std::vector<std::string>& others,
                            Lists lists, const std::string& command) {
    std::vector<std::string> names = parameter_names();
    names.insert(names.end(), others.begin(), others.end());
    Config config = parsed(file, lists);
    ConfigFile found;
    for (const auto& [name, entry] : config.entries) {
        const std::string at = fmt::format("'{}', line {}", file, entry.line);
        if (std::find(names.begin(), names.end(), name) == names.end()) {
            const auto meant = nearest_name(name, names);
            throw WrongCall(fmt::format("{}: there is no option '{}'{}", at, name,
                                        meant ? fmt::format("; did you mean '{}'?", *meant)
                                              : "; `swirl " + command + " --help` lists them."));
        }
        if (entry.is_list && lists == Lists::refused)
            throw WrongCall(fmt::format(
                "{}: {} is a list, but one run needs one value; `swirl sweep` takes lists.", at,
                name));
        if (entry.values.empty())
            throw WrongCall(fmt::format("{}: the list of {} is empty.", at, name));
        auto& into = find_parameter(name) ? found.parameters : found.others;
        into.emplace(name, fmt::format("{}", fmt::join(entry.values, ",")));
    }
    found.text = std::move(config.text);
    return found;
}

void take_others(const ParameterTexts& from_file,
                 const std::map<std::string, std::string*>& texts) {
    for (const auto& [name, text] : texts)
        if (const auto found = from_file.find(name); found != from_file.end() && text->empty())
            *text = found->second;
}

}  // namespace swirl
