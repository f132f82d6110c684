#include "swirl/app/commands.hpp"

#include <algorithm>

namespace swirl {
namespace {

std::vector<const Command*>& registered() {
    static std::vector<const Command*> commands;
    return commands;
}

}  // namespace

Command::Command(int place, const char* name, const char* description, Add add)
    : place_(place), name_(name), description_(description), add_(add) {
    registered().push_back(this);
}

void Command::add_to(CLI::App& app) const {
    CLI::App* const subcommand = app.add_subcommand(name_, description_);
    add_(*subcommand);
}

std::vector<const Command*> Command::all() {
    std::vector<const Command*> commands = registered();
    std::sort(commands.begin(), commands.end(),
              [](const Command* a, const Command* b) { return a->place() < b->place(); });
    return commands;
}

void set_examples(CLI::App& subcommand, const std::vector<std::string>& examples) {
    std::string text = "Examples:";
    for (const std::string& example : examples) text += "\n  " + example;
    subcommand.footer(text);
}

}  // namespace swirl
