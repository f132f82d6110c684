#include "swirl/cli/command_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "swirl/cli/options.hpp"
#include "swirl/io/utf8.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/shell_word.hpp"

namespace swirl {
namespace {

std::vector<std::string>& stored_words() {
    static std::vector<std::string> words;
    return words;
}

bool& omits_paths() {
    static bool omits = false;
    return omits;
}

/// --motion=/home/ada/a.csv → --motion=a.csv, file:../a.csv → file:a.csv. A fraction such as
/// 30000/1001 stays.
std::string without_folders(std::string_view word) {
    std::string text;
    while (!word.empty()) {
        const std::size_t end = std::min(word.find_first_of("=:,"), word.size());
        std::string_view part = word.substr(0, end);
        while (part.size() > 1 && part.ends_with('/')) part.remove_suffix(1);
        const std::size_t slash = part.rfind('/');
        if (slash != part.npos && part.find_first_not_of("0123456789/.") != part.npos)
            part.remove_prefix(slash + 1);
        text += part;
        if (end < word.size()) text += word[end];
        word.remove_prefix(std::min(end + 1, word.size()));
    }
    return text;
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

Option omit_paths_option() {
    return {"--portable", &omits_paths(), "Store file names without folders, no config text"};
}

std::string command_line() {
    std::string line = "swirl";
    for (const std::string& word : stored_words()) line += ' ' + shell_word(stored_path(word));
    return line;
}

std::string stored_path(const std::string& file) {
    return omits_paths() ? without_folders(file) : file;
}

std::string stored_config(const std::string& text) { return omits_paths() ? "" : text; }

void remember_command_line(const char* command, int argc, char** argv) {
    stored_words().assign(argv + 1, argv + argc);
    stored_words().insert(stored_words().begin(), command);
}

}  // namespace swirl
