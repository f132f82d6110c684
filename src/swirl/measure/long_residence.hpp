// Who is on a long stay in the layer at the wall (wall_residence.hpp has the definition), disc by
// disc and moment by moment. Whether a stay is a long one is known only when it has lasted long
// enough; then all of it is, from its first sample on. So whoever sees something of the discs at a
// moment keeps it, and asks later:
//
//     knows(t)       it is known who was on a long stay at time t, or it never will be
//     pinned(i, t)   disc i was; asked when it is known, and for no earlier moment than the last
//     time
//                    plus the least length of a stay
//
// A stay that has ended is remembered until the next long one of the same disc ends. That one began
// after it and lasted long enough, so nobody asks for the first any more.
//
// Units: those of the views. Limits: samples whose times do not ascend, or a change of the number
// of discs, begin anew; what was seen before is never known.
#pragma once

#include <cstddef>
#include <vector>

#include "swirl/measure/m_frame.hpp"

namespace swirl {

/// Of the wall's layer in disc radii, and the least length of a stay in periods.
inline constexpr double wall_layer = 1.5, long_residence = 40.0 / 511.0;

/// Is disc i within so many of its radii of the wall? A layer thicker than the dish is all of it.
inline bool in_wall_layer(const MFrameView& view, std::size_t i, double radii = wall_layer) {
    const Vec2 p = view.position(i);
    const double inner = view.container_radius - radii * view.radius[i];
    return !(inner > 0.0) || dot(p, p) > inner * inner;
}

class LongResidences {
  public:
    /// All samples at equal steps of time.
    void sample(const MFrameView& view) {
        const double step = view.time - last_;
        if (view.size() != begin_.size() || !(step > 0.0)) {
            begin_anew(view.size(), view.time);
        } else {
            // Half a step, since times are rounded.
            minimum_ = long_residence * (2.0 * pi / view.frame.omega) - 0.5 * step;
        }
        for (std::size_t i = 0; i < view.size(); ++i) {
            const bool there = in_wall_layer(view, i);
            if (there == (begin_[i] < never)) continue;
            if (there) {
                begin_[i] = view.time;
                continue;
            }
            if (last_ - begin_[i] >= minimum_) long_begin_[i] = begin_[i], long_end_[i] = last_;
            begin_[i] = never;
        }
        last_ = view.time;
    }
    /// The discs of the next sample are not those of the last.
    void begin_anew() { begin_.clear(); }

    bool knows(double time) const { return !sees(time) || last_ - time >= minimum_; }
    bool pinned(std::size_t disc, double time) const {
        if (!sees(time) || disc >= begin_.size()) return false;
        return begin_[disc] <= time || (long_begin_[disc] <= time && time <= long_end_[disc]);
    }

    template <class Visitor>
    void fields(Visitor&& visit) {
        for (double* value : {&first_, &last_, &minimum_}) visit(*value);
        for (auto* column : {&begin_, &long_begin_, &long_end_}) visit(*column);
    }
    /// Where the discs are to begin again, what is kept of those before does not matter.
    bool is_consistent() const {
        return begin_.empty() ||
               (long_begin_.size() == begin_.size() && long_end_.size() == begin_.size());
    }

  private:
    bool sees(double time) const { return first_ <= time && time <= last_; }
    void begin_anew(std::size_t discs, double time) {
        first_ = time;
        minimum_ = never;
        begin_.assign(discs, never);
        long_begin_.assign(discs, never);
        long_end_.assign(discs, never);
    }

    double first_ = never, last_ = -never, minimum_ = never;  // times; in periods of the views
    std::vector<double> begin_;                  // of the present stay; never: it is not there
    std::vector<double> long_begin_, long_end_;  // of the last long one; never: there was none
};

}  // namespace swirl
