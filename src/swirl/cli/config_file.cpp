#include "swirl/cli/config_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <limits>

#include "swirl/cli/output.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/io/toml_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameter_files.hpp"

namespace swirl {
namespace {

/// Errors in a configuration file are usage errors.
Config parsed(const std::string& file, const std::string& command) {
    if (!file_exists(file))
        throw UsageError(fmt::format(
            "the configuration file '{}' does not exist.\nhint: options begin with --, as in {}.",
            file,
            command == "paper"      ? "--figure 5b"
            : command == "crossing" ? "--mu 0.5"
                                    : "--discs 48"));
    std::string text = read_whole_file(file, largest_config);
    if (!text.empty() && std::isalnum(static_cast<unsigned char>(text.back())))
        print_warning(fmt::format(
            "'{}' has no line break at its end, so its last value may be truncated.\nhint: if the "
            "file is complete, append a line break.",
            file));
    try {
        return parse_config(std::move(text), file);
    } catch (const FileError& wrong) {
        throw UsageError(wrong.what());
    }
}

/// --measure and --figure take lists in all commands.
bool takes_list(const std::string& name) { return name == "measure" || name == "figure"; }

/// Sets the variable of an option to a value from a file.
struct SetOption {
    const std::string& name;
    const std::string& text;
    const std::string& file;

    [[noreturn]] void fail(const char* constraint) const {
        throw UsageError(
            fmt::format("'{}': {} is '{}', but it must be {}.", file, name, text, constraint));
    }
    double number() const {
        const auto value = read_number(text);
        if (!value) fail("a number");
        return *value;
    }
    template <class Whole>
    Whole whole() const {
        const auto value = read_whole_number(text);
        if (!value || *value < std::numeric_limits<Whole>::min() ||
            *value > std::numeric_limits<Whole>::max())
            fail("a whole number");
        return static_cast<Whole>(*value);
    }

    void operator()(bool* flag) const {
        if (text != "true" && text != "false") fail("true or false");
        *flag = text == "true";
    }
    void operator()(std::string* into) const { *into = text; }
    void operator()(std::int64_t* into) const { *into = whole<std::int64_t>(); }
    void operator()(int* into) const { *into = whole<int>(); }
    void operator()(double* into) const { *into = number(); }
    void operator()(std::optional<int>* into) const { *into = whole<int>(); }
    void operator()(std::optional<std::int64_t>* into) const { *into = whole<std::int64_t>(); }
    void operator()(std::optional<double>* into) const { *into = number(); }
    void operator()(std::vector<std::string>* into) const {
        std::string_view rest = text;
        for (;;) {
            const std::size_t comma = rest.find(',');
            into->emplace_back(rest.substr(0, comma));
            if (comma == rest.npos) return;
            rest.remove_prefix(comma + 1);
        }
    }
    void operator()(const std::function<void(const std::string&)>& take) const { take(text); }
};

/// "trail_length" for "--trail-length"; the lower-case name for a positional argument.
std::string name_in_file(const Option& option) {
    std::string name = option.name.starts_with("--") ? option.name.substr(2) : option.name;
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return plain_name(name);
}

}  // namespace

ConfigFile read_config_file(const std::string& file, const std::vector<std::string>& names,
                            Lists lists, const std::string& command) {
    Config config = parsed(file, command);
    ConfigFile found;
    for (const auto& [given, entry] : config.entries) {
        const std::string at = fmt::format("'{}', line {}", file, entry.line);
        const auto present = present_name(given, names);
        if (!present) {
            const auto meant = nearest_name(given, names);
            throw UsageError(
                fmt::format("{}: there is no option '{}'.\nhint: {}", at, given,
                            meant ? fmt::format("did you mean '{}'?", *meant)
                                  : "`swirl help " + command + " all` lists all options."));
        }
        const std::string name = plain_name(*present);
        if (entry.is_list && lists == Lists::rejected && !takes_list(name))
            throw UsageError(fmt::format(
                "{}: {} is a list, but needs one value.\nhint: `swirl sweep` takes lists.", at,
                name));
        if (entry.values.empty())
            throw UsageError(fmt::format("{}: the list of {} is empty.", at, name));
        auto& into = find_parameter(name) ? found.parameters : found.others;
        const std::string text = fmt::format("{}", fmt::join(entry.values, ","));
        if (!into.emplace(name, text).second)
            throw UsageError(fmt::format("{}: {} is given twice.", at, user_name(name)));
    }
    found.parameters = with_file_contents(std::move(found.parameters));
    found.text = std::move(config.text);
    return found;
}

void fill_empty(const ParameterTexts& from_file, const std::map<std::string, std::string*>& texts) {
    for (const auto& [name, text] : texts)
        if (const auto found = from_file.find(name); found != from_file.end() && text->empty())
            *text = found->second;
}

bool is_config_file(const std::string& argument) { return argument.ends_with(".toml"); }

void take_config_file(const Subcommand& subcommand, const std::string& file,
                      ParameterTexts& parameters, Lists lists, const std::string& command,
                      const std::vector<std::vector<std::string>>& alternatives) {
    if (file.empty()) return;
    std::map<std::string, const Option*> options;
    std::vector<std::string> names;
    for (const Option& option : subcommand.options()) {
        if (!option.name.starts_with("--") && option.is_given) continue;  // the file itself
        options[name_in_file(option)] = &option;
        names.push_back(name_in_file(option));
    }
    const ConfigFile found = read_config_file(file, names, lists, command);
    parameters = overridden(found.parameters, parameters);
    const auto replaced = [&](const std::string& name) {
        return std::any_of(alternatives.begin(), alternatives.end(), [&](const auto& group) {
            return std::find(group.begin(), group.end(), name) != group.end() &&
                   std::any_of(group.begin(), group.end(), [&](const std::string& other) {
                       return options.at(other)->is_given;
                   });
        });
    };
    for (const auto& [name, text] : found.others) {
        const Option& option = *options.at(name);
        if (!option.is_given && !replaced(name))
            std::visit(SetOption{name, text, file}, option.target);
    }
}

}  // namespace swirl
