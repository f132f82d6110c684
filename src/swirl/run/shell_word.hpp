// A word of a command as a POSIX shell reads it back, whatever is in it.
#pragma once

#include <string>
#include <string_view>

namespace swirl {

/// Itself where a shell changes nothing in it, else in single quotes; a quote within stands outside
/// of them.
inline std::string shell_word(std::string_view word) {
    constexpr std::string_view unchanged =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
    if (!word.empty() && word.find_first_not_of(unchanged) == word.npos) return std::string(word);
    std::string text = "'";
    for (const char c : word) {
        if (c == '\'') text += "'\\'";
        text += c;
    }
    return text + '\'';
}

}  // namespace swirl
