// How well the cluster rolls on the wall: the slip parameter of the paper's main text (Fig. 4a),
// and the line of a pancake that rolls without slipping (Fig. 1b).
//
//   s = (|ϖ_M|/Ω) (P_cluster / P_container)     0: slips freely, 1: rolls without slipping
//
//   P_cluster    perimeter of the convex hull of the discs' centres, plus 2π r: the tightest band
//                round the cluster. With discs of several sizes r is their mean radius
//   P_container  2π R
//   ϖ_M          for the whole cluster the mean of ϖ_i − Ω over all discs; for the pinned region
//                the mean over the pinned discs by the SI's criterion (pinned_loose.hpp), about
//                the centre of mass and with the perimeter of the whole cluster, which is what
//                rolls; for stays the same over the discs on a long stay in the layer at the wall
//                (long_residence.hpp): those that only fly along the wall are held by nothing
//
// The average is that of the product, over samples; −ϖ_M stands for |ϖ_M|, so that noise about zero
// does not add up (ϖ_M is negative wherever the wall drives).
//
//   pancake line: a single body with the cluster's perimeter, s = 1,
//   ϖ/Ω = 1 − P_container/P_cluster
//
// Only every 64th sample is used, unless told otherwise: the hull costs more than most
// measurements, and the cluster changes little between two frames of a camera.
//
// Units: none. Error from blocks of periods. Limits: one disc has no rotation about itself (NaN is
// not averaged: the mean stays NaN if there was nothing else); nobody pinned, or on
// a stay: that sample does not count for it. A disc nearer to the centre of mass than
// its own radius is left out: there ϖ_i has no finite variance.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "swirl/measure/convex_hull.hpp"
#include "swirl/measure/long_residence.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

/// ϖ/Ω of a rigid body with this perimeter that rolls on the container's wall without slipping.
inline double pancake_rotation(double cluster_perimeter, double container_perimeter) {
    return 1.0 - container_perimeter / cluster_perimeter;
}

class Slip {
  public:
    explicit Slip(int every = 64) : every_(every) {}

    /// `pinned`: for each disc whether it is pinned; empty where that is not known.
    void sample(const MFrameView& view, std::span<const std::uint8_t> pinned = {});
    /// After every sample of the discs, used or not: who is on a long stay.
    void sample_residences(const LongResidences& residences);
    void close_block() {
        for (BlockMean* mean : {&cluster_, &pinned_, &residences_, &perimeter_, &pancake_})
            mean->close_block();
    }

    Estimate cluster() const { return cluster_.estimate(); }
    Estimate pinned_region() const { return pinned_.estimate(); }
    Estimate on_residences() const { return residences_.estimate(); }
    /// P_cluster, in units of the snapshot's length.
    Estimate cluster_perimeter() const { return perimeter_.estimate(); }
    /// ϖ/Ω of the pancake with the cluster's momentary perimeter, averaged.
    Estimate pancake() const { return pancake_.estimate(); }

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(ReportRow{"cluster", "1", "slip parameter s of all discs", cluster()});
        visit(ReportRow{"pinned_region", "1", "slip parameter s of the pinned discs",
                        pinned_region()});
        visit(ReportRow{"stays", "1", "slip parameter s of the discs on a stay at the wall",
                        on_residences()});
        visit(ReportRow{"cluster_perimeter", "r", "perimeter of the cluster", cluster_perimeter()});
        visit(ReportRow{"pancake", "Ω",
                        "rotation of a pancake of that perimeter that does not slip", pancake()});
    }
    void merge(const Slip& other) {
        cluster_.merge(other.cluster_);
        pinned_.merge(other.pinned_);
        residences_.merge(other.residences_);
        perimeter_.merge(other.perimeter_);
        pancake_.merge(other.pancake_);
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(samples_);
        for (BlockMean* mean : {&cluster_, &pinned_, &residences_, &perimeter_, &pancake_})
            visit(*mean);
        visit(held_);
        for (double* value : {&held_at_, &held_factor_, &held_omega_}) visit(*value);
    }

    struct Rate {
        std::size_t disc;
        double varpi;
    };

  private:
    int every_;
    std::int64_t samples_ = 0;
    BlockMean cluster_, pinned_, residences_, perimeter_, pancake_;
    std::vector<Vec2> centres_;
    // Of the discs in the wall layer at a moment, until it is known which were on a long stay then.
    std::vector<Rate> held_;
    double held_at_ = 0.0, held_factor_ = 0.0, held_omega_ = 0.0;
};

/// P_cluster of one snapshot; NaN without discs.
double cluster_perimeter(const MFrameView& view);

}  // namespace swirl
