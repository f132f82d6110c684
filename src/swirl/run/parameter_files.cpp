#include "swirl/run/parameter_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <vector>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/particle_sizes.hpp"
#include "swirl/run/path_parameter.hpp"

namespace swirl {
namespace {

constexpr std::size_t max_table_bytes = 1 << 24;

std::string lower_case(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}

/// The fields of a line: separated by commas, or else by semicolons, tabs or spaces.
std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    if (line.find(',') == line.npos && line.find(';') == line.npos) {
        for (const std::string_view part : split(line, " \t"))
            if (!part.empty()) fields.push_back(part);
        return fields;
    }
    for (const std::string_view part : split(line, ",;")) fields.push_back(trimmed(part));
    return fields;
}

/// A column to take from a table: its names in a header line, and whether it may be absent.
struct TableColumn {
    std::vector<std::string> names;
    bool optional = false;
};

/// Reads the columns of a table as texts joined by colons, one for each row. Without a header line,
/// the first columns are used.
class NumberTable {
  public:
    NumberTable(std::string option, std::string file, std::vector<TableColumn> columns)
        : option_(std::move(option)), file_(std::move(file)), columns_(std::move(columns)) {}

    std::string joined(std::string_view text, std::size_t max_rows) {
        std::string rows;
        std::size_t number = 0, count = 0;
        for (const std::string_view raw : split(text, "\n")) {
            ++number;
            const std::string_view line = trimmed(raw.substr(0, raw.find('#')));
            if (line.empty()) continue;
            const auto fields = fields_of(line);
            if (take_.empty() && choose_columns(fields, number)) continue;
            if (++count > max_rows)
                throw UsageError(
                    fmt::format("{} '{}' has more than {} rows, which is the most allowed.",
                                option_, file_, max_rows));
            rows += ' ' + row(fields, number);
        }
        if (count == 0) throw UsageError(fmt::format("{} '{}' has no rows.", option_, file_));
        return rows;
    }

  private:
    /// True if the line is a header.
    bool choose_columns(const std::vector<std::string_view>& fields, std::size_t number) {
        const bool is_header = std::none_of(fields.begin(), fields.end(), [](const auto& field) {
            return read_number(field).has_value();
        });
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            std::size_t index = c;
            if (is_header)
                for (index = 0; index < fields.size(); ++index) {
                    const auto& names = columns_[c].names;
                    if (std::find(names.begin(), names.end(), lower_case(fields[index])) !=
                        names.end())
                        break;
                }
            if (index < fields.size())
                take_.push_back(index);
            else if (!columns_[c].optional)
                throw UsageError(fmt::format("{} '{}', line {}: there is no column '{}'.", option_,
                                             file_, number, columns_[c].names.front()));
        }
        return is_header;
    }

    std::string row(const std::vector<std::string_view>& fields, std::size_t number) const {
        std::string text;
        for (const std::size_t index : take_) {
            const auto value = index < fields.size() ? read_number(fields[index]) : std::nullopt;
            if (!value)
                throw UsageError(fmt::format(
                    "{} '{}', line {}: column {} is '{}', but it must be a finite number.", option_,
                    file_, number, index + 1, index < fields.size() ? fields[index] : ""));
            text += (text.empty() ? "" : ":") + fmt::format("{}", *value);
        }
        return text;
    }

    std::string option_, file_;
    std::vector<TableColumn> columns_;
    std::vector<std::size_t> take_;  // indices of the columns, once they are known
};

bool is_there(const std::string& file) {
    std::error_code ignored;
    return std::filesystem::exists(file, ignored);
}

std::string table_text(const std::string& option, const std::string& file) {
    if (!is_there(file))
        throw UsageError(fmt::format("{} is '{}', but there is no such file.", option, file));
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored))
        throw UsageError(fmt::format("{} is '{}', but that is not a regular file.", option, file));
    std::string text;
    try {
        text = read_whole_file(file, max_table_bytes);
    } catch (const FileError& error) {
        throw UsageError(error.what());
    }
    if (text.size() > max_table_bytes)
        throw UsageError(fmt::format("{} '{}' has more than {} MB, which is the most allowed.",
                                     option, file, max_table_bytes >> 20));
    return text;
}

/// True if a file has this name, or if it looks like one: "a/b", "a.csv". A misspelled shape is not
/// reported as a missing file.
bool names_file(const std::string& text) {
    if (is_there(text) || text.find('/') != text.npos) return true;
    const std::size_t dot = text.rfind('.');
    return dot != text.npos && dot + 1 < text.size() &&
           std::isalpha(static_cast<unsigned char>(text[dot + 1]));
}

std::string path_text(const std::string& text) {
    if (text.empty() || is_path_shape(text) || !names_file(text)) return text;
    NumberTable table("--path", text, {{{"t", "time"}}, {{"x"}}, {{"y"}}});
    return "points" + table.joined(table_text("--path", text), max_path_points);
}

std::string sizes_text(const std::string& text) {
    constexpr std::string_view prefix = "file:";
    if (!text.starts_with(prefix)) return text;
    const std::string file = text.substr(prefix.size());
    NumberTable table("--sizes", file, {{{"radius", "r"}}, {{"mass", "m"}, true}});
    return "list" + table.joined(table_text("--sizes", file), max_listed_sizes);
}

}  // namespace

std::string with_file_contents(std::string_view name, const std::string& text) {
    const std::string plain = plain_name(name);
    if (plain != "path" && plain != "sizes") return text;
    const auto read = [&](const std::string& one) {
        return plain == "path" ? path_text(one) : sizes_text(one);
    };
    const bool is_one_file = is_there(text) || text.find(',') == text.npos;
    if (is_one_file) return read(text);
    std::string list;
    for (const std::string_view part : split(text, ","))
        list += (list.empty() ? "" : ",") + read(std::string(part));
    return list;
}

ParameterTexts with_file_contents(ParameterTexts texts) {
    for (auto& [name, text] : texts) text = with_file_contents(name, text);
    return texts;
}

}  // namespace swirl
