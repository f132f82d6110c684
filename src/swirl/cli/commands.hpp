// The subcommands. Each has its own file command_<name>.cpp and registers itself by
//
//     namespace { const swirl::Command run_command(10, "run", "One run", add_run_command); }
//
// A new subcommand needs no other change.
#pragma once

#include <memory>
#include <vector>

#include "swirl/cli/options.hpp"

namespace swirl {

class Command {
  public:
    using Add = void (*)(Subcommand& subcommand);

    /// `order` sorts the list in `swirl --help`. `add` defines the options and the callback of the
    /// subcommand.
    Command(int order, const char* name, const char* description, Add add);

    int order() const { return order_; }
    const char* name() const { return name_; }
    const char* description() const { return description_; }
    void add_options(Subcommand& subcommand) const { add_(subcommand); }

    /// All subcommands, sorted.
    static std::vector<const Command*> all();

  private:
    int order_;
    const char* name_;
    const char* description_;
    Add add_;
};

}  // namespace swirl
