#include "swirl/io/table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "swirl/io/atomic_file.hpp"

namespace swirl {
namespace {

std::string text_of(const Table::Cell& cell) {
    if (const auto* number = std::get_if<double>(&cell)) return cell_text(*number);
    if (const auto* whole = std::get_if<std::int64_t>(&cell)) return std::to_string(*whole);
    const auto& text = std::get<std::string>(cell);
    if (text.find_first_of(",\"\n") == text.npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

}  // namespace

std::string cell_text(double value) {
    return std::isfinite(value) ? fmt::format("{}", value) : std::string();
}

void Table::add(std::vector<Cell> row) {
    if (row.size() != columns_.size())
        throw std::logic_error("A row of a table needs one cell for each column.");
    rows_.push_back(std::move(row));
}

std::string Table::csv() const {
    std::string text = fmt::format("{}\n", fmt::join(columns_, ","));
    for (const auto& row : rows_) {
        for (std::size_t k = 0; k < row.size(); ++k) {
            if (k > 0) text += ',';
            text += text_of(row[k]);
        }
        text += '\n';
    }
    return text;
}

void Table::write(const std::filesystem::path& file) const { write_file_atomically(file, csv()); }

}  // namespace swirl
