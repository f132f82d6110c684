// What a measurement says in the end: rows, each a quantity with its unit and its error, and tables
// of such. A measurement hands them over one by one,
//
//     template <class Visitor> void report(Visitor&& visit) const {
//         visit(ReportRow{"cluster", "1", "slip parameter of all discs", cluster()});
//     }
//
// and whoever wants JSON, CSV, a line on a terminal or a table in the documentation visits them; no
// such writer knows a measurement by its name. What is reported does not depend on what has been
// found: the rows and columns of a measurement that has seen nothing are the same, their values not
// known (NaN).
//
// Units are those of docs/physics.md: r the radius of a disc, m its mass, v the speed of the
// container, Ω = 2π/T; ° for angles, 1 where there is none.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <utility>
#include <vector>

#include "swirl/math/unit_circle.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

/// A number that belongs to a row and has no error of its own.
struct ReportDetail {
    const char* name;
    const char* unit;
    double value;
};

struct ReportRow {
    const char* name;
    const char* unit;
    const char* description;
    Estimate estimate;
    std::vector<ReportDetail> details{};
    bool has_error = true;  // false: a number that is not an average
};

struct ReportColumn {
    const char* name;
    const char* unit;
};

struct ReportTable {
    const char* name;  // empty: the only table of its measurement
    const char* description;
    std::vector<ReportColumn> columns;
    std::vector<double> values{};  // row after row

    std::size_t rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
    double at(std::size_t row, std::size_t column) const {
        return values[row * columns.size() + column];
    }
    /// One value for every column.
    void add(std::initializer_list<double> row) { values.insert(values.end(), row); }
};

/// All that a measurement reports, collected.
struct Report {
    std::vector<ReportRow> rows;
    std::vector<ReportTable> tables;

    void operator()(ReportRow row) { rows.push_back(std::move(row)); }
    void operator()(ReportTable table) { tables.push_back(std::move(table)); }
};

/// An angle as it is reported.
inline constexpr double degrees_per_radian = 180.0 / pi;

}  // namespace swirl
