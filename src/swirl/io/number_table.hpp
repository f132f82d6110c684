// Reads tables of numbers that other programs wrote: CSV from spreadsheets, trackers and editors.
// Every table that the program reads is read here, so all have the same rules.
//
// The first line names the columns; only a table of one column needs no header. A file has one
// separator, that of its first line: semicolons, else tabs, else commas, else spaces. A line
// "sep=;" before it, as spreadsheets write it, names another one. Semicolons and tabs allow decimal
// commas; a file has one decimal sign, too. Each row has as many fields as the first line, and no
// column appears twice. Text in quotation marks may contain separators. `#` begins a comment. A
// byte order mark is skipped. The last line has a line break, or a number in it may be truncated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace swirl {

/// Iterates over the lines of a text, which the caller owns. Throws FileErrors that begin with
/// `source` ("'a.csv'") and the line number.
class TextLines {
  public:
    TextLines(std::string source, std::string_view text);

    bool next(std::string_view& line);
    /// "'a.csv', line 3"
    std::string position() const;
    std::string_view expect(std::string_view what);

    [[noreturn]] void fail(std::string_view problem) const;
    /// The text ends where `what` was expected.
    [[noreturn]] void fail_at_end(std::string_view what) const;
    [[noreturn]] void fail_without_rows() const;

  private:
    std::string source_;
    std::string_view rest_;
    std::size_t number_ = 0;
};

class NumberTable {
  public:
    /// `optional`: the first line of a table of one column may be a number.
    enum class Header { required, optional };

    /// Reads the first line, which is a header.
    explicit NumberTable(TextLines& lines, Header header = Header::required);
    /// A table that is separated by spaces, and whose header was read before.
    NumberTable(TextLines& lines, std::string_view header);

    /// Index of the column with one of these names (in lower case); nothing if there is none. In a
    /// table without a header, its only column has the first name that the caller looks for.
    std::optional<std::size_t> find(const std::vector<std::string_view>& names);
    /// The same for a column that must exist.
    std::size_t column(const std::vector<std::string_view>& names);

    /// Reads the next row; false at the end of the text.
    bool next();
    /// The names in the header.
    const std::vector<std::string>& names() const { return names_; }
    /// The text of a cell, which may be a number. If it is one, it has a decimal point.
    std::string text(std::size_t column);
    bool is_empty(std::size_t column) const { return cells_[column].empty(); }
    /// True for an empty cell, and for nan, na and n/a.
    bool is_missing(std::size_t column) const;
    bool is_number(std::size_t column) const { return value_of(cells_[column]).has_value(); }
    double number(std::size_t column);
    std::int64_t integer(std::size_t column);

  private:
    bool read_line();
    bool takes_separator(std::string_view line);
    void choose_separator(std::string_view line);
    void take_header();
    std::optional<double> value_of(std::string_view cell) const;
    void require_decimal_sign(std::size_t column);
    std::string hint_for_commas() const;
    [[noreturn]] void fail(std::size_t column, std::string_view constraint) const;

    TextLines& lines_;
    char separator_ = '\0';  // ' ' stands for any number of spaces and tabs
    char decimal_sign_ = '\0';
    std::vector<std::string> names_;       // those of the header; empty if the table has none
    std::vector<std::string_view> cells_;  // cells of the current row
    std::size_t width_ = 0;
    bool is_first_row_read_ = false;
};

}  // namespace swirl
