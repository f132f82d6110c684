#include "swirl/run/period_series.hpp"

#include <fmt/format.h>

#include <cmath>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/table.hpp"
#include "swirl/run/budget.hpp"

namespace swirl {
namespace {

/// cell_text(), but a whole number without a decimal point or an exponent.
std::string series_cell(double value) {
    constexpr double exact_integers = 0x1p53;
    if (value == std::floor(value) && std::fabs(value) < exact_integers)
        return fmt::format("{}", static_cast<std::int64_t>(value));
    return cell_text(value);
}

}  // namespace

PeriodSeries::PeriodSeries(const RunConfig& config, std::vector<std::string> measurements)
    : config_(config), measured_(config.container_radius, config.period, std::move(measurements)) {
    add_columns();
}

void PeriodSeries::add_columns() {
    columns_ = {{"period", "1", "number of the period, from 0"},
                {"counted", "1", "1 if the period counts in the averages of the run"}};
    RotationEstimates().report([&](const ReportRow& row) {
        columns_.push_back({row.name, row.unit, row.description});
    });
    columns_.push_back({"spin", "Ω", "mean spin of the particles"});
    columns_.push_back({"energy", "m v²", "mean kinetic energy in the lab frame, with spins"});
    columns_.push_back({"centre_x", "r", "mean centre of mass in the M-frame, x"});
    columns_.push_back({"centre_y", "r", "mean centre of mass in the M-frame, y"});
    columns_.push_back({"events", "1", "number of events of all kinds"});
    for (const Ramp& ramp : config_.ramps)
        columns_.push_back(
            {"ramp." + ramp.name, find_parameter(ramp.name)->unit, "value of the ramp"});
    first_measured_ = columns_.size();
    for (const auto& [name, report] : measured_.report())
        for (const ReportRow& row : report.rows)
            columns_.push_back({name + "." + row.name, row.unit, row.description});
}

Observation PeriodSeries::empty_observation() const {
    return Observation(config_.container_radius, config_.period, measured_.names());
}

void PeriodSeries::sample(const Snapshot& snapshot) {
    view_.update(snapshot);
    energy_ += budget_of(snapshot).energy;
    centre_ = centre_ + view_.centre_of_mass().position;
    samples_ += 1.0;
}

void PeriodSeries::add_period(const PeriodAverages& averages) {
    const auto add = [&](double value) { values_.push_back(finite_or_missing(value)); };
    add(static_cast<double>(averages.period));
    add(averages.is_counted ? 1.0 : 0.0);
    for (const double rate : averages.rotation) add(rate);
    add(averages.spin);
    add(energy_ / samples_);
    add(centre_.x / samples_);
    add(centre_.y / samples_);
    add(static_cast<double>(averages.events - events_));
    for (const Ramp& ramp : config_.ramps) add(ramp.value_in(averages.period));
    events_ = averages.events;
    energy_ = samples_ = 0.0;
    centre_ = {0.0, 0.0};
    if (!measures()) return;
    measured_.close_block();
    for (const auto& [name, report] : measured_.report())
        for (const ReportRow& row : report.rows) add(row.estimate.mean);
    measured_ = empty_observation();
}

std::vector<double> PeriodSeries::counted(std::size_t column) const {
    std::vector<double> values;
    for (std::size_t k = 0; k < periods(); ++k)
        if (at(k, 1) != 0.0 && !std::isnan(at(k, column))) values.push_back(at(k, column));
    return values;
}

std::vector<double> PeriodSeries::counted(std::string_view column_name) const {
    for (std::size_t c = 0; c < columns_.size(); ++c)
        if (columns_[c].name == column_name) return counted(c);
    return {};
}

std::vector<SeriesAverage> PeriodSeries::averages() const {
    std::vector<SeriesAverage> all;
    const std::size_t first_ramp = first_measured_ - config_.ramps.size();
    for (std::size_t c = 2; c < columns_.size(); ++c) {
        if (c >= first_ramp && c < first_measured_) continue;
        const std::vector<double> values = counted(c);
        const auto [estimate, time] = estimate_of_series(values);
        all.push_back(
            {columns_[c].name, columns_[c].unit, estimate, time, fluctuations_of({&values, 1})});
    }
    return all;
}

std::string PeriodSeries::header() const {
    std::string line;
    for (const SeriesColumn& column : columns_) line += (line.empty() ? "" : ",") + column.name;
    return line + "\n";
}

std::string PeriodSeries::rows(std::size_t first) const {
    std::string lines;
    for (std::size_t k = first; k < periods(); ++k) {
        for (std::size_t c = 0; c < columns_.size(); ++c)
            lines += (c > 0 ? "," : "") + series_cell(at(k, c));
        lines += '\n';
    }
    return lines;
}

void PeriodSeries::write(const std::filesystem::path& file) const {
    write_file_atomically(file, header() + rows());
}

}  // namespace swirl
