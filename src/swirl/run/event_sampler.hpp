// When a run samples its rotation by event: after every `interval` events. The interval follows
// from the number of discs and from the events of the last period, so a resumed run has the same
// samples.
//
// A sample that is due is taken as late as possible, so that the processor need not wait for the
// snapshot to be written (cluster_rotation.hpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "swirl/measure/cluster_rotation.hpp"

namespace swirl {

class EventSampler {
  public:
    /// `fixed` is the interval of the whole run; 0: it follows from the run.
    EventSampler(std::int64_t fixed, std::size_t discs)
        : is_fixed_(fixed > 0),
          interval_(is_fixed_ ? static_cast<std::uint64_t>(fixed)
                              : events_per_rotation_sample(discs)),
          left_(interval_) {}

    std::uint64_t interval() const { return interval_; }
    bool samples_every_event() const { return interval_ == 1; }
    /// Events until the next sample.
    std::uint64_t left() const { return left_; }

    /// At most left() events.
    void count(std::uint64_t events) {
        left_ -= events;
        if (left_ > 0) return;
        left_ = interval_;
        is_due_ = true;
    }
    /// True if the current state is still to be sampled.
    bool is_due() const { return is_due_; }
    void take() { is_due_ = false; }

    /// `events`: all of the run so far. Returns those of the period that has ended.
    std::uint64_t begin_period(std::size_t discs, std::uint64_t events) {
        const std::uint64_t in_period = events - std::exchange(events_before_, events);
        if (!is_fixed_) {
            interval_ = events_per_rotation_sample(discs, in_period);
            left_ = std::min(left_, interval_);
        }
        return in_period;
    }

    void fields(auto&& visit) { visit(interval_, left_, events_before_); }

  private:
    bool is_fixed_, is_due_ = false;
    std::uint64_t interval_, left_;
    std::uint64_t events_before_ = 0;  // those before this period
};

}  // namespace swirl
