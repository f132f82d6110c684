// Results of measurements (measure/measurement_report.hpp) as Python tuples and arrays.
#pragma once

#include <pybind11/pybind11.h>

#include "swirl/run/measurements.hpp"

namespace swirl::python {

/// [(measurement, [(name, unit, description, mean, error, effective samples, blocks, {detail:
/// value}, has an error)], [(name, description, [(column, unit)], values[row][column])])]
pybind11::list reports_in_python(const MeasurementReports& reports);

}  // namespace swirl::python
