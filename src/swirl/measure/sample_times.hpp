// The times at which a container is sampled: k T / n in every period, or k times an interval. The
// state in a snapshot is valid until the next event, so the exact state at a time before it is the
// same snapshot with another clock:
//
//     while (times.next(snapshot, path, event.clock)) observation.sample(snapshot);
//
// Times are those of the simulation. The end of a period is the beginning of the next one, and
// belongs to that.
#pragma once

#include <cmath>
#include <cstdint>

#include "swirl/math/real.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

class SampleTimes {
  public:
    /// With `interval` above 0: k · interval from the beginning, independent of the periods. Then
    /// the period must not change.
    SampleTimes(int per_period, double period, double interval = 0.0)
        : per_period_(per_period), period_(period), interval_(interval) {}

    /// Sets the clock and the container of the snapshot to the next sample time up to `clock`
    /// within its period; false if there is none left. Called before every event; usually there is
    /// none.
    SWIRL_INLINE bool next(Snapshot& s, const ContainerPath& path, double clock) {
        if (s.periods == periods_ && due_ > clock) return false;
        return advance(s, path, clock);
    }
    /// The time on the clock of this period at or before which next() has nothing; 0 if that is not
    /// yet determined.
    double due(std::int64_t periods) const {
        return periods == periods_ ? std::fmax(due_, 0.0) : 0.0;
    }
    /// For an event loop that takes the samples of a period itself, k T / n: k of the next one.
    std::int64_t next_in_period(std::int64_t periods) const {
        return periods != periods_ ? 0 : index_;
    }
    int per_period() const { return per_period_; }
    /// The loop has taken those before this one.
    void taken(std::int64_t periods, double period, std::int64_t next) {
        period_ = period;
        periods_ = periods;
        index_ = next;
        due_ = next_in(periods);
    }
    /// Moves the clock and the container of the snapshot to a time of its period.
    static void move(Snapshot& s, const ContainerPath& path, double clock) {
        s.clock = clock;
        const Segment& segment = path.segment_at(clock);
        s.container_centre = segment.position_at(clock);
        s.container_velocity = segment.velocity_at(clock);
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(index_, periods_);
    }
    /// With an interval, every time in the earlier periods has been taken (one less for rounding).
    bool is_consistent() const {
        if (interval_ == 0.0) return index_ <= per_period_;
        const double due = static_cast<double>(periods_) * period_ / interval_;
        return static_cast<double>(index_) + 1.0 >= due * (1.0 - 1e-9);
    }

  private:
    bool advance(Snapshot& s, const ContainerPath& path, double clock) {
        period_ = s.period;
        if (s.periods != periods_) begin_period(s.periods);
        if (due_ == undetermined) due_ = next_in(s.periods);
        if (!(due_ <= clock)) return false;
        move(s, path, due_);
        ++index_;
        due_ = next_in(s.periods);
        return true;
    }
    void begin_period(std::int64_t periods) {
        if (interval_ == 0.0) index_ = 0;
        periods_ = periods;
        due_ = undetermined;
    }
    /// The next sample time on the clock of this period; never if it is in a later one.
    double next_in(std::int64_t periods) const {
        const auto k = static_cast<double>(index_);
        if (interval_ == 0.0) return index_ < per_period_ ? period_ * k / per_period_ : never;
        const double its_period = std::floor(k * interval_ / period_);
        const auto now = static_cast<double>(periods);
        return its_period > now ? never : std::fmax(0.0, k * interval_ - now * period_);
    }

    static constexpr double undetermined = -1.0;

    int per_period_;
    double period_, interval_;
    std::int64_t index_ = 0;     // index of the next sample
    std::int64_t periods_ = 0;   // whole periods before that in which it counts
    double due_ = undetermined;  // its time in this period, once determined
};

}  // namespace swirl
