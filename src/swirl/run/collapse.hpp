// Test whether a run still makes progress. A collapse is infinitely many collisions in a finite
// time, by restitution or, with e = 1, by friction alone (docs/explanation/physics.md). The
// criterion is the number of events in a fraction of a period. So it acts at the same event on
// every machine, whatever its speed. A disc in the paper's container has about 70 events per
// period; one with a contact duration has at most T/t_c.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace swirl {

/// The progress of a run.
struct RunMark {
    std::uint64_t events;
    double periods;
};

/// The number of the last events, and the part of a period in which they happened.
struct Collapse {
    std::uint64_t events;
    double periods;
};

/// Watches one run; called between its events.
class CollapseWatch {
  public:
    CollapseWatch(std::size_t discs, const RunMark& begin)
        : discs_(discs), mark_(begin), recent_{begin, begin} {}

    /// Call this at intervals; it costs little.
    std::optional<Collapse> check(const RunMark& now) {
        if (now.events - mark_.events >= window()) {
            if (const auto found = collapse_since(mark_, now)) return found;
            mark_ = now;
        }
        if (now.events - recent_[1].events >= min_window) recent_ = {recent_[1], now};
        return {};
    }

    /// Call this at the end, or when the run is stopped. It uses only the last few hundred events,
    /// because earlier events may have been normal.
    std::optional<Collapse> check_at_end(const RunMark& now) const {
        for (const RunMark& mark : {recent_[1], recent_[0]})
            if (now.events - mark.events >= min_window) return collapse_since(mark, now);
        return {};
    }

  private:
    static constexpr double too_fast =
        1e8;  // events per disc and period: far above any run that progresses
    static constexpr std::uint64_t min_window = 500;  // events

    /// At least 200 events per disc: the two that collapse may be among thousands.
    std::uint64_t window() const { return std::max<std::uint64_t>(20'000, 200 * discs_); }
    std::optional<Collapse> collapse_since(const RunMark& mark, const RunMark& now) const {
        const Collapse found{now.events - mark.events, now.periods - mark.periods};
        const double maximum = too_fast * static_cast<double>(discs_) * found.periods;
        if (static_cast<double>(found.events) <= maximum) return {};
        return found;
    }

    std::size_t discs_;
    RunMark mark_;                   // mark of the last check
    std::array<RunMark, 2> recent_;  // one and two times min_window events ago, at least
};

}  // namespace swirl
