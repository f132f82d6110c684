#include "swirl/cli/parser.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <deque>
#include <utility>
#include <vector>

#include "swirl/cli/commands.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/run/version.hpp"

namespace swirl {
namespace {

constexpr std::size_t column_of_descriptions = 34;
constexpr int max_values = 100;  // of a repeated option

/// The named subcommand, or the program itself.
const CLI::App& selected_app(const CLI::App& app) {
    const auto subcommands = app.get_subcommands();
    return subcommands.empty() ? app : selected_app(*subcommands.front());
}

/// "did you mean --discs?", or nothing.
std::string nearest_name_hint(const CLI::App& app, const std::string& unknown) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) names.push_back(option->get_name());
    for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(subcommand->get_name());
    const auto nearest = nearest_name(unknown.substr(0, unknown.find('=')), names);
    return nearest ? "did you mean " + *nearest + "?" : "";
}

/// The parser does not end options at `--` once a subcommand has all its files. Each later word that
/// starts with a dash therefore gets this mark, which no argument can contain. Positional arguments
/// remove it.
constexpr char not_an_option = '\0';

std::string without_mark(std::string word) {
    if (word.starts_with(not_an_option)) word.erase(0, 1);
    return word;
}

struct Message {
    std::string text, hint = {};
};

Message message_on_extras(const CLI::App& app, const CLI::App& selected) {
    // The parser returns the words in reverse order; an unknown option comes before its value.
    auto extras = app.remaining(true);
    std::erase(extras, "--");
    for (const std::string& extra : extras)
        if (extra.starts_with('-'))
            return {"there is no option " + extra + ".", nearest_name_hint(selected, extra)};
    const std::string extra = extras.empty() ? "" : without_mark(extras.front());
    if (&selected == &app)
        return {"there is no command '" + extra + "'.", nearest_name_hint(selected, extra)};
    return {"unexpected argument '" + extra + "'.", nearest_name_hint(selected, extra)};
}

Message message_on_missing_value(const std::string& what) {
    const std::string option = what.substr(0, what.find(':'));
    if (what.find("At Most 1") != what.npos) return {option + " may be given only once."};
    return {option + " needs a value."};
}

/// The parser's text is "Could not convert: --fps = 59.94".
Message message_on_conversion(const std::string& what) {
    const std::size_t colon = what.find(": "), equals = what.find(" = ");
    if (colon > equals || equals == what.npos) return {"a value is not a number."};
    const std::string value = what.substr(equals + 3);
    return {fmt::format("{} is '{}', but it must be a {}.",
                        what.substr(colon + 2, equals - colon - 2), value,
                        read_number(value) ? "whole number" : "number")};
}

Message message_on_missing_option(const CLI::App& selected, const std::string& what) {
    const std::string name = what.substr(0, what.find(' '));
    const CLI::Option* const option = selected.get_option_no_throw(name);
    const std::string form = option ? " " + option->get_type_name() : "";
    return {name.starts_with('-') ? "missing required option " + name + form + "."
                                  : "missing required argument " + name + "."};
}

std::string error_text(const CLI::App& app, const CLI::ParseError& error) {
    const CLI::App& selected = selected_app(app);
    Message message{"invalid arguments."};
    if (dynamic_cast<const CLI::ExtrasError*>(&error))
        message = message_on_extras(app, selected);
    else if (dynamic_cast<const CLI::ArgumentMismatch*>(&error))
        message = message_on_missing_value(error.what());
    else if (dynamic_cast<const CLI::ConversionError*>(&error))
        message = message_on_conversion(error.what());
    else if (dynamic_cast<const CLI::RequiredError*>(&error))
        message = message_on_missing_option(selected, error.what());
    const std::string command = &selected == &app ? "swirl" : "swirl " + selected.get_name();
    return message.hint.empty()
               ? fmt::format("{}\nhint: see `{} --help`.", message.text, command)
               : fmt::format("{}\nhint: {} See `{} --help`.", message.text, message.hint, command);
}

/// Shows a repeated argument as "VIDEO..." in the usage.
class HelpFormat : public CLI::Formatter {
    std::string make_option_usage(const CLI::Option* option) const override {
        return option->get_expected_max() > 1 ? option->get_type_name() + "..."
                                              : CLI::Formatter::make_option_usage(option);
    }
};

/// Adds an option to the parser, by the type of its target.
struct OptionAdder {
    CLI::App& app;
    const Option& option;

    CLI::Option* operator()(bool* flag) const {
        return app.add_flag(option.name, *flag, option.description);
    }
    CLI::Option* operator()(std::vector<std::string>* values) const {
        return app.add_option(option.name, *values, option.description)->expected(1, max_values);
    }
    CLI::Option* operator()(const std::function<void(const std::string&)>& take) const {
        return app.add_option_function(option.name, take, option.description);
    }
    CLI::Option* operator()(auto* value) const {
        return app.add_option(option.name, *value, option.description);
    }
};

void add_to(CLI::App& app, const Subcommand& subcommand) {
    for (const Option& option : subcommand.options()) {
        CLI::Option* const added = std::visit(OptionAdder{app, option}, option.target);
        if (!option.value_form.empty()) added->type_name(option.value_form);
        if (!option.help_group.empty()) added->group(option.help_group);
        if (option.is_required) added->required();
        if (!option.name.starts_with('-')) added->transform(without_mark);
    }
    app.footer(subcommand.footer());
}

void note_given(const CLI::App& app, Subcommand& subcommand) {
    for (Option& option : subcommand.options())
        option.is_given = app.get_option(option.name)->count() > 0;
}

/// The arguments in reverse order, as the parser expects them. Replaces underscores in names of
/// options by hyphens, and marks words after `--`.
std::vector<std::string> reversed_words(int argc, char** argv) {
    std::vector<std::string> words;
    bool options_ended = false;
    for (int k = 1; k < argc; ++k) {
        std::string word = argv[k];
        if (options_ended) {
            if (word.starts_with('-')) word.insert(word.begin(), not_an_option);
        } else if (word == "--") {
            options_ended = true;
        } else if (word.starts_with("--")) {
            std::replace(word.begin(), std::find(word.begin(), word.end(), '='), '_', '-');
        }
        words.push_back(std::move(word));
    }
    std::reverse(words.begin(), words.end());
    return words;
}

}  // namespace

Call parse(int argc, char** argv) {
    CLI::App app(
        "Exact event-driven simulation of granular discs and spheres in a swirled container,\n"
        "after Lee et al., Phys. Rev. E 100, 012903 (2019).",
        "swirl");
    app.set_version_flag("--version", version());
    app.require_subcommand(0, 1);
    app.formatter(std::make_shared<HelpFormat>());
    app.get_formatter()->column_width(column_of_descriptions);
    const auto subcommands = std::make_shared<std::deque<std::pair<CLI::App*, Subcommand>>>();
    for (const Command* command : Command::all()) {
        auto& [added, subcommand] = subcommands->emplace_back();
        added = app.add_subcommand(command->name(), command->description());
        command->add_options(subcommand);
        add_to(*added, subcommand);
    }
    app.footer(
        "Examples:\n  swirl run --discs 48\n  swirl paper --figure 5b --quick\n  swirl run --help");
    try {
        app.parse(reversed_words(argc, argv));
    } catch (const CLI::CallForVersion& version_call) {
        return {.act = {}, .text = std::string(version_call.what()) + "\n", .usage = {}};
    } catch (const CLI::Success&) {
        return {.act = {}, .text = app.help(), .usage = {}};
    } catch (const CLI::ParseError& error) {
        throw UsageError(error_text(app, error));
    }
    Call call{.act = {}, .text = {}, .usage = app.help()};
    for (auto& [added, subcommand] : *subcommands)
        if (added->parsed()) note_given(*added, subcommand);
    for (const auto& [added, subcommand] : *subcommands)
        if (added->parsed()) call.act = [subcommands, chosen = &subcommand] { chosen->act(); };
    return call;
}

}  // namespace swirl
