// The subcommands. Each has its own file command_<name>.cpp, which registers it by
//
//     namespace { const swirl::Command run_command("run", add_run_command); }
//
// and a row in command_list.hpp. A program contains one command. In packages, one program contains
// them all (cmake/install.cmake).
#pragma once

#include <memory>
#include <vector>

#include "swirl/cli/options.hpp"

namespace swirl {

class Command {
  public:
    using Add = void (*)(Subcommand& subcommand);

    /// `add` defines the options and the callback of the subcommand.
    Command(const char* name, Add add);

    const char* name() const { return name_; }
    void add_options(Subcommand& subcommand) const { add_(subcommand); }

    /// The command of this program; if it contains several, the one that its file name `argv0`,
    /// such as swirl-run, has. Nothing if it does not contain that one.
    static const Command* of_program(const char* argv0);

  private:
    const char* name_;
    Add add_;
};

}  // namespace swirl
