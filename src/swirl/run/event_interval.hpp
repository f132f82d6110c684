// After how many events a run samples its rotation by event. The interval follows from the number
// of discs and from the events of the last period, so a resumed run has the same samples.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "swirl/measure/cluster_rotation.hpp"

namespace swirl {

class EventInterval {
  public:
    /// `fixed` is the interval of the whole run; 0: it follows from the run.
    EventInterval(std::int64_t fixed, std::size_t discs)
        : is_fixed_(fixed > 0),
          interval_(is_fixed_ ? static_cast<std::uint64_t>(fixed)
                              : events_per_rotation_sample(discs)),
          left_(interval_) {}

    std::uint64_t events() const { return interval_; }
    /// Events until the next sample; the event loop counts them.
    std::uint64_t& left() { return left_; }

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
    bool is_fixed_;
    std::uint64_t interval_, left_;
    std::uint64_t events_before_ = 0;  // those before this period
};

}  // namespace swirl
