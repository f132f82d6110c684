// Whoever gets the averages of every period of a run, such as a table with a row per period
// (period_series.hpp). Without one, the functions of RunSeries do nothing.
#pragma once

#include <array>
#include <cstdint>

#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/event_states.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

/// The averages of one period that a run itself has at its end.
struct PeriodAverages {
    std::int64_t period;
    bool is_counted;
    std::array<double, rotation_rates.size()> rotation, rotation_weights;
    double spin;
    std::uint64_t events;  // count since the start of the run
};

/// CoreRun calls it by virtual functions, so that the browser page does not contain the table.
class FollowsPeriods {
  public:
    /// Called at the sample times of the rotation.
    virtual void sample(const Snapshot& snapshot) = 0;
    /// If measures(), the first is called at the sample times of the run's measurements. If
    /// samples_events(), the second is called after every event.
    virtual void sample_measured(const Snapshot& snapshot) = 0;
    virtual void sample_measured(const Event& event, const EventStates& after) = 0;
    virtual void add_period(const PeriodAverages& averages) = 0;
    virtual bool measures() const = 0;
    virtual bool samples_events() const = 0;

  protected:
    FollowsPeriods() = default;
    FollowsPeriods(const FollowsPeriods&) = default;
    FollowsPeriods& operator=(const FollowsPeriods&) = default;
    ~FollowsPeriods() = default;
};

class RunSeries {
  public:
    void set(FollowsPeriods* series) {
        series_ = series;
        measures_ = series && series->measures();
        samples_events_ = series && series->samples_events();
    }

    bool exists() const { return series_ != nullptr; }
    /// True if it measures more than the run itself, and whether this needs every event.
    bool measures() const { return measures_; }
    bool samples_events() const { return samples_events_; }

    void sample(const Snapshot& snapshot) {
        if (series_) series_->sample(snapshot);
    }
    void sample_measured(const Snapshot& snapshot) {
        if (measures_) series_->sample_measured(snapshot);
    }
    void sample_measured(const Event& event, const EventStates& after) {
        if (samples_events_) series_->sample_measured(event, after);
    }
    void add_period(const PeriodAverages& averages) {
        if (series_) series_->add_period(averages);
    }

  private:
    FollowsPeriods* series_ = nullptr;
    bool measures_ = false, samples_events_ = false;
};

}  // namespace swirl
