// The averages of every period of a run (period_series.hpp), if it has such a series. Without one,
// the functions do nothing.
#pragma once

#include <cstdint>

namespace swirl {

class PeriodSeries;
struct Event;
struct PeriodAverages;
struct Snapshot;

class RunSeries {
  public:
    void set(PeriodSeries* series);

    bool exists() const { return series_ != nullptr; }
    /// True if it measures more than the run itself, and whether this needs every event.
    bool measures() const { return measures_; }
    bool samples_events() const { return samples_events_; }

    void sample(const Snapshot& snapshot);
    void sample_measured(const Snapshot& snapshot);
    void sample_measured(const Event& event, const Snapshot& after);
    void add_period(const PeriodAverages& averages);

  private:
    PeriodSeries* series_ = nullptr;
    bool measures_ = false, samples_events_ = false;
};

}  // namespace swirl
