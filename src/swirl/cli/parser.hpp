// Arguments in, the subcommand that they name out.
#pragma once

#include <functional>
#include <string>

namespace swirl {

/// What the arguments ask for.
struct Call {
    std::function<void()> act;  // the subcommand with its options; empty if there is none
    std::string text;           // instead: what was asked for with --help or --version
    std::string usage;          // the help of the whole program
};

/// Throws WrongCall, with a sentence that names the value and what would be right.
Call parse(int argc, char** argv);

}  // namespace swirl
