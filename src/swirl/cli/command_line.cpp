#include "swirl/cli/command_line.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <string_view>

#include "swirl/io/utf8.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/shell_word.hpp"

namespace swirl {
namespace {

std::string& remembered() {
    static std::string line;
    return line;
}

}  // namespace

void reject_what_is_no_text(int argc, char** argv) {
    for (int k = 1; k < argc; ++k) {
        const std::string_view word = argv[k];
        if (!first_byte_not_utf8(word)) continue;
        std::string shown;
        for (const char c : word)
            shown += c >= 0x20 && c < 0x7f
                         ? std::string(1, c)
                         : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
        throw UsageError(fmt::format(
            "'{}' is not UTF-8 text, and results and recordings, which tell the call, can hold "
            "nothing else; use another name.",
            shown));
    }
}

const std::string& command_line() { return remembered(); }

void remember_command_line(int argc, char** argv) {
    std::string line = "swirl";
    for (int k = 1; k < argc; ++k) {
        line += ' ';
        line += shell_word(argv[k]);
    }
    remembered() = line;
}

}  // namespace swirl
