// A table for pandas, R or a spreadsheet: CSV with one header line. Numbers read back as the same
// double; unknown values are empty cells.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace swirl {

/// The text of a number in a CSV file: it reads back as the same double. Empty if the number is
/// missing: NaN or infinite.
std::string cell_text(double value);

class Table {
  public:
    using Cell = std::variant<double, std::int64_t, std::string>;

    explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

    /// `row` has one cell for each column.
    void add(std::vector<Cell> row);

    std::string csv() const;
    /// Writes atomically. Throws FileError.
    void write(const std::filesystem::path& file) const;

  private:
    std::vector<std::string> columns_;
    std::vector<std::vector<Cell>> rows_;
};

}  // namespace swirl
