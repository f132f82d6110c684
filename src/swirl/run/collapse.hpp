// Whether a run still makes progress. A collapse is infinitely many collisions in a finite time, by
// restitution or, with e = 1, by friction alone (docs/physics.md). It is told from a busy dish by
// how many events pass in how little of a swirl, and so at the same event on every machine, however
// fast it is: a disc of the paper's dish has about 70 events per swirl, one that obeys a contact
// duration at most T/t_c.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace swirl {

/// How far a run is.
struct RunMark {
    std::uint64_t events;
    double periods;
};

/// The last events, and how much of a swirl they took.
struct Collapse {
    std::uint64_t events;
    double periods;
};

/// Of one run, asked between its events.
class CollapseWatch {
  public:
    CollapseWatch(std::size_t discs, const RunMark& begin)
        : discs_(discs), mark_(begin), lately_{begin, begin} {}

    /// Now and then.
    std::optional<Collapse> look(const RunMark& now) {
        if (now.events - mark_.events >= window()) {
            if (const auto found = collapse_since(mark_, now)) return found;
            mark_ = now;
        }
        if (now.events - lately_[1].events >= min_window) lately_ = {lately_[1], now};
        return {};
    }

    /// At the end, or when the run is stopped: of the last few hundred events alone, for what was
    /// before may have been as it should.
    std::optional<Collapse> look_at_the_end(const RunMark& now) const {
        for (const RunMark& mark : {lately_[1], lately_[0]})
            if (now.events - mark.events >= min_window) return collapse_since(mark, now);
        return {};
    }

  private:
    static constexpr double too_fast = 1e8;  // events per disc and swirl
    static constexpr std::uint64_t min_window = 500;

    /// Some two hundred events for each disc: the two that collapse may be among thousands.
    std::uint64_t window() const { return std::max<std::uint64_t>(20'000, 200 * discs_); }
    std::optional<Collapse> collapse_since(const RunMark& mark, const RunMark& now) const {
        const Collapse found{now.events - mark.events, now.periods - mark.periods};
        const double maximum = too_fast * static_cast<double>(discs_) * found.periods;
        if (static_cast<double>(found.events) <= maximum) return {};
        return found;
    }

    std::size_t discs_;
    RunMark mark_;                   // the last time that a collapse was looked for
    std::array<RunMark, 2> lately_;  // some hundreds of events ago, and fewer
};

}  // namespace swirl
