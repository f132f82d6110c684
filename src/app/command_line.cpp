#include "app/command_line.hpp"

#include <filesystem>

namespace swirl {
namespace {

std::string& remembered() {
    static std::string line;
    return line;
}

std::string quoted(const std::string& word) {
    const bool plain = !word.empty() && word.find_first_not_of(
                                            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                            "0123456789_-+=./:,@%") == std::string::npos;
    if (plain) return word;
    std::string text;
    text += '\'';
    for (const char c : word) {
        if (c == '\'') text += "'\\'";
        text += c;
    }
    text += '\'';
    return text;
}

}  // namespace

const std::string& command_line() { return remembered(); }

void remember_command_line(int argc, char** argv) {
    std::string line = "swirl";
    for (int k = 1; k < argc; ++k) {
        line += ' ';
        line += quoted(argv[k]);
    }
    remembered() = line;
}

}  // namespace swirl
