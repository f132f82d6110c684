// The results of a measurement: rows, each a quantity with its unit and its error, and tables of
// such quantities. A measurement hands them over one by one,
//
//     template <class Visitor> void report(Visitor&& visit) const {
//         visit(ReportRow{"cluster", "1", "slip parameter of all discs", cluster()});
//     }
//
// This is the only place where names, units and descriptions are given. JSON, CSV, the terminal and
// the documentation visit the rows; none of them knows a measurement by its name. Rows and columns
// do not depend on the data: a measurement without samples reports the same ones, with NaN.
//
// Units are those of docs/physics.md: r the radius of a disc, m its mass, v the speed of the
// container, Ω = 2π/T; ° for angles, 1 for none.
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
    const char* name;  // empty for the only table of a measurement
    const char* description;
    std::vector<ReportColumn> columns;
    std::vector<double> values{};  // row by row

    std::size_t rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
    double at(std::size_t row, std::size_t column) const {
        return values[row * columns.size() + column];
    }
    /// One value for every column.
    void add(std::initializer_list<double> row) { values.insert(values.end(), row); }
};

/// All rows and tables of one measurement.
struct Report {
    std::vector<ReportRow> rows;
    std::vector<ReportTable> tables;

    void operator()(ReportRow row) { rows.push_back(std::move(row)); }
    void operator()(ReportTable table) { tables.push_back(std::move(table)); }
};

/// Angles are radians inside and degrees in reports.
inline constexpr double degrees_per_radian = 180.0 / pi;

}  // namespace swirl
