// By how much have the discs turned about a point that moves uniformly between events, such as
// their centre of mass? The integral of ϖ_i = r × v / r² over a flight is the change of the polar
// angle of disc i, so the mean of ϖ_i over time has no error of sampling:
//
//   ∫ϖ_i dt = θ_i(end) − θ_i(begin) + 2π (number of full turns),  0 ≤ θ_i < 2π
//
// Full turns are counted side by side of the discs' paths (SweptSides in rotation_follower.hpp).
#pragma once

#include <cstddef>
#include <vector>

#include "swirl/math/unit_circle.hpp"
#include "swirl/math/vec2.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/physics/rotation_follower.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

class SweptAngles {
  public:
    bool are_followed(std::size_t discs) const { return discs > 0 && from_.size() == discs; }

    void begin(const Snapshot& s, const Vec2& point) {
        from_.resize(s.size());
        for (std::size_t i = 0; i < s.size(); ++i) from_[i] = s.position(i) - point;
        turns_ = -turns_from_ray();
        begun_at_ = s.time();
    }
    /// The mean of ϖ_i over the discs and the time since begin(); NaN for a single disc.
    double end(const Snapshot& s, const Vec2& point) {
        for (std::size_t i = 0; i < s.size(); ++i) sides().end_side(i, s.position(i) - point);
        const double turns = turns_ + turns_from_ray(), discs = static_cast<double>(from_.size());
        from_.clear();
        return discs < 2.0 ? not_available : 2.0 * pi * turns / discs / (s.time() - begun_at_);
    }

    /// For whoever follows the sides from event to event.
    SweptSides sides() { return {from_.empty() ? nullptr : from_.data(), &turns_}; }

    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(from_, turns_, begun_at_);
    }

  private:
    double turns_from_ray() const {
        double sum = 0.0;
        for (const Vec2& r : from_) {
            const double turns = turns_of(r);
            sum += r.y < 0.0 && turns == 0.0 ? 1.0 : turns;  // rounded from just below 1
        }
        return sum;
    }

    std::vector<Vec2> from_;  // directions to the discs at the last corner; empty: not followed
    double turns_ = 0.0;      // full turns since begin(), less the angles then
    double begun_at_ = 0.0;
};

}  // namespace swirl
