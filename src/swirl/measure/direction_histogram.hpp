// The distribution over θ of the positions at which something happens. A mean direction
// (circular_mean.hpp) cannot show two maxima.
//
// Units: shares of all positions in equal slices of θ, which add up to 1. Limits: without positions
// the shares are NaN. The null vector has no direction and is not counted.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "swirl/math/unit_circle.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/statistics/circular_mean.hpp"

namespace swirl {

class DirectionHistogram {
  public:
    static constexpr std::size_t slices = 36;

    void add(const Vec2& position) {
        if (!(dot(position, position) > 0.0)) return;
        const auto slice = static_cast<std::size_t>(turns_of(position) * slices);
        counts_[std::min(slice, slices - 1)] += 1.0;
    }
    double share(std::size_t slice) const {
        double all = 0.0;
        for (const double count : counts_) all += count;
        return counts_[slice] / all;
    }
    void merge(const DirectionHistogram& other) {
        for (std::size_t k = 0; k < slices; ++k) counts_[k] += other.counts_[k];
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(std::span(counts_));
    }

  private:
    std::vector<double> counts_ = std::vector<double>(slices);
};

/// The table of the positions where discs pin and depin.
inline ReportTable positions_table(const char* description, const DirectionHistogram& pinned,
                                   const DirectionHistogram& free) {
    ReportTable table{"positions",
                      description,
                      {{quantity("positions.theta")},
                       {quantity("positions.pinning")},
                       {quantity("positions.depinning")}}};
    for (std::size_t k = 0; k < DirectionHistogram::slices; ++k)
        table.add(360.0 * (static_cast<double>(k) + 0.5) / DirectionHistogram::slices,
                  pinned.share(k), free.share(k));
    return table;
}

/// The row of a mean direction.
inline ReportRow direction_row(const Quantity& quantity, const CircularMean& mean) {
    return {quantity,
            scaled(mean.angle(), degrees_per_radian),
            {{"concentration", "1", mean.concentration()}, {"count", "1", mean.count()}}};
}

}  // namespace swirl
