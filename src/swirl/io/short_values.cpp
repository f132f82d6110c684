#include "swirl/io/short_values.hpp"

#include <algorithm>

namespace swirl {
namespace {

bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }

/// The byte at which character `n` of UTF-8 text begins.
std::size_t byte_of(std::string_view text, std::size_t n) {
    std::size_t at = 0;
    for (std::size_t seen = 0; at < text.size(); ++at)
        if (begins_character(text[at]) && seen++ == n) break;
    return at;
}

std::string short_value(std::string_view value) {
    const bool may_be_path = value.find('/') != value.npos;
    return shortened(value, may_be_path ? max_quoted_path : max_quoted);
}

/// The end of the quotation that begins at `begin`: a quotation mark that no letter follows. Its
/// end is unknown if there is none, or the value contains such a mark; words are then shortened.
std::size_t end_of_quotation(std::string_view message, std::size_t begin) {
    for (std::size_t end = message.find('\'', begin + 1); end != message.npos;
         end = message.find('\'', end + 1))
        if (end + 1 == message.size() ||
            std::string_view(" .,;:)]\n`").find(message[end + 1]) != std::string_view::npos)
            return end;
    return message.npos;
}

}  // namespace

std::string shortened(std::string_view text, std::size_t max_characters) {
    constexpr std::string_view dots = "...";
    const auto characters = static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return begins_character(c); }));
    if (characters <= max_characters) return std::string(text);
    const std::size_t last = (max_characters - dots.size()) / 4;
    const std::size_t first = max_characters - dots.size() - last;
    return std::string(text.substr(0, byte_of(text, first))) + std::string(dots) +
           std::string(text.substr(byte_of(text, characters - last)));
}

std::string with_short_values(std::string_view message) {
    std::string result;
    for (std::size_t at = 0; at < message.size();) {
        const bool begins_word = at == 0 || message[at - 1] == ' ' || message[at - 1] == '\n' ||
                                 message[at - 1] == '(' || message[at - 1] == '`';
        const std::size_t quotation =
            begins_word && message[at] == '\'' ? end_of_quotation(message, at) : message.npos;
        if (quotation != message.npos) {
            result += '\'' + short_value(message.substr(at + 1, quotation - at - 1)) + '\'';
            at = quotation + 1;
            continue;
        }
        const std::size_t end = std::min(message.find_first_of(" \n", at), message.size());
        result += short_value(message.substr(at, end - at));
        if (end < message.size()) result += message[end];
        at = end + 1;
    }
    return result;
}

}  // namespace swirl
