#include "swirl/run/run_series.hpp"

#include "swirl/run/period_series.hpp"

namespace swirl {

void RunSeries::set(PeriodSeries* series) {
    series_ = series;
    measures_ = series && series->measures();
    samples_events_ = series && series->samples_events();
}

void RunSeries::sample(const Snapshot& snapshot) {
    if (series_) series_->sample(snapshot);
}
void RunSeries::sample_measured(const Snapshot& snapshot) {
    if (measures_) series_->sample_measured(snapshot);
}
void RunSeries::sample_measured(const Event& event, const Snapshot& after) {
    if (samples_events_) series_->sample_measured(event, after);
}
void RunSeries::add_period(const PeriodAverages& averages) {
    if (series_) series_->add_period(averages);
}

}  // namespace swirl
