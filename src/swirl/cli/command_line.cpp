#include "swirl/cli/command_line.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <string_view>

#include "swirl/io/utf8.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/shell_word.hpp"

namespace swirl {
namespace {

std::string& stored_line() {
    static std::string line;
    return line;
}

/// The printable ASCII characters of the word, and \xNN for all other bytes.
std::string ascii_text(std::string_view word) {
    std::string text;
    for (const char c : word)
        text += c >= 0x20 && c < 0x7f ? std::string(1, c)
                                      : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    return text;
}

}  // namespace

void reject_invalid_utf8(int argc, char** argv) {
    for (int k = 1; k < argc; ++k) {
        const std::string_view word = argv[k];
        if (!first_byte_not_utf8(word)) continue;
        throw UsageError(
            fmt::format("'{}' is not UTF-8 text, but results and recordings can store "
                        "only UTF-8.\nhint: use another name.",
                        ascii_text(word)));
    }
}

const std::string& command_line() { return stored_line(); }

void remember_command_line(int argc, char** argv) {
    std::string line = "swirl";
    for (int k = 1; k < argc; ++k) {
        line += ' ';
        line += shell_word(argv[k]);
    }
    stored_line() = line;
}

}  // namespace swirl
