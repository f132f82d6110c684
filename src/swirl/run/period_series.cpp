#include "swirl/run/period_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/table.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/run/budget.hpp"
#include "swirl/run/config.hpp"
#include "swirl/statistics/circular_mean.hpp"
#include "swirl/statistics/few_blocks.hpp"

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
    : config_(config),
      units_(units_of(config)),
      measured_(dish_of(config), std::move(measurements)) {
    add_columns();
}

void PeriodSeries::add_columns() {
    const auto own = [&](const Quantity& q) {
        columns_.push_back({q.key(), q.unit.text, q.words, &q});
    };
    own(quantity("series.period"));
    own(quantity("series.counted"));
    RotationEstimates().report([&](const ReportRow& row) { own(*row.quantity); });
    own(quantity("series.spin"));
    own(quantity("series.energy"));
    own(quantity("series.centre_x"));
    own(quantity("series.centre_y"));
    own(quantity("series.events"));
    for (const Ramp& ramp : config_.ramps)
        columns_.push_back(
            {"ramp." + ramp.name, find_parameter(ramp.name)->unit, "value of the ramp"});
    first_measured_ = columns_.size();
    for (const auto& [name, report] : measured_.report())
        for (const ReportRow& row : report.rows)
            columns_.push_back({row.quantity->name, row.unit, row.description, row.quantity});
}

void PeriodSeries::sample(const Snapshot& snapshot) {
    view_.update(snapshot);
    energy_ += budget_of(snapshot).energy;
    centre_ = centre_ + view_.centre_of_mass().position;
    samples_ += 1.0;
}

void PeriodSeries::add(double value, double weight) {
    values_.push_back(finite_or_missing(value));
    weights_.push_back(weight);
}

void PeriodSeries::add_period(const PeriodAverages& averages) {
    add(static_cast<double>(averages.period));
    add(averages.is_counted ? 1.0 : 0.0);
    for (std::size_t r = 0; r < rotation_rates.size(); ++r)
        add(averages.rotation[r], averages.rotation_weights[r]);
    add(averages.spin);
    add(energy_ / samples_ / units_.of("m v²"));
    add(centre_.x / samples_ / units_.r);
    add(centre_.y / samples_ / units_.r);
    add(static_cast<double>(averages.events - events_));
    for (const Ramp& ramp : config_.ramps) add(ramp.value_in(averages.period));
    events_ = averages.events;
    energy_ = samples_ = 0.0;
    centre_ = {0.0, 0.0};
    if (!measures()) return;
    measured_.close_block();
    for (const auto& [name, report] : measured_.report())
        for (const ReportRow& row : report.rows) {
            const bool has_value = row.quantity->combines != Combines::not_at_all;
            add(has_value ? row.estimate.mean : not_available, row.estimate.weight);
        }
    measured_.forget_blocks();
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

SeriesAverage PeriodSeries::average(std::size_t column) const {
    const SeriesColumn& named = columns_[column];
    std::vector<double> values, weights;
    CircularMean direction;
    for (std::size_t k = 0; k < periods(); ++k) {
        const double value = at(k, column), weight = weights_[k * columns_.size() + column];
        if (at(k, 1) == 0.0 || std::isnan(value)) continue;
        values.push_back(value);
        weights.push_back(weight);
        direction.add_block(weight * unit_circle(value / 360.0));
    }
    // Equal weights must not be rounded.
    if (std::adjacent_find(weights.begin(), weights.end(), std::not_equal_to<>()) == weights.end())
        weights.clear();
    SeriesEstimate found = estimate_of_series(values, weights);
    if (named.quantity->combines == Combines::as_direction)
        found = {scaled(direction.angle(), degrees_per_radian), not_available};
    return {named.name, named.unit, corrected(found.estimate), found.autocorrelation_time,
            fluctuations_of({&values, 1})};
}

std::vector<SeriesAverage> PeriodSeries::averages() const {
    std::vector<SeriesAverage> all;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
        const Quantity* const quantity = columns_[c].quantity;
        if (quantity && quantity->combines != Combines::as_axis) all.push_back(average(c));
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
