#include "swirl/cli/commands.hpp"

#include <filesystem>

namespace swirl {
namespace {

std::vector<const Command*>& registered() {
    static std::vector<const Command*> commands;
    return commands;
}

}  // namespace

Command::Command(const char* name, Add add) : name_(name), add_(add) {
    registered().push_back(this);
}

const Command* Command::of_program(const char* argv0) {
    if (registered().size() == 1) return registered().front();
    const std::string program = std::filesystem::path(argv0).filename().string();
    for (const Command* const command : registered())
        if (program == std::string("swirl-") + command->name()) return command;
    return nullptr;
}

}  // namespace swirl
