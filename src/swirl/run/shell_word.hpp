// Quotes a word of a command so that a POSIX shell reads it back unchanged.
#pragma once

#include <string>
#include <string_view>

namespace swirl {

/// Returns the word itself if it needs no quotes, otherwise in single quotes. A single quote in the
/// word becomes '\''.
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
