// The average over discs and samples of something that each disc has: over all of them, over the
// pinned ones by the SI's criterion (pinned_loose.hpp), and over those on a long stay in the wall
// layer (long_residence.hpp). Every disc that has a value counts the same. Who is on a long stay is
// known later than the next sample of it; a sample that comes before that does not count there.
//
// Units: those of the value. Error from blocks of periods. Limits: a disc whose value is not known
// (NaN) is left out; without any the mean is NaN.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "swirl/measure/long_residence.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

class AllAndPinned {
  public:
    /// After every sample of the discs: who is on a long stay.
    void sample_residences(const LongResidences& residences) {
        if (held_.empty() || !residences.knows(held_at_)) return;
        for (std::size_t i = 0; i < held_.size(); ++i)
            if (held_[i] == held_[i] && residences.pinned(i, held_at_))
                on_residences_.add(held_[i]);
        held_.clear();
    }
    void close_block() {
        for (BlockMean* mean : {&all_, &pinned_, &on_residences_}) mean->close_block();
    }
    Estimate all() const { return all_.estimate(); }
    Estimate pinned() const { return pinned_.estimate(); }
    Estimate on_residences() const { return on_residences_.estimate(); }

    void merge(const AllAndPinned& other) {
        all_.merge(other.all_);
        pinned_.merge(other.pinned_);
        on_residences_.merge(other.on_residences_);
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        for (BlockMean* mean : {&all_, &pinned_, &on_residences_}) visit(*mean);
        visit(held_);
        visit(held_at_);
    }

  protected:
    /// The value of each disc, NaN where it is not known. `pinned`: whether it is pinned; empty
    /// where that is not known.
    template <class ValueOf>
    void add(const MFrameView& view, std::span<const std::uint8_t> pinned, ValueOf&& value_of) {
        const bool hold = held_.empty();
        for (std::size_t i = 0; i < view.size(); ++i) {
            const double value = value_of(i);
            if (hold) held_.push_back(value);
            if (!(value == value)) continue;
            all_.add(value);
            if (i < pinned.size() && pinned[i] != 0) pinned_.add(value);
        }
        if (hold) held_at_ = view.time;
    }

  private:
    BlockMean all_, pinned_, on_residences_;
    std::vector<double> held_;  // of each disc, until it is known who was on a long stay then
    double held_at_ = 0.0;
};

}  // namespace swirl
