// The measurements of a run (measure/observation.hpp), for people and for other programs: reads
// lists of names, and writes reports as JSON, as CSV, as text and as the tables of
// docs/reference/measurements.md. All of it visits the rows and tables of the reports and knows no
// measurement by name.
//
// JSON: a row is an object {"mean", "error", "effective_samples", "blocks", …} or a bare number, a
// table an object of columns. Missing values are null.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "swirl/measure/observation.hpp"
#include "swirl/run/run.hpp"

namespace swirl {

using MeasurementReports = std::vector<MeasurementReport>;

/// Reads "density,flow" or "all". Throws UsageError with the list of all names if one is unknown.
std::vector<std::string> read_measurement_list(std::string_view list);

/// One line for each measurement.
std::string measurement_list_text();
/// The same with all their rows and tables, and the units.
std::string measurement_help_text();

/// Throws UsageError if one of the measurements is defined in the M-frame.
void require_m_frame_for(const std::vector<std::string>& names);

/// For the container of that run; the names are those of read_measurement_list(). On a path without
/// an M-frame, the list of all measurements means all that do not need it, and any other list that
/// does throws UsageError.
Observation observation_of(const RunConfig& config, std::vector<std::string> names);

/// For each measurement an object with its rows and tables. A table without a name is the object.
nlohmann::ordered_json measured_json(const MeasurementReports& reports);

/// "slip.cluster" and its value.
struct MeasuredNumber {
    std::string name;
    Estimate estimate;
    bool direction = false;  // an angle in degrees: 350 and 10 make 0
};
/// Every row in the JSON of measured_json().
std::vector<MeasuredNumber> measured_numbers(const nlohmann::ordered_json& measured);
/// True if the number with this name is an angle, whose mean is that of unit vectors.
inline bool is_direction(std::string_view name) {
    const Quantity* const quantity = find_quantity(name);
    return quantity && quantity->combines == Combines::as_direction;
}

/// One line for every row and every table. Missing values are summarized: a measurement without any
/// value is one line, and if most values are missing, one line counts them. Of a run with units,
/// each number is also in the user's.
std::string measured_text(const MeasurementReports& reports, const RunConfig* run = nullptr);

/// The files that write_measured_tables() writes for these measurements.
std::vector<std::filesystem::path> measured_table_files(const std::vector<std::string>& names,
                                                        const std::filesystem::path& folder);

/// Writes every table as FOLDER/NAME.csv and all rows as FOLDER/numbers.csv; returns the files.
std::vector<std::filesystem::path> write_measured_tables(const MeasurementReports& reports,
                                                         const std::filesystem::path& folder);

}  // namespace swirl
