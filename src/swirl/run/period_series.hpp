// The averages of every period of a run, as a table with one row per period (--series).
//
// Fixed columns: the number of the period, from 0; whether it counts in the averages of the run
// (after the warm-up); the four rotation rates; the mean spin; the mean kinetic energy; the mean
// centre of mass in the M-frame; the number of events. Then one column for each parameter with a
// ramp, and one for each row of the measurements of the run, with what this period contributes. The
// measurements follow the discs across the ends of periods: a residence counts in the period in
// which it ends. A number that is no mean over periods (Combines::not_at_all in quantity.hpp), such
// as a temperature, which is a difference of means, is n/a in every period.
//
// The average of a column over the periods is that of the run: values are weighted with what they
// count (a mean by event with the events of the period), and angles are averaged as unit vectors.
//
// Energy and centre are means over the samples by time of the rotation, 64 or 16 per period
// (cluster_rotation.hpp).
// A value that is not available is NaN, and an empty cell in the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/observation.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/run_series.hpp"
#include "swirl/statistics/fluctuations.hpp"

namespace swirl {

struct SeriesColumn {
    std::string name, unit, description;
    const Quantity* quantity = nullptr;  // null for a ramp
};

/// The mean of a column over the periods that count and have a value, its correlations, and its
/// fluctuations.
struct SeriesAverage {
    std::string name, unit;
    Estimate estimate;
    double autocorrelation_time;  // integrated, in periods; at least 1 (block_average.hpp)
    Fluctuations fluctuations;
};

class PeriodSeries final : public FollowsPeriods {
  public:
    /// `measurements`: names of measurement_kinds().
    PeriodSeries(const RunConfig& config, std::vector<std::string> measurements);

    void sample(const Snapshot& snapshot) override;
    void sample_measured(const Snapshot& snapshot) override { measured_.sample(snapshot); }
    void sample_measured(const Event& event, const EventStates& after) override {
        measured_.sample(event, after);
    }
    bool measures() const override { return !measured_.empty(); }
    bool samples_events() const override { return measured_.samples_events(); }
    void add_period(const PeriodAverages& averages) override;

    const std::vector<SeriesColumn>& columns() const { return columns_; }
    std::size_t periods() const { return values_.size() / columns_.size(); }
    double at(std::size_t period, std::size_t column) const {
        return values_[period * columns_.size() + column];
    }
    /// Row by row.
    const std::vector<double>& values() const { return values_; }

    /// The values of a column in the periods that count, without missing ones.
    std::vector<double> counted(std::size_t column) const;
    std::vector<double> counted(std::string_view column_name) const;

    /// The number of particles.
    double discs() const { return static_cast<double>(config_.discs); }
    bool has_ramps() const { return !config_.ramps.empty(); }
    /// Estimates for the columns that are averages: all but the first two and those of ramps.
    std::vector<SeriesAverage> averages() const;

    /// Writes the table as CSV, atomically. Throws FileError.
    void write(const std::filesystem::path& file) const;
    /// Its parts: the names of the columns, and the rows from this period on.
    std::string header() const;
    std::string rows(std::size_t first = 0) const;

    void fields(auto&& visit) {
        visit(values_, weights_, events_, energy_, centre_.x, centre_.y, samples_);
        if (measures()) visit(measured_);
    }
    bool is_consistent() const {
        return values_.size() % columns_.size() == 0 && weights_.size() == values_.size();
    }

  private:
    void add_columns();
    void add(double value, double weight = 1.0);
    SeriesAverage average(std::size_t column) const;

    RunConfig config_;
    std::vector<SeriesColumn> columns_;
    std::size_t first_measured_ = 0;  // index of the first column of a measurement
    std::vector<double> values_, weights_;
    MeasuredUnits units_;
    std::uint64_t events_ = 0;  // up to the last period

    // Sums over the present period.
    double energy_ = 0.0;
    Vec2 centre_{0.0, 0.0};
    double samples_ = 0.0;
    Observation measured_;
    MFrameView view_;
};

}  // namespace swirl
