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
constexpr int max_values = 100;  // of an option that may be given several times

/// The subcommand that the arguments name, or the program itself.
const CLI::App& deepest(const CLI::App& app) {
    const auto named = app.get_subcommands();
    return named.empty() ? app : deepest(*named.front());
}

std::string did_you_mean(const CLI::App& app, const std::string& wrong) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) names.push_back(option->get_name());
    for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(subcommand->get_name());
    const auto meant = nearest_name(wrong.substr(0, wrong.find('=')), names);
    return meant ? "; did you mean " + *meant + "?" : ".";
}

/// The parser does not end options at `--` once a subcommand has all its files. So each word after
/// it that begins with a dash gets this mark, which no argument can contain; whoever reads a word
/// that is no option removes the mark.
constexpr char no_option = '\0';

std::string without_mark(std::string word) {
    if (word.starts_with(no_option)) word.erase(0, 1);
    return word;
}

/// What has no place among the arguments.
std::string about_extras(const CLI::App& app, const CLI::App& place) {
    // The parser keeps them back to front; an unknown option comes before its value.
    auto extras = app.remaining(true);
    std::erase(extras, "--");
    for (const std::string& extra : extras)
        if (extra.starts_with('-'))
            return "There is no option " + extra + did_you_mean(place, extra);
    const std::string extra = extras.empty() ? "" : without_mark(extras.front());
    const std::string what = &place == &app ? "There is no command '" : "There is no use for '";
    return what + extra + "'" + did_you_mean(place, extra);
}

std::string about_values(const std::string& what) {
    const std::string option = what.substr(0, what.find(':'));
    if (what.find("At Most 1") != what.npos)
        return option + " is given more than once, but it must be given once.";
    return option + " needs a value after it.";
}

/// The parser says "Could not convert: --fps = 59.94".
std::string about_conversion(const std::string& what) {
    const std::size_t colon = what.find(": "), equals = what.find(" = ");
    if (colon > equals || equals == what.npos)
        return "A value is not a number, but it must be one.";
    const std::string value = what.substr(equals + 3);
    return fmt::format("{} is '{}', but it must be a {}.",
                       what.substr(colon + 2, equals - colon - 2), value,
                       read_number(value) ? "whole number" : "number");
}

/// What the parser has to say, as a sentence that names the value and what would be right.
std::string in_words(const CLI::App& app, const CLI::ParseError& error) {
    const CLI::App& place = deepest(app);
    const std::string name = &place == &app ? "swirl" : "swirl " + place.get_name();
    std::string sentence;
    if (dynamic_cast<const CLI::ExtrasError*>(&error))
        sentence = about_extras(app, place);
    else if (dynamic_cast<const CLI::ArgumentMismatch*>(&error))
        sentence = about_values(error.what());
    else if (dynamic_cast<const CLI::ConversionError*>(&error))
        sentence = about_conversion(error.what());
    else if (dynamic_cast<const CLI::RequiredError*>(&error)) {
        const std::string what = error.what();
        sentence = what.substr(0, what.find(' ')) + " is required, but it is not given.";
    } else {
        sentence = "The call cannot be understood.";
    }
    return sentence + " Try `" + name + " --help`.";
}

/// Several arguments of one kind are "VIDEO..." in the usage, not "films(1x)".
class HelpFormat : public CLI::Formatter {
    std::string make_option_usage(const CLI::Option* option) const override {
        return option->get_expected_max() > 1 ? option->get_type_name() + "..."
                                              : CLI::Formatter::make_option_usage(option);
    }
};

/// What one kind of target asks of the parser.
struct AddTo {
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
        CLI::Option* const added = std::visit(AddTo{app, option}, option.target);
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

/// The names of options have hyphens; with underscores, as in files, they are understood too. After
/// `--` there are no options. The parser wants the words back to front.
std::vector<std::string> words_of(int argc, char** argv) {
    std::vector<std::string> words;
    bool options_ended = false;
    for (int k = 1; k < argc; ++k) {
        std::string word = argv[k];
        if (options_ended) {
            if (word.starts_with('-')) word.insert(word.begin(), no_option);
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
        "A laboratory for swirled granular matter: exact event-driven simulation of discs\n"
        "in a swirled dish, after Lee et al., Phys. Rev. E 100, 012903 (2019).",
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
        app.parse(words_of(argc, argv));
    } catch (const CLI::CallForVersion& asked) {
        return {.act = {}, .text = std::string(asked.what()) + "\n", .usage = {}};
    } catch (const CLI::Success&) {
        return {.act = {}, .text = app.help(), .usage = {}};
    } catch (const CLI::ParseError& error) {
        throw UsageError(in_words(app, error));
    }
    Call call{.act = {}, .text = {}, .usage = app.help()};
    for (auto& [added, subcommand] : *subcommands)
        if (added->parsed()) note_given(*added, subcommand);
    for (const auto& [added, subcommand] : *subcommands)
        if (added->parsed()) call.act = [subcommands, chosen = &subcommand] { chosen->act(); };
    return call;
}

}  // namespace swirl
