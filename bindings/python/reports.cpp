#include "reports.hpp"

#include "arrays.hpp"

namespace swirl::python {

py::list reports_in_python(const MeasurementReports& reports) {
    py::list all;
    for (const auto& [measurement, report] : reports) {
        py::list rows, tables;
        for (const ReportRow& row : report.rows) {
            py::dict details;
            for (const ReportDetail& detail : row.details) details[detail.name] = detail.value;
            const Estimate& e = row.estimate;
            rows.append(py::make_tuple(row.name, row.unit, row.description, e.mean, e.error,
                                       e.effective_samples, e.blocks, details, row.has_error));
        }
        for (const ReportTable& table : report.tables) {
            py::list columns;
            for (const ReportColumn& column : table.columns)
                columns.append(py::make_tuple(column.name, column.unit()));
            tables.append(py::make_tuple(
                table.name, table.description, columns,
                owned_array(table.values, {static_cast<py::ssize_t>(table.rows()),
                                           static_cast<py::ssize_t>(table.columns.size())})));
        }
        all.append(py::make_tuple(measurement, rows, tables));
    }
    return all;
}

}  // namespace swirl::python
