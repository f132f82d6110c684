// The average over discs and samples of something that each disc has: over all of them, and over
// the pinned ones (pinned_loose.hpp). Every disc that has a value counts the same.
//
// Units: those of the value. Error from blocks of periods. Limits: a disc whose value is not known
// (NaN) is left out; without any the mean is NaN.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "swirl/measure/statistics.hpp"

namespace swirl {

class AllAndPinned {
  public:
    void close_block() {
        all_.close_block();
        pinned_.close_block();
    }
    Estimate all() const { return all_.estimate(); }
    Estimate pinned() const { return pinned_.estimate(); }

    void merge(const AllAndPinned& other) {
        all_.merge(other.all_);
        pinned_.merge(other.pinned_);
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        all_.fields(visit);
        pinned_.fields(visit);
    }

  protected:
    /// `pinned`: for each disc whether it is pinned; empty where that is not known.
    void add(double value, std::size_t disc, std::span<const std::uint8_t> pinned) {
        if (!(value == value)) return;
        all_.add(value);
        if (disc < pinned.size() && pinned[disc] != 0) pinned_.add(value);
    }

  private:
    BlockMean all_, pinned_;
};

}  // namespace swirl
