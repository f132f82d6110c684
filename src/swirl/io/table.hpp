// A table as people open it in pandas, R or a spreadsheet: CSV with one line of names, numbers that
// read back as the same double, nothing for what is not known.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace swirl {

class Table {
  public:
    using Cell = std::variant<double, std::int64_t, std::string>;

    explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

    /// One cell for each column.
    void add(std::vector<Cell> row);

    std::string csv() const;
    /// Written aside and renamed; throws FileError.
    void write(const std::filesystem::path& file) const;

  private:
    std::vector<std::string> columns_;
    std::vector<std::vector<Cell>> rows_;
};

}  // namespace swirl
