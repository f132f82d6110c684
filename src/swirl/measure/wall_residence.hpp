// How long discs reside at the wall, and where in the M-frame such residences begin and end: the
// pinned region without a criterion on the direction of flight.
//
// The SI's criterion for "pinned" (pinned_loose.hpp) asks whether a disc flies along the wall, not
// whether it is near it. So discs that fly parallel to the wall far inside count as pinned. The
// positions where they depin have two maxima, and the mean position moves with N as the
// weights of the two do. Here:
//
//   layer            r > R − 1.5 a: the centre is within one and a half of the disc's radii of the
//                    wall, its rim within half a radius (the second layer's centres are 1.7 or more
//                    radii further in)
//   residence        consecutive samples in which a disc is in the layer
//   pinned           the disc is on a residence that lasts at least 40/511 of a period; all of it
//                    counts, from its first sample on
//   becoming pinned  where such a residence begins
//   becoming free    where it ends
//
//   length           from the first sample of a residence to its last, as the paper's camera would
//                    see it (long_residence.hpp). The average is over the
//                    pinned residences that have ended, also those of which the beginning was not
//                    seen. The table `lengths` has the distribution of all residences of which it
//                    was seen, also of the shorter ones
//
// Both thresholds are arbitrary. The table `sensitivity` has the averages for layers of 1.3, 1.5
// and 1.7 radii and minimum lengths of 20, 40 and 80 samples; `positions` has the distribution of
// the angles.
//
// Units: radians inside, degrees in the report; lengths of residences in periods. Normalisation:
// the share is that of all discs and samples; positions are those of all residences. Errors: from
// blocks of periods. Limits: a residence that had begun before the first sample has no known
// beginning, and its length is what was seen of it. One that has not ended does not count, so a
// run should be much longer than a residence. If the times of samples do not ascend, or the
// number of discs changes, all residences restart.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "swirl/measure/cell_averages.hpp"
#include "swirl/measure/direction_histogram.hpp"
#include "swirl/measure/long_residence.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/statistics/block_average.hpp"
#include "swirl/statistics/circular_mean.hpp"

namespace swirl {

class WallResidences {
  public:
    static constexpr double min_frames_per_period = min_rate_of_resident;
    static constexpr std::array layers{1.3, wall_layer, 1.7};  // radii between centre and wall
    static constexpr std::array minimum{0.5 * long_residence, long_residence,
                                        2.0 * long_residence};  // periods
    static constexpr std::size_t standard = 1;                  // index into both

    /// All samples at equal time steps.
    void sample(const MFrameView& view);
    void close_block();

    const CircularMean& pinning(std::size_t layer = standard,
                                std::size_t duration = standard) const {
        return averages_[layer][duration].begin;
    }
    const CircularMean& depinning(std::size_t layer = standard,
                                  std::size_t duration = standard) const {
        return averages_[layer][duration].end;
    }
    /// The share of the discs that is pinned.
    Estimate share(std::size_t layer = standard, std::size_t duration = standard) const {
        return averages_[layer][duration].share.estimate();
    }
    /// The mean duration of the residences that have ended, in periods.
    Estimate length() const { return length_.estimate(); }
    /// The lengths of residences in this many bins; the last also has all longer ones.
    static constexpr std::size_t length_bins = 41;
    static constexpr double length_bin = 0.05;  // periods
    /// The share of the residences with a length in the bin.
    Estimate length_share(std::size_t bin) const { return lengths_.estimate(bin); }

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(direction_row(quantity("residence.pinning"), pinning()));
        visit(direction_row(quantity("residence.depinning"), depinning()));
        visit(ReportRow{quantity("residence.share"), share()});
        visit(ReportRow{quantity("residence.length"), length()});
        ReportTable sensitivity{
            "sensitivity",
            "these quantities for other layers and minimum lengths of a residence",
            {{quantity("residence.sensitivity.layer")},
             {quantity("residence.sensitivity.min_length")},
             {quantity("residence.sensitivity.pinning"), with_error_column},
             {quantity("residence.sensitivity.pinned_concentration")},
             {quantity("residence.sensitivity.depinning"), with_error_column},
             {quantity("residence.sensitivity.free_concentration")},
             {quantity("residence.sensitivity.share"), with_error_column}}};
        for (std::size_t l = 0; l < layers.size(); ++l)
            for (std::size_t d = 0; d < minimum.size(); ++d) {
                const Averages& a = averages_[l][d];
                sensitivity.add(layers[l], minimum[d], scaled(a.begin.angle(), degrees_per_radian),
                                a.begin.concentration(), scaled(a.end.angle(), degrees_per_radian),
                                a.end.concentration(), a.share.estimate());
            }
        visit(std::move(sensitivity));
        ReportTable lengths{"lengths",
                            "distribution of the lengths of all residences; the last row also "
                            "counts longer ones",
                            {{quantity("residence.lengths.from")},
                             {quantity("residence.lengths.to")},
                             {quantity("residence.lengths.share"), with_error_column}}};
        for (std::size_t bin = 0; bin < length_bins; ++bin) {
            const double from = static_cast<double>(bin) * length_bin;
            lengths.add(from, bin + 1 < length_bins ? from + length_bin : not_available,
                        length_share(bin));
        }
        visit(std::move(lengths));
        visit(positions_table("distribution over θ of pinning and depinning", begins_, ends_));
    }
    void merge(const WallResidences& other);
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(last_time_, discs_, residences_);
        for (auto& layer : averages_)
            for (Averages& a : layer) visit(a);
        visit(length_, lengths_, begins_, ends_);
    }
    bool is_consistent() const {
        return residences_.size() % layers.size() == 0 &&
               residences_.size() / layers.size() == discs_;
    }

    /// Of one disc in one layer.
    struct Residence {
        double samples = 0.0;  // so far; 0: not in the layer
        double begin_time = 0.0, knows_begin = 0.0;
        Vec2 begin{}, last{};
    };

  private:
    /// For one layer and one minimum length.
    struct Averages : BlockAverages<Averages> {
        static auto averages(auto& s) { return std::tie(s.begin, s.end, s.share); }
        template <class Visitor>
        void fields(Visitor&& visit) {
            this->visit_averages(visit);
        }

        CircularMean begin, end;
        BlockMean share;
    };
    void end(std::size_t layer, const Residence& residence, double period);

    double last_time_ = 0.0;
    std::size_t discs_ = 0;
    std::vector<Residence> residences_;  // one per disc, layer by layer
    std::array<std::array<Averages, minimum.size()>, layers.size()> averages_;
    BlockMean length_;
    CellRates lengths_{length_bins};
    DirectionHistogram begins_, ends_;
};

}  // namespace swirl
