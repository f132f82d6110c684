// Parses the arguments of a command.
#pragma once

#include <functional>
#include <string>

namespace swirl {

class Command;

/// The options of every command that print its help.
struct HelpOption {
    const char *name, *description;
};
inline constexpr HelpOption help_option{"-h", "Main options"};
inline constexpr HelpOption full_help_option{"--help", "All options and topics"};

/// The parsed arguments.
struct Call {
    std::function<void()> check = {};  // throws UsageError for a wrong call
    std::function<void()> act = {};    // the command with its options
    std::string text = {};             // the output of --help, instead of these
};

/// Throws UsageError for invalid arguments.
Call parse(const Command& command, int argc, char** argv);

}  // namespace swirl
