#include "swirl/run/parameter_files.hpp"

#include <fmt/format.h>

#include <cctype>
#include <filesystem>
#include <vector>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/number_table.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/particle_sizes.hpp"
#include "swirl/run/path_parameter.hpp"

namespace swirl {
namespace {

constexpr std::size_t max_table_bytes = 1 << 24;

}  // namespace

std::string text_of_table_file(const std::string& option, const std::string& file) {
    if (!file_exists(file))
        throw UsageError(fmt::format("{} is '{}', but there is no such file.", option, file));
    if (!regular_file_exists(file))
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

namespace {

/// True if a file has this name, or if it looks like one: "a/b", "a.csv". A misspelled shape is not
/// reported as a missing file.
bool names_file(const std::string& text) {
    if (file_exists(text) || text.find('/') != text.npos) return true;
    const std::size_t dot = text.rfind('.');
    return dot != text.npos && dot + 1 < text.size() &&
           std::isalpha(static_cast<unsigned char>(text[dot + 1]));
}

/// A column to take from a table: its names in a header line, and whether it may be absent.
struct TableColumn {
    std::vector<std::string_view> names;
    bool is_optional = false;
};

/// The rows of a table as texts, with colons between the columns.
std::string table_rows(const std::string& option, const std::string& file,
                       const std::vector<TableColumn>& columns, std::size_t max_rows) {
    const std::string text = text_of_table_file(option, file);
    try {
        TextLines lines(fmt::format("{} '{}'", option, file), text);
        NumberTable table(lines, NumberTable::Header::optional);
        std::vector<std::size_t> taken;
        for (const auto& [names, is_optional] : columns)
            if (!is_optional || table.find(names)) taken.push_back(table.column(names));
        std::string rows;
        std::size_t count = 0;
        for (; table.next(); ++count) {
            if (count == max_rows)
                lines.fail(fmt::format("there are more than {} rows, the most allowed", max_rows));
            for (const std::size_t k : taken)
                rows += fmt::format("{}{}", k == taken.front() ? ' ' : ':', table.number(k));
        }
        if (count == 0) lines.fail_without_rows();
        return rows;
    } catch (const FileError& error) {
        throw UsageError(error.what());
    }
}

std::string path_text(const std::string& text) {
    if (text.empty() || is_path_shape(text) || !names_file(text)) return text;
    return "points" +
           table_rows("--motion", text, {{{"t", "time"}}, {{"x"}}, {{"y"}}}, max_path_points);
}

std::string sizes_text(const std::string& text) {
    constexpr std::string_view prefix = "file:";
    if (!text.starts_with(prefix)) return text;
    const std::string file = text.substr(prefix.size());
    return "list" + table_rows("--sizes", file, {{{"radius", "r"}}, {{"mass", "m"}, true}},
                               max_listed_sizes);
}

std::string initial_text(const std::string& text) {
    if (text.starts_with("states ") || text.empty()) return text;
    return "states" + table_rows("--initial", text,
                                 {{{"x"}}, {{"y"}}, {{"vx"}}, {{"vy"}}, {{"spin"}}},
                                 max_listed_sizes);
}

}  // namespace

std::string with_file_contents(std::string_view name, const std::string& text) {
    const std::string plain = plain_name(name);
    const auto read = plain == "path"      ? path_text
                      : plain == "sizes"   ? sizes_text
                      : plain == "initial" ? initial_text
                                           : nullptr;
    if (!read) return text;
    const bool is_one_file = file_exists(text) || text.find(',') == text.npos;
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
