// How well the cluster rolls on the wall: the slip parameter of the paper's main text (Fig. 4a),
// and the line of a pancake that rolls without slipping (Fig. 1b).
//
//   s = (|ϖ_M|/Ω) (P_cluster / P_container)     0: slips freely, 1: rolls without slipping
//
//   P_cluster    perimeter of the convex hull of the discs' centres, plus 2π r: the tightest band
//                around the cluster. For a mixture, r is the mean radius
//   P_container  2π R
//   ϖ_M          cluster: the mean of ϖ_i − Ω over all discs. Pinned region: the mean over the
//                pinned discs by the SI's criterion (pinned_loose.hpp). Resident: the mean over the
//                discs on a long residence in the layer at the wall (long_residence.hpp), which
//                excludes discs that only fly along the wall. All three are about the centre of
//                mass and with the perimeter of the whole cluster, since the whole cluster rolls
//
// The average is that of the product, over samples. −ϖ_M stands for |ϖ_M|, so that noise about zero
// does not add up (ϖ_M is negative wherever the wall drives).
//
//   pancake line: a single body with the cluster's perimeter and s = 1,
//   ϖ/Ω = 1 − P_container/P_cluster
//
// By default only every 64th sample is used: the hull costs more than most measurements, and the
// cluster changes little between two samples.
//
// Units: none. Errors: from blocks of periods. Limits: one disc does not rotate about itself; its
// sample does not count, and the mean is NaN if there was no other. A sample without a pinned
// (resident) disc does not count for that mean. A disc closer to the centre of mass than its own
// radius is omitted: there ϖ_i has no finite variance.
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "swirl/measure/convex_hull.hpp"
#include "swirl/measure/long_residence.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/pinned_loose.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/strided.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

/// ϖ/Ω of a rigid body with this perimeter that rolls on the container's wall without slipping.
inline double pancake_rotation(double cluster_perimeter, double container_perimeter) {
    return 1.0 - container_perimeter / cluster_perimeter;
}

class Slip : public ReportedAverages<Slip>, public Strided {
  public:
    static auto rows(auto& s) {
        return std::tuple{AverageRow{quantity("slip.cluster"), s.cluster_},
                          AverageRow{quantity("slip.pinned_region"), s.pinned_},
                          AverageRow{quantity("slip.resident"), s.resident_},
                          AverageRow{quantity("slip.cluster_perimeter"), s.perimeter_},
                          AverageRow{quantity("slip.pancake"), s.pancake_}};
    }

    explicit Slip(int every = 64) : Strided(every) {}

    /// `pinned`: for each disc whether it is pinned; empty if that is unknown.
    void sample(const MFrameView& view, PinnedFlags pinned = {});
    void sample_residences(const LongResidences& residences);

    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(samples_);
        this->visit_averages(visit);
        visit(pending_, pending_time_, pending_factor_, pending_omega_);
    }

    struct Rate {
        std::size_t disc;
        double varpi;
    };

  private:
    BlockMean cluster_, pinned_, resident_, perimeter_, pancake_;
    std::vector<Vec2> centres_;
    // Rates of the discs in the wall layer, until it is known which of them were resident then.
    std::vector<Rate> pending_;
    double pending_time_ = 0.0, pending_factor_ = 0.0, pending_omega_ = 0.0;
};

/// P_cluster of one snapshot; NaN without discs.
double cluster_perimeter(const MFrameView& view);

}  // namespace swirl
