// The results of a measurement: rows, each a quantity with its unit and its error, and tables of
// such quantities. A measurement hands them over one by one,
//
//     template <class Visitor> void report(Visitor&& visit) const {
//         visit(ReportRow{"granular", "m v²", "granular temperature", granular()});
//     }
//
// This is the only place where names, units and descriptions are given. JSON, CSV, the terminal and
// the documentation visit the rows; none of them knows a measurement by its name. Rows and columns
// do not depend on the data: a measurement without samples reports the same ones, with NaN.
//
// Units are those of docs/explanation/physics.md: r the radius of a disc, m its mass, v the speed
// of the container, Ω = 2π/T; ° for angles, 1 for none.
#pragma once

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <tuple>
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

/// The row of a measurement that checks a balance.
inline ReportRow unaccounted_row(const char* description, double share) {
    return {.name = "unaccounted_share",
            .unit = "1",
            .description = description,
            .estimate = {.mean = share},
            .has_error = false};
}

struct ReportColumn {
    std::string name;
    const char* unit;
};

/// Declares a column, or with `has_error` two: the second, NAME_error, for the error of an average.
struct ColumnSpec {
    const char* name;
    const char* unit;
    bool has_error = false;
};
inline constexpr bool with_error_column = true;

struct ReportTable {
    const char* name;  // empty for the only table of a measurement
    const char* description;
    std::vector<ReportColumn> columns{};
    std::vector<double> values{};  // row by row

    ReportTable(const char* table_name, const char* table_description,
                std::initializer_list<ColumnSpec> specs)
        : name(table_name), description(table_description) {
        for (const ColumnSpec& spec : specs) {
            columns.push_back({spec.name, spec.unit});
            if (spec.has_error) columns.push_back({std::string(spec.name) + "_error", spec.unit});
        }
    }
    std::size_t rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
    double at(std::size_t row, std::size_t column) const {
        return values[row * columns.size() + column];
    }
    /// Adds a row: a number for each column, an Estimate for each column with an error.
    template <class... Values>
    void add(const Values&... row) {
        (push(row), ...);
    }

  private:
    void push(double value) { values.push_back(value); }
    void push(const Estimate& e) { values.insert(values.end(), {e.mean, e.error}); }
};

inline double finite_or_missing(double value) {
    return std::isfinite(value) ? value : not_available;
}

/// All rows and tables of one measurement. A number that is not finite, such as the mean free time
/// of a disc that never collided, is a missing one: NaN here, and an empty cell or null in files.
struct Report {
    std::vector<ReportRow> rows;
    std::vector<ReportTable> tables;

    void operator()(ReportRow row) {
        row.estimate.mean = finite_or_missing(row.estimate.mean);
        row.estimate.error = finite_or_missing(row.estimate.error);
        for (ReportDetail& detail : row.details) detail.value = finite_or_missing(detail.value);
        rows.push_back(std::move(row));
    }
    void operator()(ReportTable table) {
        for (double& value : table.values) value = finite_or_missing(value);
        tables.push_back(std::move(table));
    }
};

/// An average of a measurement, and its row in the report.
template <class Average>
struct AverageRow {
    AverageRow(const char* row_name, const char* row_unit, const char* text, Average& its_average)
        : name(row_name), unit(row_unit), description(text), average(its_average) {}
    const char *name, *unit, *description;
    Average& average;
};

/// Base of a measurement M whose averages are rows of its report. M lists them once, in the order
/// of the report and of its checkpoint:
///
///     static auto rows(auto& s) {
///         return std::tuple{AverageRow{"cluster", "1", "slip of all discs", s.cluster_}};
///     }
template <class M, template <class> class Averages = BlockAverages>
class ReportedAverages : public Averages<M> {
  public:
    static auto averages(auto& s) {
        return std::apply([](const auto&... row) { return std::tie(row.average...); }, M::rows(s));
    }
    template <class Visitor>
    void report(Visitor&& visit) const {
        const auto visit_row = [&](const auto& row) {
            visit(ReportRow{row.name, row.unit, row.description, row.average.estimate()});
        };
        std::apply([&](const auto&... row) { (visit_row(row), ...); },
                   M::rows(static_cast<const M&>(*this)));
    }
};

/// Angles are radians inside and degrees in reports.
inline constexpr double degrees_per_radian = 180.0 / pi;

}  // namespace swirl
