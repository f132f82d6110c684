// The program `swirl`: lists the commands, and becomes the program of the one that is called. It
// uses the standard library only, because its start is part of every call.
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "swirl/cli/command_list.hpp"
#include "swirl/io/utf8.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/names.hpp"
#include "swirl/run/programs.hpp"
#include "swirl/run/version.hpp"

namespace {

constexpr int failure = 1, usage_error = 2;

int report_error(const std::exception& error, int exit_code) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return exit_code;
}

std::string list_of_commands() {
    constexpr std::size_t column = 34;
    std::string text(swirl::help_before_commands.substr(1));
    std::string_view group;
    for (const swirl::CommandRow& row : swirl::command_list) {
        if (!row.is_listed()) continue;
        if (row.group != group) text += "\n" + std::string(row.group) + ":\n";
        group = row.group;
        std::string line = "  " + std::string(row.name);
        line.resize(column, ' ');
        text += line + std::string(row.description) + "\n";
    }
    return text + std::string(swirl::help_after_commands);
}

int print_all(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0)
        return 0;
    throw swirl::Failure(std::string("writing to standard output failed: ") + std::strerror(errno) +
                         ".");
}

/// The library of a command that this build lacks; empty if it lacks none.
std::string_view missing_library(const swirl::CommandRow& row) {
    if (row.libraries.find("camera") != row.libraries.npos && !SWIRL_HAS_CAMERA) return "camera";
    if (row.libraries.find("drawing") != row.libraries.npos && !SWIRL_HAS_DRAWING) return "drawing";
    return {};
}

[[noreturn]] void report_missing(const swirl::CommandRow& row) {
    const std::string name(row.name);
    const std::string_view library = missing_library(row);
    if (library == "camera")
        throw swirl::Failure(
            "this build has no camera support (OpenCV was not found).\n"
            "hint: install libopencv-core-dev and libopencv-imgproc-dev and rebuild; ./swirl " +
            name + " does both.");
    if (library == "drawing")
        throw swirl::Failure(
            "this build cannot draw (cairo was not found).\n"
            "hint: install libcairo2-dev and rebuild; ./swirl " +
            name + " does both.");
    throw swirl::Failure("the program of `swirl " + name + "`, swirl-" + name +
                         ", is not installed.\nhint: in the source folder, ./swirl " + name +
                         " builds it.");
}

[[noreturn]] void reject_unknown(const std::string& word) {
    if (swirl::first_byte_not_utf8(word))
        throw swirl::UsageError(
            "the name of the command is not UTF-8 text.\nhint: see `swirl --help`.");
    std::vector<std::string> names{"--help", "--version"};
    if (!word.starts_with('-'))
        for (const swirl::CommandRow& row : swirl::command_list)
            if (row.is_listed()) names.emplace_back(row.name);
    const auto nearest = swirl::nearest_name(word.substr(0, word.find('=')), names);
    throw swirl::UsageError((word.starts_with('-') ? "there is no option " + word + "."
                                                   : "there is no command '" + word + "'.") +
                            (nearest ? "\nhint: did you mean " + *nearest + "? See `swirl --help`."
                                     : "\nhint: see `swirl --help`."));
}

/// Becomes the program of the command, which gets these words.
[[noreturn]] void run_command(const std::string& name, std::vector<char*> words) {
    const swirl::CommandRow* const row = swirl::command_named(name);
    if (row == nullptr) reject_unknown(name);
    if (row->is_script())
        throw swirl::UsageError("`swirl " + name +
                                "` belongs to the source folder of swirl.\nhint: run ./swirl " +
                                name + " there.");
    if (!missing_library(*row).empty()) report_missing(*row);
    const std::string program = swirl::program_of_command(name).string();
    if (program.empty()) report_missing(*row);
    std::string program_name = "swirl-" + name;  // swirl-commands chooses the command by it
    words.insert(words.begin(), program_name.data());
    words.push_back(nullptr);
    execv(program.c_str(), words.data());
    throw swirl::Failure("'" + program + "' cannot be started: " + std::strerror(errno) +
                         ".\nhint: install swirl again.");
}

int main_or_throw(int argc, char** argv) {
    if (argc < 2) {
        std::fputs(list_of_commands().c_str(), stderr);
        return usage_error;
    }
    const std::string word = argv[1];
    if (word == "--version") return print_all(swirl::version() + "\n");
    if (word == "--help" || word == "-h" || (word == "help" && argc == 2))
        return print_all(list_of_commands());
    if (word == "help") {
        std::string topic = argc > 3 ? std::string("--help=") + argv[3] : "--help";
        run_command(argv[2], {topic.data()});
    }
    run_command(word, {argv + 2, argv + argc});
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return main_or_throw(argc, argv);
    } catch (const swirl::UsageError& error) {
        return report_error(error, usage_error);
    } catch (const std::exception& error) {
        return report_error(error, failure);
    }
}
