// Detects bytes that are not UTF-8 text (RFC 3629), the only text that JSON, TOML and HDF5 allow.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace swirl {

/// Position of the first byte that is not UTF-8; empty if there is none.
inline std::optional<std::size_t> first_byte_not_utf8(std::string_view text) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    for (std::size_t i = 0; i < text.size();) {
        const unsigned char c = byte(i);
        if (c < 0x80) {
            ++i;
            continue;
        }
        if (c < 0xc2 || c > 0xf4) return i;
        const std::size_t more = c >= 0xf0 ? 3 : c >= 0xe0 ? 2 : 1;
        for (std::size_t k = 1; k <= more; ++k)
            if (i + k >= text.size() || (byte(i + k) & 0xc0) != 0x80) return i;
        // Overlong forms, surrogates, and code points beyond Unicode.
        const unsigned char next = byte(i + 1);
        if ((c == 0xe0 && next < 0xa0) || (c == 0xed && next > 0x9f) ||
            (c == 0xf0 && next < 0x90) || (c == 0xf4 && next > 0x8f))
            return i;
        i += more + 1;
    }
    return {};
}

}  // namespace swirl
