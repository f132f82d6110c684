// Which discs are on a long residence in the layer at the wall, for every disc and every moment.
// wall_residence.hpp has the definition.
//
// A residence becomes a long one when it has lasted long enough; then all of it is long, from its
// first sample on. So a measurement stores its data of time t and asks later:
//
//     is_known(t)     true if it is determined which discs were on a long residence at time t, or
//                     if it can never be determined
//     resident(i, t)  true if disc i was on a long residence at time t. Call this at the first
//                     sample after is_known(t)
//
// A long residence that has ended is stored until the next long residence of the same disc ends.
// The second began after the first and has lasted long enough, so the first is no longer needed.
//
// Units: those of the views. Limits: if the times of samples do not ascend, or the number of discs
// changes, all residences restart; earlier ones are then never determined.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/strided.hpp"

namespace swirl {

/// Thickness of the wall's layer, in disc radii.
inline constexpr double wall_layer = 1.5;
/// Minimum length of a long residence, in periods: 40 frames of the paper's camera.
inline constexpr double long_residence = 40.0 / samples_per_period;

/// A residence seems one step too short on average, because it lasts from its first sample to its
/// last. Lengths are those that the paper's camera sees, and this is what they miss with another
/// step. At the camera's own step it is 0, without a rounding error.
inline double missing_length(double step, double period) {
    const double missing = step - period / samples_per_period;
    return std::fabs(missing) > 1e-6 * step ? missing : 0.0;
}

/// The time from its first sample to its last that a residence of `minimum` periods must have. It
/// is reduced by half a step, because times are rounded.
inline double least_length(double minimum, double step, double period) {
    return minimum * period - 0.5 * step - missing_length(step, period);
}

/// Lowest frame rate at which it is known which discs are resident. Averages over residences need
/// more frames (quantities.hpp).
inline constexpr double min_rate_of_resident = quantity("slip.resident").min_rates.of_frames;

/// True if the centre of disc i is less than `radii` of its radii from the wall. A layer thicker
/// than the container contains every disc.
inline bool in_wall_layer(const MFrameView& view, std::size_t i, double radii = wall_layer) {
    const Vec2 p = view.position(i);
    const double inner = view.container_radius - radii * view.radius[i];
    return !(inner > 0.0) || dot(p, p) > inner * inner;
}

class LongResidences {
  public:
    /// All samples at equal time steps.
    void sample(const MFrameView& view) {
        const double step = view.time - last_;
        if (view.size() != begin_.size() || !(step > 0.0)) {
            restart(view.size(), view.time);
        } else {
            minimum_ = least_length(long_residence, step, view.frame.period());
        }
        for (std::size_t i = 0; i < view.size(); ++i) {
            const bool inside = in_wall_layer(view, i);
            if (inside == (begin_[i] < never)) continue;
            if (inside) {
                begin_[i] = view.time;
                continue;
            }
            if (last_ - begin_[i] >= minimum_) long_begin_[i] = begin_[i], long_end_[i] = last_;
            begin_[i] = never;
        }
        last_ = view.time;
    }
    /// The discs of the next sample are not those of the last.
    void begin_tracks() { begin_.clear(); }

    bool is_known(double time) const { return !sees(time) || last_ - time >= minimum_; }
    /// The time of the last sample. For times that were not sampled, is_known() returns true.
    double last_sample() const { return last_; }
    bool resident(std::size_t disc, double time) const {
        if (!sees(time) || disc >= begin_.size()) return false;
        return begin_[disc] <= time || (long_begin_[disc] <= time && time <= long_end_[disc]);
    }

    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(first_, last_, minimum_, begin_, long_begin_, long_end_);
    }
    /// If the next sample restarts, the other columns do not matter.
    bool is_consistent() const {
        return begin_.empty() ||
               (long_begin_.size() == begin_.size() && long_end_.size() == begin_.size());
    }

  private:
    bool sees(double time) const { return first_ <= time && time <= last_; }
    void restart(std::size_t discs, double time) {
        first_ = time;
        minimum_ = never;
        for (auto* column : {&begin_, &long_begin_, &long_end_}) column->assign(discs, never);
    }

    double first_ = never, last_ = -never;  // times of the first and the last sample
    double minimum_ = never;                // length of a long residence, in units of the views
    std::vector<double> begin_;             // start of the present one; never: not in the layer
    std::vector<double> long_begin_, long_end_;  // last long one; never: none yet
};

}  // namespace swirl
