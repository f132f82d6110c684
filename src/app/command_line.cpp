#include "swirl/app/command_line.hpp"

#include <filesystem>

#include "swirl/study/shell_word.hpp"

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
    return plain ? word : in_quotes(word);
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
