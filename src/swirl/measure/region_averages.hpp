// The average over discs and samples of a value that each disc has, in three regions: all discs,
// the pinned ones by the SI's criterion (pinned_loose.hpp), and the resident ones, which are on a
// long residence in the wall layer (long_residence.hpp). Every disc that has a value counts the
// same.
//
// Which discs were resident is known only some samples later. Samples that come before that do not
// count for the resident ones.
//
// Units: those of the value. Errors: from blocks of periods. Limits: a disc whose value is NaN is
// omitted; without any value the mean is NaN.
#pragma once

#include <cstddef>
#include <tuple>
#include <vector>

#include "swirl/measure/long_residence.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/pinned_loose.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

class RegionAverages : public BlockAverages<RegionAverages> {
  public:
    static auto averages(auto& s) { return std::tie(s.all_, s.pinned_, s.resident_); }

    void sample_residences(const LongResidences& residences) {
        if (pending_.empty() || !residences.is_known(pending_time_)) return;
        for (std::size_t i = 0; i < pending_.size(); ++i)
            if (pending_[i] == pending_[i] && residences.resident(i, pending_time_))
                resident_.add(pending_[i]);
        pending_.clear();
    }
    Estimate all() const { return all_.estimate(); }
    Estimate pinned() const { return pinned_.estimate(); }
    Estimate resident() const { return resident_.estimate(); }

    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(all_, pinned_, resident_, pending_, pending_time_);
    }

  protected:
    /// `value_of(i)` is the value of disc i, NaN if it has none. `pinned` is empty if it is not
    /// known which discs are pinned.
    template <class ValueOf>
    void add(const MFrameView& view, PinnedFlags pinned, ValueOf&& value_of) {
        const bool nothing_pending = pending_.empty();
        for (std::size_t i = 0; i < view.size(); ++i) {
            const double value = value_of(i);
            if (nothing_pending) pending_.push_back(value);
            if (!(value == value)) continue;
            all_.add(value);
            if (is_pinned(pinned, i)) pinned_.add(value);
        }
        if (nothing_pending) pending_time_ = view.time;
    }

  private:
    BlockMean all_, pinned_, resident_;
    std::vector<double> pending_;  // values of all discs until it is known which were resident
    double pending_time_ = 0.0;
};

}  // namespace swirl
