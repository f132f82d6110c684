#include "swirl/run/measurements.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "swirl/io/table.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/path_parameter.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/units.hpp"

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

const MeasurementKind& require_measurement(std::string_view name) {
    if (const MeasurementKind* kind = find_measurement(name)) return *kind;
    std::vector<std::string> known;
    for (const MeasurementKind& kind : measurement_kinds()) known.emplace_back(kind.name);
    const std::string hint = nearest_value_hint(name, known);
    throw UsageError(fmt::format("--measure has '{}' in its list, but each must be one of: {}.{}",
                                 name, fmt::join(known, ", "),
                                 hint.empty() ? "\nhint: 'all' selects every measurement." : hint));
}

/// Rows and tables without data: names, units, descriptions.
MeasurementReports empty_reports() {
    return Observation({1.0, 1.0}, read_measurement_list("all")).report();
}

/// "slip.cluster"; "density" for a table without a name, "energy" for a row without a group.
std::string full_name(const std::string& measurement, std::string_view name) {
    if (measurement.empty() || name.empty()) return measurement + std::string(name);
    return fmt::format("{}.{}", measurement, name);
}

std::string in_unit(std::string_view value, std::string_view unit) {
    return unit == "1" || value == "n/a" ? std::string(value) : fmt::format("{} {}", value, unit);
}

/// "theta (°), pressure (m v²/r²), …". Columns of errors are omitted.
std::string columns_text(const ReportTable& table) {
    std::string text;
    for (const ReportColumn& column : table.columns) {
        const std::string_view name = column.name;
        if (column.is_error) continue;
        if (!text.empty()) text += ", ";
        text += column.quantity->unit.is_number() ? std::string(name)
                                                  : fmt::format("{} ({})", name, column.unit());
    }
    return text;
}

Json table_json(const ReportTable& table) {
    Json json = Json::object();
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        Json& column = json[table.columns[c].name] = Json::array();
        for (std::size_t r = 0; r < table.rows(); ++r) column.push_back(table.at(r, c));
    }
    return json;
}

/// JSON has no NaN; it is written as null.
double number(const Json& json) { return json.is_number() ? json.get<double>() : not_available; }

bool is_table(const Json& json) {
    return json.is_object() && !json.empty() && json.begin()->is_array();
}

Estimate estimate_in(const Json& value) {
    if (!value.is_object()) return {.mean = number(value)};
    return {.mean = number(value.value("mean", Json())),
            .error = number(value.value("error", Json())),
            .effective_samples = number(value.value("effective_samples", Json())),
            .blocks = value.value("blocks", std::size_t{0})};
}

bool has_value(const ReportRow& row) { return std::isfinite(row.estimate.mean); }

fs::path write_table(const ReportTable& table, const fs::path& file) {
    std::vector<std::string> heads;
    for (const ReportColumn& column : table.columns) heads.emplace_back(column.name);
    Table csv(heads);
    for (std::size_t r = 0; r < table.rows(); ++r) {
        std::vector<Table::Cell> cells;
        for (std::size_t c = 0; c < heads.size(); ++c) cells.emplace_back(table.at(r, c));
        csv.add(std::move(cells));
    }
    csv.write(file);
    return file;
}

}  // namespace

std::vector<std::string> read_measurement_list(std::string_view list) {
    std::vector<std::string> names;
    if (list == "all") {
        for (const MeasurementKind& kind : measurement_kinds()) names.emplace_back(kind.name);
        return names;
    }
    const std::string given(list);
    while (true) {
        const std::size_t comma = list.find(',');
        const std::string_view next = list.substr(0, comma);
        if (next.empty())
            throw UsageError(
                fmt::format("--measure is '{}', but a name in the list is empty.", given));
        if (next == "all")
            throw UsageError(fmt::format(
                "--measure is '{}', but 'all' cannot be combined with other names.", given));
        const std::string name(require_measurement(next).name);
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        if (comma == list.npos) return names;
        list.remove_prefix(comma + 1);
    }
}

std::string measurement_list_text() {
    std::string text;
    for (const MeasurementKind& kind : measurement_kinds())
        text += fmt::format("  {:<22} {}\n", kind.name, kind.description);
    return text;
}

std::string measurement_help_text() {
    std::string text = "every run:\n";
    const auto line = [&](const std::string& name, const ReportRow& row) {
        text +=
            fmt::format("  {:<38}{:<9}{}\n", full_name(name, row.name), row.unit, row.description);
    };
    RunResult().report(line);
    for (const auto& [name, report] : empty_reports()) {
        text += fmt::format("{}: {}\n", name, require_measurement(name).description);
        for (const ReportRow& row : report.rows) line(name, row);
        for (const ReportTable& table : report.tables)
            text += fmt::format("  {:<38}table: {}\n{:40}{}\n", full_name(name, table.name),
                                table.description, "", columns_text(table));
    }
    return text;
}

void require_m_frame_for(const std::vector<std::string>& names) {
    std::vector<std::string> possible;
    for (const MeasurementKind& kind : measurement_kinds())
        if (!kind.needs_m_frame) possible.emplace_back(kind.name);
    for (const std::string& name : names)
        if (find_measurement(name)->needs_m_frame)
            throw UsageError(fmt::format(
                "--measure has '{}' in its list, but it is defined in the M-frame, which this path "
                "does not have.\nhint: use {}. The M-frame needs a path that is nearly a circle.",
                name, fmt::join(possible, ", ")));
}

/// Pinned discs are defined in the M-frame: without it, none is known.
Observation observation_of(const RunConfig& config, std::vector<std::string> names) {
    const bool m_frame = has_m_frame(config);
    const bool all = names.size() == measurement_kinds().size();
    if (!m_frame && all)
        std::erase_if(names,
                      [](const auto& name) { return find_measurement(name)->needs_m_frame; });
    if (!m_frame) require_m_frame_for(names);
    return Observation(dish_of(config), std::move(names), m_frame);
}

Json measured_json(const MeasurementReports& reports) {
    Json measured = Json::object();
    for (const auto& [name, report] : reports) {
        Json& json = measured[name] = Json::object();
        for (const ReportRow& row : report.rows) json[row.name] = row_json(row);
        for (const ReportTable& table : report.tables)
            (*table.name == '\0' ? json : json[table.name]) = table_json(table);
    }
    return measured;
}

std::vector<MeasuredNumber> measured_numbers(const Json& measured) {
    std::vector<MeasuredNumber> numbers;
    for (const auto& [name, result] : measured.items()) {
        if (is_table(result)) continue;
        for (const auto& [quantity, value] : result.items())
            if (!is_table(value))
                numbers.push_back({name + "." + quantity, estimate_in(value),
                                   is_direction(name + "." + quantity)});
    }
    return numbers;
}

std::string measured_text(const MeasurementReports& reports, const RunConfig* run) {
    const std::optional<UserUnits> user = run ? user_units(*run) : std::nullopt;
    const auto value_of = [&](const ReportRow& row) {
        const Estimate& e = row.estimate;
        const std::string value = in_unit(with_error(e.mean, e.error), row.unit);
        const auto unit = user ? in_user_units(row.quantity->unit, *run, *user) : std::nullopt;
        if (!unit || std::isnan(e.mean)) return value;
        return fmt::format("{} = {} {}", value,
                           with_error(unit->factor * e.mean, unit->factor * e.error), unit->text);
    };
    std::string numbers, tables;
    const auto line = [&](const std::string& name, const std::string& value) {
        numbers += fmt::format("  {:<38}{}\n", name, value);
    };
    std::size_t rows = 0, missing = 0;
    for (const auto& [name, report] : reports)
        for (const ReportRow& row : report.rows) {
            ++rows;
            missing += has_value(row) ? 0 : 1;
        }
    const bool most_are_missing = 2 * missing > rows;
    for (const auto& [name, report] : reports) {
        const bool any = std::any_of(report.rows.begin(), report.rows.end(), has_value);
        if (!any && !report.rows.empty() && !most_are_missing) line(name, "n/a");
        for (const ReportRow& row : report.rows)
            if (has_value(row) || (any && !most_are_missing))
                line(full_name(name, row.name), value_of(row));
        for (const ReportTable& table : report.tables)
            tables += fmt::format("  {:<38}table of {}\n", full_name(name, table.name),
                                  counted(std::int64_t(table.rows()), "row"));
    }
    if (most_are_missing) line("n/a", fmt::format("{} of {} averages", missing, rows));
    return numbers + tables;
}

std::vector<fs::path> measured_table_files(const std::vector<std::string>& names,
                                           const fs::path& folder) {
    std::vector<fs::path> files;
    bool has_rows = false;
    for (const auto& [name, report] : Observation({1.0, 1.0}, names).report()) {
        for (const ReportTable& table : report.tables)
            files.push_back(folder / (full_name(name, table.name) + ".csv"));
        has_rows |= !report.rows.empty();
    }
    if (has_rows) files.push_back(folder / "numbers.csv");
    return files;
}

std::vector<fs::path> write_measured_tables(const MeasurementReports& reports,
                                            const fs::path& folder) {
    std::vector<fs::path> files;
    Table numbers({"quantity", "unit", "mean", "error", "effective_samples", "blocks"});
    bool has_rows = false;
    for (const auto& [name, report] : reports) {
        for (const ReportTable& table : report.tables)
            files.push_back(write_table(table, folder / (full_name(name, table.name) + ".csv")));
        for (const ReportRow& row : report.rows) {
            const Estimate& e = row.estimate;
            numbers.add({full_name(name, row.name), std::string(row.unit), e.mean, e.error,
                         e.effective_samples, static_cast<std::int64_t>(e.blocks)});
        }
        has_rows |= !report.rows.empty();
    }
    if (!has_rows) return files;
    files.push_back(folder / "numbers.csv");
    numbers.write(files.back());
    return files;
}

}  // namespace swirl
