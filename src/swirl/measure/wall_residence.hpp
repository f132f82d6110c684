// How long discs stay at the wall, and where in the M-frame such stays begin and end: the pinned
// region without a criterion on the direction of flight.
//
// The SI's criterion for "pinned" (pinned_loose.hpp) asks whether a disc flies along the wall, not
// whether it is near it, so discs that fly parallel to the wall far inside count as pinned, the
// places where they become free have two maxima, and the mean of those places moves with N as the
// weights of the two do. Here:
//
//   layer            r > R − 1.5 a: the centre is within one and a half of the disc's radii of the
//                    wall, its rim within half a radius (the second layer's centres are 1.7 or more
//                    further in)
//   stay             all samples in a row in which a disc is in the layer
//   pinned           the disc is on a stay that lasts at least 40/511 of a period, all of it, from
//                    its first sample on
//   becoming pinned  where such a stay begins
//   becoming free    where it ends
//
// Both thresholds are arbitrary; the table `sensitivity` has what becomes of the averages with
// 1.3, 1.5, 1.7 and 20, 40, 80, and `places` how the angles are distributed.
//
// Units: radians inside, degrees in the report; lengths of stays in periods. Normalisation: the
// share is that of all discs and samples; places are those of all stays. Errors from blocks of
// periods. Limits: a stay that was under way when the samples began has no known beginning, and its
// length is what has been seen of it. Samples whose times do not ascend, or a change of the number
// of discs, begin anew.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "swirl/measure/cell_averages.hpp"
#include "swirl/measure/direction_histogram.hpp"
#include "swirl/measure/long_residence.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/statistics/block_average.hpp"
#include "swirl/statistics/circular_mean.hpp"

namespace swirl {

class WallResidences {
  public:
    static constexpr std::array layers{1.3, wall_layer, 1.7};  // radii between centre and wall
    static constexpr std::array minimum{0.5 * long_residence, long_residence,
                                        2.0 * long_residence};  // periods
    static constexpr std::size_t standard = 1;                  // of both

    /// All samples at equal steps of time.
    void sample(const MFrameView& view);
    void close_block();

    const CircularMean& becoming_pinned(std::size_t layer = standard,
                                        std::size_t duration = standard) const {
        return kinds_[layer][duration].begin;
    }
    const CircularMean& becoming_free(std::size_t layer = standard,
                                      std::size_t duration = standard) const {
        return kinds_[layer][duration].end;
    }
    /// The share of the discs that is pinned.
    Estimate share(std::size_t layer = standard, std::size_t duration = standard) const {
        return kinds_[layer][duration].share.estimate();
    }
    /// Of the stays that have ended, in periods.
    Estimate length() const { return length_.estimate(); }

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(
            row_of("becoming_pinned", "θ where stays in the wall layer begin", becoming_pinned()));
        visit(row_of("becoming_free", "θ where they end", becoming_free()));
        visit(ReportRow{"share", "1", "share of the discs that is on such a stay", share()});
        visit(ReportRow{"length", "T", "of a stay, in swirls", length()});
        ReportTable sensitivity{"sensitivity",
                                "the same for other thresholds: layer and least length of a stay",
                                {{"layer", "r"},
                                 {"least_length", "T"},
                                 {"becoming_pinned", "°"},
                                 {"becoming_pinned_error", "°"},
                                 {"pinned_concentration", "1"},
                                 {"becoming_free", "°"},
                                 {"becoming_free_error", "°"},
                                 {"free_concentration", "1"},
                                 {"share", "1"},
                                 {"share_error", "1"}}};
        for (std::size_t l = 0; l < layers.size(); ++l)
            for (std::size_t d = 0; d < minimum.size(); ++d) {
                const Kind& kind = kinds_[l][d];
                const Estimate pinned = scaled(kind.begin.angle(), degrees_per_radian),
                               free = scaled(kind.end.angle(), degrees_per_radian),
                               held = kind.share.estimate();
                sensitivity.add({layers[l], minimum[d], pinned.mean, pinned.error,
                                 kind.begin.concentration(), free.mean, free.error,
                                 kind.end.concentration(), held.mean, held.error});
            }
        visit(std::move(sensitivity));
        visit(table_of("how the places of becoming pinned and free are distributed over θ", begins_,
                       ends_));
    }
    void merge(const WallResidences& other);
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(last_time_);
        visit(discs_);
        visit(residences_);
        for (auto& layer : kinds_)
            for (Kind& kind : layer) {
                visit(kind.begin);
                visit(kind.end);
                visit(kind.share);
            }
        visit(length_);
        for (DirectionHistogram* places : {&begins_, &ends_}) visit(*places);
    }
    bool is_consistent() const {
        return residences_.size() % layers.size() == 0 &&
               residences_.size() / layers.size() == discs_;
    }

    /// Of one disc in one layer.
    struct Residence {
        double samples = 0.0;  // so far; 0: it is not there
        double begin_time = 0.0, knows_begin = 0.0;
        Vec2 begin{}, last{};
    };

  private:
    struct Kind {
        CircularMean begin, end;
        BlockMean share;
    };
    void end(std::size_t layer, const Residence& residence, double period);

    double last_time_ = 0.0;
    std::size_t discs_ = 0;
    std::vector<Residence> residences_;  // of every disc, layer by layer
    std::array<std::array<Kind, minimum.size()>, layers.size()> kinds_;
    BlockMean length_;
    DirectionHistogram begins_, ends_;
};

}  // namespace swirl
