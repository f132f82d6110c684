#include "swirl/io/number_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "swirl/io/file_error.hpp"
#include "swirl/io/read_number.hpp"

namespace swirl {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string in_lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// Position of the first `c` that is not in quotation marks.
std::size_t find_unquoted(std::string_view line, char c) {
    bool is_quoted = false;
    for (std::size_t k = 0; k < line.size(); ++k) {
        if (line[k] == '"') is_quoted = !is_quoted;
        if (line[k] == c && !is_quoted) return k;
    }
    return line.npos;
}

/// The fields of a line, without surrounding spaces and quotation marks.
void split_line(const TextLines& lines, std::string_view line, char separator,
                std::vector<std::string_view>& cells) {
    const auto is_end = [&](char c) { return separator == ' ' ? is_blank(c) : c == separator; };
    const auto skip_blanks = [&](std::size_t at) {
        while (at < line.size() && is_blank(line[at]) &&
               (separator == ' ' || line[at] != separator))
            ++at;
        return at;
    };
    cells.clear();
    if (separator == ' ') line = trimmed(line);
    for (std::size_t at = 0;; ++at) {
        at = skip_blanks(at);
        std::size_t end = at;
        if (at < line.size() && line[at] == '"') {
            do end = line.find('"', end + 1);
            while (end != line.npos && line.substr(end).starts_with("\"\"") && ++end);
            if (end == line.npos) lines.fail("a quotation mark is not closed");
            cells.push_back(line.substr(at + 1, end - at - 1));
            ++end;
            if (separator != ' ') end = skip_blanks(end);
            if (end < line.size() && !is_end(line[end]))
                lines.fail("a field continues after its quotation mark");
        } else {
            while (end < line.size() && !is_end(line[end])) ++end;
            cells.push_back(trimmed(line.substr(at, end - at)));
        }
        at = end;
        if (at == line.size()) return;
    }
}

}  // namespace

TextLines::TextLines(std::string source, std::string_view text, bool needs_last_break)
    : source_(std::move(source)), rest_(text), needs_last_break_(needs_last_break) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
    if (rest_.starts_with("\xff\xfe") || rest_.starts_with("\xfe\xff"))
        throw FileError(fmt::format("{} is text in UTF-16.\nhint: save it as UTF-8.", source_));
}

bool TextLines::next(std::string_view& line) {
    if (rest_.empty()) return false;
    ++number_;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    if (needs_last_break_ && end == rest_.size())
        fail(
            "the last line has no line break, so the file may be truncated here.\n"
            "hint: if the file is complete, append a line break");
    line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    return true;
}

std::string_view TextLines::expect(std::string_view what) {
    std::string_view line;
    if (!next(line)) fail_at_end(what);
    return line;
}

std::string TextLines::position() const { return fmt::format("{}, line {}", source_, number_); }

void TextLines::fail(std::string_view problem) const {
    throw FileError(fmt::format("{}: {}.", position(), problem));
}

void TextLines::fail_at_end(std::string_view what) const {
    throw FileError(
        fmt::format("{} ends after line {}, but {} was expected.", source_, number_, what));
}

void TextLines::fail_without_rows() const {
    throw FileError(fmt::format("{} has no rows.", source_));
}

NumberTable::NumberTable(TextLines& lines, std::size_t columns_without_header) : lines_(lines) {
    if (!read_line()) lines_.fail_without_rows();
    is_first_row_read_ = columns_without_header > 0 &&
                         std::any_of(cells_.begin(), cells_.end(),
                                     [&](auto cell) { return value_of(cell).has_value(); });
    if (!is_first_row_read_)
        take_header();
    else if (width_ > columns_without_header)
        lines_.fail(fmt::format("{} columns, but no header with their names", width_));
}

NumberTable::NumberTable(TextLines& lines, std::string_view header)
    : lines_(lines), separator_(' ') {
    split_line(lines_, header, separator_, cells_);
    width_ = cells_.size();
    take_header();
}

void NumberTable::take_header() {
    names_.assign(cells_.begin(), cells_.end());
    for (auto name = names_.begin(); name != names_.end(); ++name)
        if (!name->empty() && std::find(names_.begin(), name, *name) != name)
            lines_.fail(fmt::format("there are two columns '{}'", *name));
}

std::optional<std::size_t> NumberTable::find(const std::vector<std::string_view>& names,
                                             std::size_t position) const {
    if (names_.empty()) return position < width_ ? std::optional(position) : std::nullopt;
    std::optional<std::size_t> found;
    for (std::size_t k = 0; k < names_.size(); ++k) {
        if (std::find(names.begin(), names.end(), in_lower_case(names_[k])) == names.end())
            continue;
        if (found)
            lines_.fail(fmt::format("the columns '{}' and '{}' have the same meaning",
                                    names_[*found], names_[k]));
        found = k;
    }
    return found;
}

std::size_t NumberTable::column(const std::vector<std::string_view>& names,
                                std::size_t position) const {
    const auto found = find(names, position);
    if (!found) lines_.fail(fmt::format("there is no column '{}'", names.front()));
    return *found;
}

bool NumberTable::next() {
    if (is_first_row_read_) {
        is_first_row_read_ = false;
        return true;
    }
    return read_line();
}

/// Reads the fields of the next line that has any.
bool NumberTable::read_line() {
    std::string_view line;
    do {
        if (!lines_.next(line)) return false;
        line = line.substr(0, find_unquoted(line, '#'));
    } while (trimmed(line).empty());
    const bool is_first = separator_ == '\0';
    if (is_first) {
        separator_ = ' ';
        for (const char candidate : {',', '\t', ';'})
            if (find_unquoted(trimmed(line), candidate) != line.npos) separator_ = candidate;
    }
    split_line(lines_, line, separator_, cells_);
    if (is_first) width_ = cells_.size();
    if (cells_.size() != width_)
        lines_.fail(fmt::format("{} fields, but the first line has {}", cells_.size(), width_));
    return true;
}

double NumberTable::number(std::size_t column) {
    const std::string_view cell = cells_[column];
    const auto value = value_of(cell);
    if (!value) fail(column, "a finite number");
    const std::size_t sign = cell.find_first_of(".,");
    if (sign == cell.npos) return *value;
    if (decimal_sign_ != '\0' && decimal_sign_ != cell[sign])
        fail(column, fmt::format("written with '{}', like the numbers above", decimal_sign_));
    decimal_sign_ = cell[sign];
    return *value;
}

std::int64_t NumberTable::integer(std::size_t column) {
    const double value = number(column);  // pandas writes frame 3 as 3.0 if a column has gaps
    if (value != std::floor(value) || std::abs(value) > 0x1p53) fail(column, "a whole number");
    return static_cast<std::int64_t>(value);
}

/// The finite number in a cell. A decimal comma is between two digits.
std::optional<double> NumberTable::value_of(std::string_view cell) const {
    const std::size_t comma = cell.find(',');
    if (comma == cell.npos) return read_number(cell);
    const auto is_digit = [&](std::size_t k) {
        return k < cell.size() && std::isdigit(static_cast<unsigned char>(cell[k]));
    };
    const bool allows_commas = separator_ == ';' || separator_ == '\t';
    if (!allows_commas || !is_digit(comma - 1) || !is_digit(comma + 1) ||
        cell.find('.') != cell.npos)
        return {};
    std::string with_point(cell);
    with_point[comma] = '.';
    return read_number(with_point);
}

void NumberTable::fail(std::size_t column, std::string_view constraint) const {
    const std::string_view cell = cells_[column];
    lines_.fail(fmt::format(
        "column {} is '{}', but it must be {}{}",
        names_.empty() ? std::to_string(column + 1) : fmt::format("'{}'", names_[column]), cell,
        constraint,
        cell.find(',') == cell.npos || decimal_sign_ == '.'
            ? ""
            : ".\nhint: with decimal commas, separate the columns by semicolons"));
}

}  // namespace swirl
