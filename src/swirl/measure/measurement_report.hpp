// The results of a measurement: rows, each a quantity with its error, and tables of such
// quantities. A measurement hands them over one by one,
//
//     template <class Visitor> void report(Visitor&& visit) const {
//         visit(ReportRow{quantity("temperature.granular"), granular()});
//     }
//
// The registry (quantities.hpp) has their names, units and words. JSON, CSV, the terminal and the
// documentation visit the rows; none of them knows a measurement by its name. Rows and columns do
// not depend on the data: a measurement without samples reports the same ones, with NaN.
//
// A measurement reports in the units of its snapshots. in_printed_units() divides by the units of
// docs/explanation/physics.md: r the radius of a disc, m its mass, v the speed of the container.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "swirl/math/unit_circle.hpp"
#include "swirl/measure/quantity.hpp"
#include "swirl/statistics/block_average.hpp"
#include "swirl/statistics/few_blocks.hpp"

namespace swirl {

/// A number that belongs to a row and has no error of its own.
struct ReportDetail {
    const char* name;
    const char* unit;
    double value;
};

struct ReportRow {
    ReportRow(const Quantity& row, const Estimate& value, std::vector<ReportDetail> more = {})
        : quantity(&row),
          name(row.key()),
          unit(row.unit.text),
          description(row.words),
          estimate(value),
          details(std::move(more)) {}

    const Quantity* quantity;
    const char *name, *unit, *description;  // those of the quantity
    Estimate estimate;
    std::vector<ReportDetail> details;
    bool has_error = true;  // false: a number that is not an average
};

/// A number that is not an average.
inline ReportRow number_row(const Quantity& quantity, double value) {
    ReportRow row(quantity, {.mean = value});
    row.has_error = false;
    return row;
}

struct ReportColumn {
    std::string name;
    const Quantity* quantity;
    bool is_error = false;

    const char* unit() const { return quantity->unit.text; }
};

/// Declares a column, or with `has_error` two: the second, NAME_error, for the error of an average.
struct ColumnSpec {
    ColumnSpec(const Quantity& column, bool with_error = false)  // NOLINT: implicit on purpose
        : quantity(&column), has_error(with_error) {}
    const Quantity* quantity;
    bool has_error;
};
inline constexpr bool with_error_column = true;

struct ReportTable {
    const char* name;  // empty for the only table of a measurement
    const char* description;
    std::vector<ReportColumn> columns{};
    std::vector<double> values{};  // row by row
    std::size_t blocks = 0;        // largest number behind an average

    ReportTable(const char* table_name, const char* table_description,
                std::initializer_list<ColumnSpec> specs)
        : name(table_name), description(table_description) {
        for (const ColumnSpec& spec : specs) add_column(spec);
    }
    void add_column(const ColumnSpec& spec) {
        const std::string key = spec.quantity->key();
        columns.push_back({key, spec.quantity});
        if (spec.has_error) columns.push_back({key + "_error", spec.quantity, true});
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
    void push(const Estimate& e) {
        values.insert(values.end(), {e.mean, e.error});
        blocks = std::max(blocks, e.blocks);
    }
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

/// Makes all numbers of some rows and columns missing.
template <class Omits>
void omit(Report& report, Omits&& omits) {
    for (ReportTable& table : report.tables)
        for (std::size_t c = 0; c < table.columns.size(); ++c) {
            if (!omits(*table.columns[c].quantity)) continue;
            for (std::size_t r = 0; r < table.rows(); ++r)
                table.values[r * table.columns.size() + c] = not_available;
        }
    for (ReportRow& row : report.rows) {
        if (!omits(*row.quantity)) continue;
        row.estimate.mean = row.estimate.error = not_available;
        for (ReportDetail& detail : row.details) detail.value = not_available;
    }
}

/// Divides every number by its unit.
inline void in_printed_units(Report& report, const MeasuredUnits& units) {
    for (ReportRow& row : report.rows)
        row.estimate = scaled(row.estimate, 1.0 / units.of(row.quantity->unit));
    for (ReportTable& table : report.tables)
        for (std::size_t c = 0; c < table.columns.size(); ++c) {
            const double unit = units.of(table.columns[c].quantity->unit);
            for (std::size_t r = 0; r < table.rows(); ++r)
                table.values[r * table.columns.size() + c] /= unit;
        }
}

/// Corrects all errors for few blocks (few_blocks.hpp). No number has more than `at_most`
/// independent blocks. All columns of a table are averages over the same blocks.
inline void correct_errors(Report& report, std::size_t at_most) {
    for (ReportRow& row : report.rows) row.estimate = corrected(row.estimate, at_most);
    for (ReportTable& table : report.tables) {
        const double factor = few_blocks_factor(std::min(table.blocks, at_most));
        for (std::size_t c = 0; c < table.columns.size(); ++c) {
            if (!table.columns[c].is_error) continue;
            for (std::size_t r = 0; r < table.rows(); ++r)
                table.values[r * table.columns.size() + c] *= factor;
        }
    }
}

/// An average of a measurement, and its row in the report.
template <class Average>
struct AverageRow {
    AverageRow(const Quantity& row, Average& its_average) : quantity(row), average(its_average) {}
    const Quantity& quantity;
    Average& average;
};

/// Base of a measurement M whose averages are rows of its report. M lists them once, in the order
/// of the report and of its checkpoint:
///
///     static auto rows(auto& s) {
///         return std::tuple{AverageRow{quantity("slip.cluster"), s.cluster_}};
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
            visit(ReportRow{row.quantity, row.average.estimate()});
        };
        std::apply([&](const auto&... row) { (visit_row(row), ...); },
                   M::rows(static_cast<const M&>(*this)));
    }
};

/// Angles are radians inside and degrees in reports.
inline constexpr double degrees_per_radian = 180.0 / pi;

}  // namespace swirl
