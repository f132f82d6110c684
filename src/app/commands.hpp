// The subcommands. Each lives in its own file command_<name>.cpp and adds itself to the program by
//
//     namespace { const swirl::Command run_command(10, "run", "One run.", add_run_command); }
//
// so that a new one is a new file and nothing else.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace swirl {

class Command {
  public:
    using Add = void (*)(CLI::App& subcommand);

    /// `place` decides about the order in `swirl --help`. `add` gives the subcommand its options
    /// and its callback; what goes wrong in there is thrown (run/failure.hpp).
    Command(int place, const char* name, const char* description, Add add);

    int place() const { return place_; }
    void add_to(CLI::App& app) const;

    /// All there are, in order.
    static std::vector<const Command*> all();

  private:
    int place_;
    const char* name_;
    const char* description_;
    Add add_;
};

/// Lines at the end of a subcommand's help, each one a call that works.
void set_examples(CLI::App& subcommand, const std::vector<std::string>& examples);

}  // namespace swirl
