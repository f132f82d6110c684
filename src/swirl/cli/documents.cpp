// Writes the manual pages of the commands, and their completions for three shells, into a folder:
//
//     swirl-documents FOLDER
//
// All texts are those of the help: command_list.hpp and the options of each command. The files are
// swirl.1, swirl-NAME.1 of each command, swirl.bash, _swirl (zsh) and swirl.fish. Packages contain
// them (cmake/documents.cmake).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <deque>
#include <exception>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "swirl/cli/command_list.hpp"
#include "swirl/cli/commands.hpp"
#include "swirl/cli/parser.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/run/version.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

/// A command of this build with its options.
struct Described {
    const CommandRow* row;
    Subcommand subcommand;
};
/// Options may refer to their subcommand, so these do not move.
using DescribedCommands = std::deque<Described>;

DescribedCommands described_commands() {
    DescribedCommands commands;
    for (const CommandRow& row : command_list) {
        if (!row.is_listed()) continue;
        const std::string program = "swirl-" + std::string(row.name);
        const Command* const command = Command::of_program(program.c_str());
        if (command == nullptr || command->name() != row.name) continue;
        Described& described = commands.emplace_back(&row, Subcommand{});
        command->add_options(described.subcommand);
    }
    return commands;
}

bool is_flag(const Option& option) { return std::holds_alternative<bool*>(option.target); }

bool is_list(const Option& option) {
    return std::holds_alternative<std::vector<std::string>*>(option.target);
}

bool is_named(const Option& option) { return option.name.starts_with("--"); }

/// The text with other characters for some of them.
std::string escaped(std::string_view text,
                    const std::vector<std::pair<char, std::string_view>>& replacements) {
    std::string result;
    for (const char c : text) {
        std::string_view written(&c, 1);
        for (const auto& [from, to] : replacements)
            if (c == from) written = to;
        result += written;
    }
    return result;
}

/// Text of a manual page. Without these escapes, a terminal shows other quotes and hyphens, which a
/// shell does not accept.
std::string roff(std::string_view text) {
    std::string result = escaped(text, {{'\\', "\\e"},
                                        {'-', "\\-"},
                                        {'\'', "\\(aq"},
                                        {'`', "\\(ga"},
                                        {'^', "\\(ha"},
                                        {'~', "\\(ti"}});
    // A line that begins with a dot would be a request.
    for (std::size_t at = 0; at < result.size(); at = result.find('\n', at) + 1) {
        if (result[at] == '.') result.insert(at, "\\&");
        if (result.find('\n', at) == result.npos) break;
    }
    return result;
}

std::string without_first_line(std::string_view text) {
    return std::string(text.substr(text.find('\n') + 1));
}

std::string head_of_page(std::string_view name, std::string_view description,
                         std::string_view usage) {
    const std::string number = version().substr(0, version().find(' '));
    return fmt::format(".TH {} 1 \"\" \"swirl {}\" \"swirl\"\n", roff(name), number) +
           fmt::format(".SH NAME\n{} \\- {}\n", roff(name), roff(description)) +
           fmt::format(".SH SYNOPSIS\n{}\n", roff(usage));
}

/// Lines that are shown as they are.
std::string examples_of_page(std::string_view examples) {
    return fmt::format(".SH EXAMPLES\n.nf\n{}\n.fi\n", roff(without_first_line(examples)));
}

std::string item(std::string_view name, std::string_view value_form, std::string_view description) {
    const std::string value =
        value_form.empty() ? "" : fmt::format(" \\fI{}\\fP", roff(value_form));
    return fmt::format(".TP\n\\fB{}\\fP{}\n{}\n", roff(name), value, roff(description));
}

std::string options_of_page(const Subcommand& subcommand) {
    std::string text = ".SH OPTIONS\n";
    for (const HelpOption& option : {help_option, full_help_option})
        text += item(option.name, "", option.description);
    std::string group;
    for (const Option& option : subcommand.options()) {
        if (option.help_group != group) text += fmt::format(".SS {}\n", roff(option.help_group));
        group = option.help_group;
        const std::string form = option.value_form + (option.is_required ? " (required)" : "");
        text += item(option.name, form, option.description);
    }
    return text;
}

std::string usage_of(const Described& command) {
    std::string usage = fmt::format("swirl {} [OPTIONS]", command.row->name);
    for (const Option& option : command.subcommand.options()) {
        if (is_named(option)) continue;
        const std::string name = option.name + (is_list(option) ? "..." : "");
        usage += option.is_required ? " " + name : fmt::format(" [{}]", name);
    }
    return usage;
}

std::string page_of(const Described& command) {
    const Subcommand& subcommand = command.subcommand;
    // Scripts of the installed program make some explanations; the build does not call them.
    const std::string explanation =
        subcommand.explanation_is_made() ? "" : subcommand.explanation();
    return head_of_page(fmt::format("swirl-{}", command.row->name), command.row->description,
                        usage_of(command)) +
           options_of_page(subcommand) +
           (explanation.empty() ? "" : ".SH NOTES\n" + roff(explanation)) +
           examples_of_page(subcommand.examples()) + ".SH SEE ALSO\n.BR swirl (1)\n";
}

std::string page_of_swirl(const DescribedCommands& commands) {
    // The texts of `swirl --help`: a sentence and the usage; then options and examples.
    constexpr std::string_view usage_begin = "Usage: ", examples_begin = "Examples:\n";
    const std::string_view before = help_before_commands.substr(1);
    const std::string_view after = help_after_commands.substr(1);
    const std::size_t usage = before.find(usage_begin), examples = after.find(examples_begin);
    std::string text = head_of_page("swirl", before.substr(0, before.find(",\n")),
                                    before.substr(usage + usage_begin.size()));
    text += ".SH DESCRIPTION\n" + roff(before.substr(0, usage));
    std::string_view group;
    std::vector<std::string> pages;
    text += ".SH COMMANDS\n";
    for (const Described& command : commands) {
        if (command.row->group != group) text += fmt::format(".SS {}\n", roff(command.row->group));
        group = command.row->group;
        text += item(command.row->name, "", command.row->description);
        pages.push_back(
            fmt::format(".BR {} (1)", roff(fmt::format("swirl-{}", command.row->name))));
    }
    const std::string options = roff(without_first_line(after.substr(0, examples)));
    text += fmt::format(".SH OPTIONS\n.nf\n{}.fi\n", options);
    text += examples_of_page(after.substr(examples));
    return text + fmt::format(".SH SEE ALSO\n{}\n", fmt::join(pages, ",\n"));
}

/// The names of the options of a command, as words for bash.
std::string option_words(const Subcommand& subcommand) {
    std::vector<std::string_view> names;
    for (const HelpOption& option : {help_option, full_help_option}) names.push_back(option.name);
    for (const Option& option : subcommand.options())
        if (is_named(option)) names.push_back(option.name);
    return fmt::format("{}", fmt::join(names, " "));
}

/// True if a value that is not in the list may be given, such as a number or a file.
bool takes_other_values(const Option& option) {
    return option.value_form != one_of(values_of(option));
}

/// Lines of bash: the values of the last word, if it is an option with known values.
std::string bash_values(const DescribedCommands& commands) {
    std::map<std::pair<std::string, std::string>, std::vector<std::string>> words_of;
    for (const Described& command : commands)
        for (const Option& option : command.subcommand.options())
            if (const auto values = values_of(option); !values.empty())
                words_of[{option.name, fmt::format("{}", fmt::join(values, " "))}].push_back(
                    fmt::format("{},{}", command.row->name, option.name));
    std::string cases;
    for (const auto& [option, words] : words_of)
        cases += fmt::format("        {}) words=\"{}\" ;;\n", fmt::join(words, "|"), option.second);
    return cases;
}

std::string bash_completion(const DescribedCommands& commands) {
    std::vector<std::string_view> names;
    std::string cases;
    for (const Described& command : commands) {
        names.push_back(command.row->name);
        cases += fmt::format("        *,{},-*) words=\"{}\" ;;\n", command.row->name,
                             option_words(command.subcommand));
    }
    return fmt::format(R"(_swirl() {{
    local commands="{}"
    local word=${{COMP_WORDS[COMP_CWORD]}} last=${{COMP_WORDS[COMP_CWORD-1]}} words=
    if [[ $word == = ]]; then
        word=
    elif [[ $last == = ]]; then
        last=${{COMP_WORDS[COMP_CWORD-2]}}
    fi
    case ${{COMP_WORDS[1]}},$last in
{}    esac
    [[ -n $words ]] || case $COMP_CWORD,${{COMP_WORDS[1]}},$word in
        1,*) words="$commands help --help --version" ;;
        2,help,*) words=$commands ;;
{}    esac
    COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o default -F _swirl swirl
)",
                       fmt::join(names, " "), bash_values(commands), cases);
}

/// Text within single quotes of zsh, in which a colon or a bracket ends a description.
std::string zsh_text(std::string_view text) {
    return escaped(text,
                   {{'\'', "'\\''"}, {'\\', "\\\\"}, {':', "\\:"}, {'[', "\\["}, {']', "\\]"}});
}

std::string zsh_option(const Option& option) {
    const bool is_repeated = is_list(option) || option.joined_by != '\0';
    const std::string form = option.value_form.empty() ? "value" : option.value_form;
    const std::string values = fmt::format("{}", fmt::join(values_of(option), " "));
    const std::string action = values.empty()               ? "_files"
                               : takes_other_values(option) ? "{compadd " + values + "; _files}"
                                                            : "(" + values + ")";
    return fmt::format("            '{}{}[{}]{}' \\\n", is_repeated ? "*" : "", option.name,
                       zsh_text(option.description),
                       is_flag(option) ? "" : fmt::format(":{}:{}", zsh_text(form), action));
}

std::string zsh_completion(const DescribedCommands& commands) {
    std::string names, cases;
    for (const Described& command : commands) {
        const std::string_view name = command.row->name;
        names += fmt::format("        '{}:{}'\n", name, zsh_text(command.row->description));
        cases += fmt::format("        {}) _arguments \\\n", name);
        for (const HelpOption& option : {help_option, full_help_option})
            cases += fmt::format("            '{}[{}]' \\\n", option.name, option.description);
        for (const Option& option : command.subcommand.options())
            if (is_named(option)) cases += zsh_option(option);
        cases += "            '*:file:_files' ;;\n";
    }
    return fmt::format(R"(#compdef swirl
_swirl() {{
    local -a commands=(
{}    )
    if (( CURRENT == 2 )); then
        _describe command commands
        return
    fi
    local command=$words[2]
    shift words
    (( CURRENT-- ))
    case $command in
        help) _describe command commands ;;
{}    esac
}}
if [[ $funcstack[1] == _swirl ]]; then
    _swirl "$@"
else
    compdef _swirl swirl
fi
)",
                       names, cases);
}

std::string fish_text(std::string_view text) {
    return escaped(text, {{'\\', "\\\\"}, {'\'', "\\'"}});
}

/// A line that completes the names of commands after this condition.
std::string fish_command(std::string_view condition, const CommandRow& row) {
    return fmt::format("complete -c swirl -n '{}' -f -a {} -d '{}'\n", condition, row.name,
                       fish_text(row.description));
}

/// A line that completes an option; `more` are words for its value.
std::string fish_option(std::string_view command, std::string_view name, std::string_view more,
                        std::string_view description) {
    const bool is_long = name.starts_with("--");
    return fmt::format("complete -c swirl -n '__fish_seen_subcommand_from {}' {} {}{} -d '{}'\n",
                       command, is_long ? "-l" : "-s", name.substr(is_long ? 2 : 1), more,
                       fish_text(description));
}

/// What follows the name of an option: nothing for a flag, or its values, with files if there are
/// other ones.
std::string fish_values(const Option& option) {
    if (is_flag(option)) return "";
    const std::string values = fmt::format("{}", fmt::join(values_of(option), " "));
    if (values.empty()) return " -r";
    return fmt::format(" {} -a '{}'", takes_other_values(option) ? "-r" : "-x", values);
}

std::string fish_completion(const DescribedCommands& commands) {
    std::string text = "complete -c swirl -n __fish_use_subcommand -f -a help\n";
    for (const Described& command : commands) {
        const std::string_view name = command.row->name;
        text += fish_command("__fish_use_subcommand", *command.row);
        text += fish_command("__fish_seen_subcommand_from help", *command.row);
        for (const HelpOption& option : {help_option, full_help_option})
            text += fish_option(name, option.name, "", option.description);
        for (const Option& option : command.subcommand.options())
            if (is_named(option))
                text += fish_option(name, option.name, fish_values(option), option.description);
    }
    return text;
}

void write_documents(const fs::path& folder) {
    const DescribedCommands commands = described_commands();
    write_file_atomically(folder / "swirl.1", page_of_swirl(commands));
    for (const Described& command : commands)
        write_file_atomically(folder / fmt::format("swirl-{}.1", command.row->name),
                              page_of(command));
    write_file_atomically(folder / "swirl.bash", bash_completion(commands));
    write_file_atomically(folder / "_swirl", zsh_completion(commands));
    write_file_atomically(folder / "swirl.fish", fish_completion(commands));
}

}  // namespace
}  // namespace swirl

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    try {
        swirl::write_documents(argv[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "error: %s\n", error.what());
        return 1;
    }
    return 0;
}
