#include "swirl/cli/commands.hpp"

#include <algorithm>

namespace swirl {
namespace {

std::vector<const Command*>& registered() {
    static std::vector<const Command*> commands;
    return commands;
}

}  // namespace

Command::Command(int order, const char* name, const char* description, Add add)
    : order_(order), name_(name), description_(description), add_(add) {
    registered().push_back(this);
}

std::vector<const Command*> Command::all() {
    std::vector<const Command*> commands = registered();
    std::sort(commands.begin(), commands.end(),
              [](const Command* a, const Command* b) { return a->order() < b->order(); });
    return commands;
}

}  // namespace swirl
