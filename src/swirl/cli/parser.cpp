#include "swirl/cli/parser.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <functional>
#include <utility>
#include <vector>

#include "swirl/cli/command_list.hpp"
#include "swirl/cli/commands.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/reading.hpp"

namespace swirl {
namespace {

/// The width of the terminal; a constant if the help goes to a file or a pipe.
std::size_t help_width() {
    constexpr std::size_t narrowest = 40, widest = 100;
    return std::clamp(terminal_width(STDOUT_FILENO, widest), narrowest, widest);
}

/// The number of characters of UTF-8 text.
std::size_t characters(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    }));
}

/// Breaks lines at spaces, except commands. The continuation of an indented line (a row of a list)
/// is indented by two more.
std::string wrapped(const std::string& text, std::size_t width) {
    std::string result;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t end = std::min(text.find('\n', from), text.size());
        std::string line = text.substr(from, end - from);
        const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
        const std::string margin(indent == 0 ? 0 : indent + 2, ' ');
        const bool is_command = line.compare(indent, 6, "swirl ") == 0;  // a command to copy
        while (!is_command) {
            std::size_t at = line.size();
            while (at != line.npos && at > indent && characters(line.substr(0, at)) > width)
                at = line.rfind(' ', at - 1);
            if (at == line.npos || at <= margin.size() || at == line.size()) break;
            result += line.substr(0, at) + '\n';
            line = margin + line.substr(line.find_first_not_of(' ', at));
        }
        result += line;
        if (end < text.size()) result += '\n';
        from = end + 1;
    }
    return result;
}

constexpr std::size_t column_of_descriptions = 34;
constexpr int max_values = 100;  // values of a repeated option

/// The option that the user probably means, or "".
std::string nearest_option(const CLI::App& app, const std::string& unknown) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) names.push_back(option->get_name());
    return nearest_name(unknown.substr(0, unknown.find('=')), names).value_or("");
}

/// The parser does not end options at `--` once a subcommand has all its files. Each later word
/// that starts with a dash therefore gets this mark, which no argument can contain. Positional
/// arguments remove it.
constexpr char not_an_option = '\0';

std::string without_mark(std::string word) {
    if (word.starts_with(not_an_option)) word.erase(0, 1);
    return word;
}

struct Message {
    std::string text;
    std::string option = {};  // the one that the text is about
    std::string meant = {};   // the one that was probably meant
};

Message message_on_extras(const CLI::App& app) {
    // The parser returns the words in reverse order; an unknown option comes before its value.
    auto extras = app.remaining();
    std::erase(extras, "--");
    for (const std::string& extra : extras)
        if (extra.starts_with('-'))
            return {.text = "there is no option " + extra + ".",
                    .meant = nearest_option(app, extra)};
    const std::string extra = extras.empty() ? "" : without_mark(extras.front());
    return {.text = "unexpected argument '" + extra + "'.", .meant = nearest_option(app, extra)};
}

Message message_on_missing_value(const std::string& what) {
    const std::string option = what.substr(0, what.find(':'));
    if (what.find("At Most 1") != what.npos) return {option + " may be given only once.", option};
    if (const auto flag = what.find(" was given a disallowed flag override"); flag != what.npos) {
        const std::string name = "--" + what.substr(0, flag);
        return {name + " is a switch and takes no value.", name};
    }
    return {option + " needs a value.", option};
}

/// The parser's text is "Could not convert: --fps = 59.94".
Message message_on_conversion(const std::string& what) {
    const std::size_t colon = what.find(": "), equals = what.find(" = ");
    if (colon > equals || equals == what.npos) return {"a value is not a number."};
    const std::string option = what.substr(colon + 2, equals - colon - 2);
    const std::string value = what.substr(equals + 3);
    return {fmt::format("{} is '{}', but it must be a {}.", option, value,
                        read_number(value) ? "whole number" : "number"),
            option};
}

Message message_on_missing_option(const CLI::App& app, const std::string& what) {
    // An unknown option may be the missing one under another name.
    const auto extras = app.remaining();
    if (std::any_of(extras.begin(), extras.end(), [](const std::string& extra) {
            return extra.starts_with("--") && extra != "--";
        }))
        return message_on_extras(app);
    const std::string name = what.substr(0, what.find(' '));
    const CLI::Option* const option = app.get_option_no_throw(name);
    const std::string form = option ? " " + option->get_type_name() : "";
    return {name.starts_with('-') ? "missing required option " + name + form + "."
                                  : "missing required argument " + name + "."};
}

/// "run" for "swirl run".
std::string command_of(const CLI::App& app) {
    return app.get_name().substr(std::string_view("swirl ").size());
}

/// "my-points" for the group "My points".
std::string topic_of(const std::string& group) {
    std::string topic = group;
    for (char& c : topic) c = c == ' ' ? '-' : static_cast<char>(std::tolower(c));
    return topic;
}

/// The topics of `swirl help NAME TOPIC`, with the number of options of each.
std::vector<std::pair<std::string, int>> topics_of(const Subcommand& subcommand) {
    std::vector<std::pair<std::string, int>> topics;
    for (const Option& option : subcommand.options()) {
        if (option.help_group.empty()) continue;
        const std::string topic = topic_of(option.help_group);
        const auto same = [&](const auto& known) { return known.first == topic; };
        auto found = std::find_if(topics.begin(), topics.end(), same);
        if (found == topics.end()) found = topics.insert(found, {topic, 0});
        ++found->second;
    }
    return topics;
}

/// The command that describes an option, or else all of them.
std::string help_on_option(const CLI::App& app, const Subcommand& subcommand,
                           const std::string& name) {
    for (const Option& option : subcommand.options()) {
        if (option.name != name || option.help_group.empty()) continue;
        if (option.is_of_run) return "swirl help run " + topic_of(option.help_group);
        if (subcommand.has_divided_help())
            return fmt::format("swirl help {} {}", command_of(app), topic_of(option.help_group));
    }
    return app.get_name() + " --help";
}

std::string error_text(const CLI::App& app, const Subcommand& subcommand,
                       const CLI::ParseError& error) {
    Message message{"invalid arguments."};
    if (dynamic_cast<const CLI::ExtrasError*>(&error))
        message = message_on_extras(app);
    else if (dynamic_cast<const CLI::ArgumentMismatch*>(&error))
        message = message_on_missing_value(error.what());
    else if (dynamic_cast<const CLI::ConversionError*>(&error))
        message = message_on_conversion(error.what());
    else if (dynamic_cast<const CLI::RequiredError*>(&error))
        message = message_on_missing_option(app, error.what());
    if (message.meant.empty())
        return fmt::format("{}\nhint: see `{}`.", message.text,
                           help_on_option(app, subcommand, message.option));
    return fmt::format("{}\nhint: did you mean {}? See `{}`.", message.text, message.meant,
                       help_on_option(app, subcommand, message.meant));
}

/// Wraps descriptions at the width of the terminal, and shows a repeated argument as "VIDEO..." in
/// the usage.
class HelpFormat : public CLI::Formatter {
    std::string make_option_desc(const CLI::Option* option) const override {
        const std::size_t indent = std::min(column_of_descriptions, help_width() / 2);
        return wrapped(CLI::Formatter::make_option_desc(option), help_width() - indent);
    }
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
        return app.add_flag(option.name, *flag, option.description)->disable_flag_override();
    }
    CLI::Option* operator()(std::vector<std::string>* values) const {
        return app.add_option(option.name, *values, option.description)->expected(1, max_values);
    }
    CLI::Option* operator()(const std::function<void(const std::string&)>& take) const {
        if (option.joined_by == '\0')
            return app.add_option_function(option.name, take, option.description);
        // The parser's own join() drops empty parts, and then takes the next option as the value.
        const auto take_joined = [take, separator = std::string(1, option.joined_by)](
                                     const std::vector<std::string>& values) {
            take(fmt::format("{}", fmt::join(values, separator)));
            return true;
        };
        return app.add_option(option.name, take_joined, option.description)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    }
    CLI::Option* operator()(auto* value) const {
        return app.add_option(option.name, *value, option.description);
    }
};

/// Whether an option belongs to a page of the help.
using Listed = std::function<bool(const Option&)>;

bool is_any(const Option&) { return true; }

void add_to(CLI::App& app, const Subcommand& subcommand, const Listed& is_listed) {
    for (const Option& option : subcommand.options()) {
        if (!is_listed(option)) continue;
        CLI::Option* const added = std::visit(OptionAdder{app, option}, option.target);
        if (!option.value_form.empty()) added->type_name(option.value_form);
        if (!option.help_group.empty()) added->group(option.help_group);
        if (option.is_required) added->required();
        if (!option.name.starts_with('-')) added->transform(without_mark);
    }
}

void set_help_options(CLI::App& app) {
    app.set_help_flag(help_option.name, help_option.description);
    app.set_help_all_flag(full_help_option.name, full_help_option.description);
    app.formatter(std::make_shared<HelpFormat>());
    app.get_formatter()->column_width(std::min(column_of_descriptions, help_width() / 2));
}

/// The help of an app with a footer. CLI11 adds line feeds at its end and before each group.
std::string text_of(CLI::App& shown, const std::string& footer) {
    shown.footer(wrapped(footer, help_width()));
    std::string text = shown.help();
    while (text.ends_with("\n\n")) text.pop_back();
    for (std::size_t at = 0; (at = text.find("\n\n\n", at)) != text.npos;) text.erase(at, 1);
    return text;
}

/// A page of the help with these options.
std::string page(const CLI::App& app, const Subcommand& subcommand, const Listed& is_listed,
                 const std::string& footer) {
    CLI::App shown(app.get_description(), app.get_name());
    set_help_options(shown);
    add_to(shown, subcommand, is_listed);
    return text_of(shown, footer);
}

/// The first page of a divided help: the main options in one group, the topics and two examples.
std::string first_page(const CLI::App& app, const Subcommand& subcommand) {
    CLI::App shown(app.get_description(), app.get_name());
    set_help_options(shown);
    shown.set_help_all_flag();
    shown.set_help_flag(fmt::format("{},{}", help_option.name, full_help_option.name),
                        "Main options and topics");
    add_to(shown, subcommand, [&](const Option& option) { return subcommand.is_main(option); });
    for (CLI::Option* const option : shown.get_options())
        if (!option->get_positional()) option->group("Options");
    std::string footer = "Topics:";
    for (const auto& [topic, count] : topics_of(subcommand)) {
        const std::string call = fmt::format("swirl help {} {}", command_of(app), topic);
        footer += fmt::format("\n  {:<32}{} options", call, count);
    }
    const std::string& examples = subcommand.examples();
    std::size_t end = 0;
    for (int line = 0; line < 3 && end < examples.size(); ++line)
        end = std::min(examples.find('\n', end + 1), examples.size());
    return text_of(shown, footer + "\n\n" + examples.substr(0, end));
}

/// The answer to -h.
std::string short_help(const CLI::App& app, const Subcommand& subcommand) {
    if (subcommand.has_divided_help()) return first_page(app, subcommand);
    return page(
        app, subcommand, [&](const Option& option) { return subcommand.is_main(option); },
        fmt::format("All options: {} --help\n\n{}", app.get_name(), subcommand.examples()));
}

/// The answer to --help.
std::string long_help(const CLI::App& app, const Subcommand& subcommand) {
    if (subcommand.has_divided_help()) return first_page(app, subcommand);
    std::string of_run;
    const auto is_of_run = [](const Option& option) { return option.is_of_run; };
    if (std::any_of(subcommand.options().begin(), subcommand.options().end(), is_of_run)) {
        const auto& missing = subcommand.missing_of_run();
        of_run =
            fmt::format("All parameters of a run apply{}: swirl help run\n\n",
                        missing.empty() ? "" : fmt::format(" except {}", fmt::join(missing, ", ")));
    }
    return page(
        app, subcommand, [&](const Option& option) { return !option.is_of_run; },
        of_run + subcommand.explanation() + subcommand.examples());
}

/// The answer to `swirl help NAME TOPIC`.
std::string help_on(const CLI::App& app, const Subcommand& subcommand, const std::string& topic) {
    const std::string end = subcommand.explanation() + subcommand.examples();
    if (topic == "all") return page(app, subcommand, is_any, end);
    std::vector<std::string> topics{"all"};
    for (const auto& known : topics_of(subcommand)) topics.push_back(known.first);
    if (std::find(topics.begin(), topics.end(), topic) == topics.end())
        throw UsageError(fmt::format("'{}' is no topic of `{}`.\nhint: the topics are {}.", topic,
                                     app.get_name(), fmt::join(topics, ", ")));
    return page(
        app, subcommand,
        [&](const Option& option) {
            return !option.help_group.empty() && topic_of(option.help_group) == topic;
        },
        topic == "output" ? end : subcommand.examples());
}

void note_given(const CLI::App& app, Subcommand& subcommand) {
    for (Option& option : subcommand.options())
        option.is_given = app.get_option(option.name)->count() > 0;
}

/// "--mu_disc=1" and "--mu-disc=1" give the same word.
std::string with_standard_name(const std::string& word) {
    const std::size_t end = std::min(word.find('='), word.size());
    std::string name = standard_spelling(word.substr(0, end));
    std::replace(name.begin(), name.end(), '_', '-');
    return name + word.substr(end);
}

/// The arguments in reverse order, as the parser expects them. Standardizes the names of options,
/// and marks words after `--`.
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
            word = with_standard_name(word);
        }
        words.push_back(std::move(word));
    }
    std::reverse(words.begin(), words.end());
    return words;
}

}  // namespace

Call parse(const Command& command, int argc, char** argv) {
    const CommandRow* const row = command_named(command.name());
    CLI::App app(std::string(row->description), std::string("swirl ") + command.name());
    set_help_options(app);
    const auto subcommand = std::make_shared<Subcommand>();
    command.add_options(*subcommand);
    add_to(app, *subcommand, is_any);
    constexpr std::string_view topic = "--help=";  // `swirl help NAME TOPIC`
    if (argc == 2 && std::string_view(argv[1]).starts_with(topic))
        return {.text = help_on(app, *subcommand, argv[1] + topic.size())};
    try {
        app.parse(reversed_words(argc, argv));
    } catch (const CLI::CallForAllHelp&) {
        return {.text = long_help(app, *subcommand)};
    } catch (const CLI::CallForHelp&) {
        return {.text = short_help(app, *subcommand)};
    } catch (const CLI::ParseError& error) {
        throw UsageError(error_text(app, *subcommand, error));
    }
    note_given(app, *subcommand);
    return {.check = [subcommand] { subcommand->check(); },
            .act = [subcommand] { subcommand->act(); }};
}

}  // namespace swirl
