// Quotes a word of a command for a POSIX shell.
#pragma once

#include <string>
#include <string_view>

namespace swirl {

/// Returns the word itself if a shell does not change it, otherwise in single quotes. A quote inside
/// the word is escaped outside of them.
inline std::string shell_word(std::string_view word) {
    constexpr std::string_view safe =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
    if (!word.empty() && word.find_first_not_of(safe) == word.npos) return std::string(word);
    std::string text = "'";
    for (const char c : word) {
        if (c == '\'') text += "'\\'";
        text += c;
    }
    return text + '\'';
}

}  // namespace swirl
