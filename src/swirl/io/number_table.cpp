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

/// A finite number with one comma, which is between two digits.
std::optional<double> number_with_comma(std::string_view cell) {
    const std::size_t comma = cell.find(',');
    const auto is_digit = [&](std::size_t k) {
        return k < cell.size() && std::isdigit(static_cast<unsigned char>(cell[k]));
    };
    if (comma == cell.npos || !is_digit(comma - 1) || !is_digit(comma + 1) ||
        cell.find('.') != cell.npos)
        return {};
    std::string with_point(cell);
    with_point[comma] = '.';
    return read_number(with_point);
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

TextLines::TextLines(std::string source, std::string_view text)
    : source_(std::move(source)), rest_(text) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
    const bool has_utf16_mark = rest_.starts_with("\xff\xfe") || rest_.starts_with("\xfe\xff");
    // Without the mark, each character of a table has a zero byte before or after it.
    if (has_utf16_mark || rest_.substr(0, 2).find('\0') != rest_.npos)
        throw FileError(fmt::format("{} is text in UTF-16.\nhint: save it as UTF-8.", source_));
}

bool TextLines::next(std::string_view& line) {
    if (rest_.empty()) return false;
    ++number_;
    const std::size_t end = rest_.find('\n');
    if (end == rest_.npos)
        fail(
            "the last line has no line break, so the file may be truncated here.\n"
            "hint: if the file is complete, append a line break");
    line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
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

NumberTable::NumberTable(TextLines& lines, Header header) : lines_(lines) {
    if (!read_line()) lines_.fail_without_rows();
    const bool are_numbers = std::all_of(cells_.begin(), cells_.end(), [&](auto cell) {
        return cell.empty() || value_of(cell).has_value();
    });
    is_first_row_read_ = are_numbers && header == Header::optional && width_ == 1;
    if (is_first_row_read_) return;
    if (are_numbers)
        lines_.fail(fmt::format(
            "{} column{} without a header.\nhint: name the columns in the first line{}", width_,
            width_ == 1 ? "" : "s",
            separator_ == ',' ? ". If these are decimal commas, begin the file with the line sep=;"
                              : ""));
    take_header();
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

std::optional<std::size_t> NumberTable::find(const std::vector<std::string_view>& names) {
    if (names_.empty()) names_.emplace_back(names.front());
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

std::size_t NumberTable::column(const std::vector<std::string_view>& names) {
    const auto found = find(names);
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

/// True for "sep=;", which names the separator of the file.
bool NumberTable::takes_separator(std::string_view line) {
    line = trimmed(line);
    if (line.starts_with('"') && line.ends_with('"') && line.size() > 1)
        line = line.substr(1, line.size() - 2);
    constexpr std::string_view key = "sep=";
    if (in_lower_case(line.substr(0, key.size())) != key) return false;
    const std::string_view value = line.substr(key.size());
    // The tab of "sep=<tab>" was trimmed.
    separator_ = value.empty() ? '\t' : value.front();
    if (value.size() > 1 || std::string_view(",;\t").find(separator_) == std::string_view::npos)
        lines_.fail(fmt::format("the separator is '{}', but it must be ; or , or a tab", value));
    return true;
}

void NumberTable::choose_separator(std::string_view line) {
    separator_ = ' ';
    for (const char candidate : {',', '\t', ';'})
        if (find_unquoted(trimmed(line), candidate) != line.npos) separator_ = candidate;
}

/// Reads the fields of the next line that has any.
bool NumberTable::read_line() {
    std::string_view line;
    do {
        if (!lines_.next(line)) return false;
        line = line.substr(0, find_unquoted(line, '#'));
    } while (trimmed(line).empty() || (separator_ == '\0' && takes_separator(line)));
    if (separator_ == '\0') choose_separator(line);
    split_line(lines_, line, separator_, cells_);
    if (width_ == 0) width_ = cells_.size();
    if (cells_.size() != width_)
        lines_.fail(
            fmt::format("{} fields, but the first line has {}{}", cells_.size(), width_,
                        separator_ == ',' && cells_.size() > width_ ? hint_for_commas() : ""));
    return true;
}

/// Without semicolons, the reader cannot know that a comma is a decimal sign.
std::string NumberTable::hint_for_commas() const {
    if (separator_ == ';' || separator_ == '\t') return {};
    return width_ == 1 ? ".\nhint: with decimal commas, begin the file with the line sep=;"
                       : ".\nhint: with decimal commas, separate the columns by semicolons";
}

void NumberTable::require_decimal_sign(std::size_t column) {
    const std::string_view cell = cells_[column];
    const std::size_t sign = cell.find_first_of(".,");
    if (sign == cell.npos) return;
    if (decimal_sign_ != '\0' && decimal_sign_ != cell[sign])
        fail(column, fmt::format("written with '{}', like the numbers above", decimal_sign_));
    decimal_sign_ = cell[sign];
}

double NumberTable::number(std::size_t column) {
    const auto value = value_of(cells_[column]);
    if (!value) fail(column, "a finite number");
    require_decimal_sign(column);
    return *value;
}

bool NumberTable::is_missing(std::size_t column) const {
    const std::string cell = in_lower_case(cells_[column]);
    return cell.empty() || cell == "nan" || cell == "na" || cell == "n/a";
}

std::string NumberTable::text(std::size_t column) {
    std::string cell(cells_[column]);
    const bool has_comma = number_with_comma(cell).has_value();
    if (has_comma && !value_of(cell)) fail(column, "a number with a decimal point");
    if (!value_of(cell)) return cell;
    require_decimal_sign(column);
    std::replace(cell.begin(), cell.end(), ',', '.');
    return cell;
}

std::int64_t NumberTable::integer(std::size_t column) {
    const double value = number(column);  // pandas writes frame 3 as 3.0 if a column has gaps
    if (value != std::floor(value) || std::abs(value) > 0x1p53) fail(column, "a whole number");
    return static_cast<std::int64_t>(value);
}

/// The finite number in a cell, if semicolons or tabs separate the columns.
std::optional<double> NumberTable::value_of(std::string_view cell) const {
    const bool allows_commas = separator_ == ';' || separator_ == '\t';
    return cell.find(',') == cell.npos ? read_number(cell)
           : allows_commas             ? number_with_comma(cell)
                                       : std::nullopt;
}

void NumberTable::fail(std::size_t column, std::string_view constraint) const {
    const std::string_view cell = cells_[column];
    const bool has_comma = cell.find(',') != cell.npos && decimal_sign_ != '.';
    lines_.fail(fmt::format("column '{}' is '{}', but it must be {}{}", names_[column], cell,
                            constraint, has_comma ? hint_for_commas() : ""));
}

}  // namespace swirl
