// Parses the arguments of the program.
#pragma once

#include <functional>
#include <string>

namespace swirl {

/// The parsed arguments.
struct Call {
    std::function<void()> check = {};  // throws UsageError for a wrong call
    std::function<void()> act;         // the subcommand with its options; empty if there is none
    std::string text;                  // the output of --help or --version
    std::string usage;                 // the help of the whole program
};

/// Throws UsageError for invalid arguments.
Call parse(int argc, char** argv);

}  // namespace swirl
