// The subcommands. Each lives in its own file command_<name>.cpp and adds itself to the program by
//
//     namespace { const swirl::Command run_command(10, "run", "One run.", add_run_command); }
//
// so that a new one is a new file and nothing else.
#pragma once

#include <memory>
#include <vector>

#include "swirl/cli/options.hpp"

namespace swirl {

class Command {
  public:
    using Add = void (*)(Subcommand& subcommand);

    /// `place` decides about the order in `swirl --help`. `add` gives the subcommand its options
    /// and its callback.
    Command(int place, const char* name, const char* description, Add add);

    int place() const { return place_; }
    const char* name() const { return name_; }
    const char* description() const { return description_; }
    void add_options(Subcommand& subcommand) const { add_(subcommand); }

    /// All there are, in order.
    static std::vector<const Command*> all();

  private:
    int place_;
    const char* name_;
    const char* description_;
    Add add_;
};

}  // namespace swirl
