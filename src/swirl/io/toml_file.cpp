#include "swirl/io/toml_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <optional>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/utf8.hpp"

namespace swirl {
namespace {

/// Position of the first byte that is a control character or not UTF-8. The parser must not get
/// such text.
std::optional<std::size_t> first_invalid_byte(std::string_view text) {
    const auto is_control = [](char c) {
        return (c >= 0 && c < 0x20 && c != '\n' && c != '\t' && c != '\r') || c == 0x7f;
    };
    const auto control = std::find_if(text.begin(), text.end(), is_control);
    const auto at = static_cast<std::size_t>(control - text.begin());
    if (const auto bad = first_byte_not_utf8(text.substr(0, at))) return bad;
    return control == text.end() ? std::nullopt : std::optional(at);
}

/// Position of the dot that gives a key more than 16 parts (a.b.c), which the parser would follow
/// recursively. It limits the nesting of values itself. Dots in strings and comments do not count.
std::optional<std::size_t> first_overlong_key(std::string_view text) {
    std::size_t dots = 0;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const char c = text[k];
        if (c == '#') {
            k = std::min(text.find('\n', k), text.size()) - 1;
        } else if (c == '"' || c == '\'') {
            const bool is_long = text.substr(k, 3) == std::string(3, c);
            const std::string_view mark = text.substr(k, is_long ? 3 : 1);
            for (k += mark.size(); k < text.size() && !text.substr(k).starts_with(mark); ++k)
                if (c == '"' && text[k] == '\\')
                    ++k;
                else if (text[k] == '\n' && !is_long)
                    break;
            // A long string may end with up to two more quotation marks.
            const std::size_t last = is_long ? text.find_first_not_of(c, k) : k + 1;
            k = std::min({last, text.size(), k + 5}) - 1;
        } else if (c == '.') {
            if (++dots > 15) return k;
        } else if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) {
            dots = 0;
        }
    }
    return {};
}

int line_of(std::string_view text, std::size_t at) {
    return 1 + static_cast<int>(std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n'));
}

/// Line `number` of the text, or "" if it is too long to be quoted in a message.
std::string_view quotable_line(std::string_view text, std::size_t number) {
    for (; number > 1; --number) {
        const std::size_t end = text.find('\n');
        if (end == text.npos) return "";
        text.remove_prefix(end + 1);
    }
    constexpr std::size_t max_quoted = 60;
    text = text.substr(0, text.find_first_of("\r\n"));
    return text.size() > max_quoted ? "" : text;
}

class Reader {
  public:
    explicit Reader(std::string_view name) : name_(name) {}

    [[noreturn]] void fail(int line, std::string_view problem) const {
        throw FileError(fmt::format("'{}', line {}: {}.", name_, line, problem));
    }

    /// The parser's own messages are for programmers, so this replaces them.
    [[noreturn]] void fail_with_syntax(std::string_view text,
                                       const toml::source_position& at) const {
        const std::string_view line = quotable_line(text, at.line);
        throw FileError(fmt::format(
            "'{}', line {}, column {}: {} is not valid TOML.\nhint: write NAME = VALUE, each name "
            "once, with texts in quotation marks and lists in square brackets.",
            name_, at.line, at.column, line.empty() ? "this" : fmt::format("'{}'", line)));
    }

    std::string value(const toml::node& node, std::string_view key) const {
        if (const auto* text = node.as_string()) return text->get();
        if (const auto* number = node.as_integer()) return std::to_string(number->get());
        if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
        if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
        fail(int(node.source().begin.line),
             fmt::format("{} must be a number, a text or a list of them", key));
    }

    ConfigEntry entry(const toml::node& node, std::string_view key) const {
        ConfigEntry entry;
        entry.line = int(node.source().begin.line);
        if (node.is_table())
            fail(entry.line,
                 fmt::format("[{}] is a table.\nhint: write the options without tables", key));
        const toml::array* list = node.as_array();
        entry.is_list = list != nullptr;
        if (list == nullptr) {
            entry.values.push_back(value(node, key));
        } else {
            for (const toml::node& element : *list) entry.values.push_back(value(element, key));
        }
        return entry;
    }

  private:
    std::string_view name_;
};

}  // namespace

Config parse_config(std::string text, std::string_view name) {
    const Reader reader(name);
    if (text.size() > largest_config)
        throw FileError(fmt::format("'{}' is longer than {} bytes, the limit for a configuration.",
                                    name, largest_config));
    if (const auto bad = first_invalid_byte(text))
        reader.fail(line_of(text, *bad), fmt::format("byte 0x{:02x} is not UTF-8 text",
                                                     static_cast<unsigned char>(text[*bad])));
    if (const auto dot = first_overlong_key(text))
        reader.fail(line_of(text, *dot), "a key has more than 16 parts");
    Config config;
    try {
        const toml::table table = toml::parse(text, name);
        for (const auto& [key, node] : table) {
            std::string option(key.str());
            std::replace(option.begin(), option.end(), '-', '_');
            if (!config.entries.emplace(option, reader.entry(node, key.str())).second)
                reader.fail(int(node.source().begin.line),
                            fmt::format("{} is given twice", option));
        }
    } catch (const toml::parse_error& error) {
        reader.fail_with_syntax(text, error.source().begin);
    }
    config.text = std::move(text);
    return config;
}

}  // namespace swirl
