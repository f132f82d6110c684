// A word as a shell reads it back, whatever is in it.
#pragma once

#include <string>

namespace swirl {

/// In single quotes; a quote within stands outside of them.
inline std::string in_quotes(const std::string& word) {
    std::string text;
    text += '\'';
    for (const char c : word) {
        if (c == '\'') text += "'\\'";
        text += c;
    }
    text += '\'';
    return text;
}

}  // namespace swirl
