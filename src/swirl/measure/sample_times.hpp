// The moments at which a dish is sampled: k T / n in every period, or k times an interval. Until
// the next event the state of a snapshot holds, so the exact state at a moment in between is the
// same snapshot with another clock:
//
//     while (times.next(snapshot, path, event.clock)) observation.sample(snapshot);
//
// Times are those of the simulation; the end of a period is the beginning of the next, and counts
// there.
#pragma once

#include <cmath>
#include <cstdint>

#include "swirl/math/real.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

class SampleTimes {
  public:
    /// `interval` above 0: k · interval from the beginning, whatever the periods.
    SampleTimes(int per_period, double period, double interval = 0.0)
        : per_period_(per_period), period_(period), interval_(interval) {}

    /// Puts the clock and the container of the snapshot to the next moment up to `clock` within its
    /// period; false if there is none left. Asked before every event, and mostly there is none.
    SWIRL_INLINE bool next(Snapshot& s, const ContainerPath& path, double clock) {
        if (s.periods == periods_ && due_ > clock) return false;
        return take_next(s, path, clock);
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(index_, periods_);
    }
    /// By an interval every moment of the swirls before has been taken. (One less for rounding.)
    bool is_consistent() const {
        if (interval_ == 0.0) return index_ <= per_period_;
        const double due = static_cast<double>(periods_) * period_ / interval_;
        return static_cast<double>(index_) + 1.0 >= due * (1.0 - 1e-9);
    }

  private:
    bool take_next(Snapshot& s, const ContainerPath& path, double clock) {
        if (s.periods != periods_) begin_period(s.periods);
        if (due_ == not_asked) due_ = next_in(s.periods);
        if (!(due_ <= clock)) return false;
        s.clock = due_;
        const Segment& segment = path.segment_at(s.clock);
        s.container_centre = segment.position_at(s.clock);
        s.container_velocity = segment.velocity_at(s.clock);
        ++index_;
        due_ = next_in(s.periods);
        return true;
    }
    void begin_period(std::int64_t periods) {
        if (interval_ == 0.0) index_ = 0;
        periods_ = periods;
        due_ = not_asked;
    }
    /// The next moment on the clock of this period; never, if it is not in it.
    double next_in(std::int64_t periods) const {
        const auto k = static_cast<double>(index_);
        if (interval_ == 0.0) return index_ < per_period_ ? period_ * k / per_period_ : never;
        const double swirl = std::floor(k * interval_ / period_);
        const auto now = static_cast<double>(periods);
        return swirl > now ? never : std::fmax(0.0, k * interval_ - now * period_);
    }

    static constexpr double not_asked = -1.0;

    int per_period_;
    double period_, interval_;
    std::int64_t index_ = 0;    // of the next
    std::int64_t periods_ = 0;  // whole periods before the one it counts in
    double due_ = not_asked;    // its moment in this period, once it has been asked for
};

}  // namespace swirl
