#include "swirl/io/read_number.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace swirl {

std::optional<double> read_number(std::string_view text) {
    double value = 0.0;
#if defined(__cpp_lib_to_chars)
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, value);
    if (error != std::errc() || end != last || !std::isfinite(value)) return {};
#else
    // libc++ has from_chars() only for integers before version 20. strtod() accepts more than a
    // number: leading spaces, a plus sign, hexadecimal digits.
    if (text.empty() || text.find_first_not_of("0123456789.eE+-") != text.npos || text[0] == '+')
        return {};
    const std::string copy(text);
    char* end = nullptr;
    value = std::strtod(copy.c_str(), &end);
    if (end != copy.c_str() + copy.size() || !std::isfinite(value)) return {};
#endif
    return value;
}

std::string_view trimmed(std::string_view text) {
    const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
}

std::string in_lower_case(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}

}  // namespace swirl
