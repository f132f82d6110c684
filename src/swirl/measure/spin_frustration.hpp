// How far the discs keep each other from spinning (paper, main text and Fig. 4b). Two discs that
// roll on each other like gears spin in opposite senses; three that touch mutually cannot all do
// so.
//
//   wall spin         ⟨|ω_i|⟩/Ω in the lab, over the discs at the wall, over those of them that
//                     are pinned by the SI's criterion (pinned_loose.hpp), and over those on a long
//                     stay in the wall's layer (long_residence.hpp): 0 for a disc stuck to the
//                     wall, as the container does not turn
//   spin correlation  Σ ω_i ω_j / Σ ½ (ω_i² + ω_j²) over touching pairs: −1 for gears, 0 for
//                     independent spins, 1 for a body that turns as a whole; the same over touching
//                     pairs of pinned discs; over pairs of a disc on a long stay and any that it
//                     touches; over those of them that are both on one, neighbours along the wall;
//                     and over all
//                     disc–disc collisions, each counted with its normal impulse: strong contacts
//   triangles         share of the touching pairs that have a common neighbour touching both: the
//                     contacts that are geometrically frustrated. 0 in a chain, 1 in a close
//                     packing
//   sticking          share of the collisions in which friction stopped the slip, for disc–disc
//                     and for disc–wall separately (needs the collisions themselves)
//
// Only every 64th sample of the discs is used, unless told otherwise: a search for neighbours
// costs more than most measurements. Every collision counts.
//
// At the wall: gap below 0.1 r. Touching: gap below 0.1 of the mean radius. Units: none. The ratios
// are of sums over samples; errors from blocks of periods. Limits: missing spins (NaN) make wall
// spin and correlation NaN; nobody touching: NaN.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "swirl/measure/long_residence.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/touching_pairs.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

class SpinFrustration {
  public:
    explicit SpinFrustration(double gap = 0.1, int every = 64) : gap_(gap), every_(every) {}

    /// `pinned`: for each disc whether it is pinned; empty where that is not known.
    void sample(const MFrameView& view, std::span<const std::uint8_t> pinned = {});
    /// A collision, for the share that sticks and the spins of strong contacts.
    void sample(const Event& event, const Snapshot& after) {
        if (event.kind != EventKind::disc_disc && event.kind != EventKind::disc_wall) return;
        if (event.kind == EventKind::disc_disc)
            add_pair(by_impulse_, after.spin[event.i], after.spin[event.j],
                     std::abs(event.impulse.normal));
        BlockMean& share = event.kind == EventKind::disc_disc ? disc_sticking_ : wall_sticking_;
        share.add(event.impulse.sticks ? 1.0 : 0.0);
    }
    /// After every sample of the discs, used or not: who is on a long stay.
    void sample_residences(const LongResidences& residences);
    void close_block() {
        for (BlockMean* mean : means()) mean->close_block();
    }

    Estimate wall_spin() const { return wall_spin_.estimate(); }
    Estimate pinned_wall_spin() const { return pinned_wall_spin_.estimate(); }
    Estimate correlation() const { return correlation_.estimate(); }
    Estimate pinned_correlation() const { return pinned_correlation_.estimate(); }
    Estimate residence_spin() const { return residence_spin_.estimate(); }
    Estimate residence_correlation() const { return residence_correlation_.estimate(); }
    Estimate along_wall() const { return along_wall_.estimate(); }
    Estimate correlation_by_impulse() const { return by_impulse_.estimate(); }
    Estimate triangles() const { return triangles_.estimate(); }
    Estimate disc_sticking() const { return disc_sticking_.estimate(); }
    Estimate wall_sticking() const { return wall_sticking_.estimate(); }
    /// Touching neighbours of a disc, on average.
    Estimate coordination() const { return coordination_.estimate(); }

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(
            ReportRow{"wall_spin", "Ω", "size of the spin of the discs at the wall", wall_spin()});
        visit(ReportRow{"pinned_wall_spin", "Ω", "size of the spin of the pinned discs at the wall",
                        pinned_wall_spin()});
        visit(ReportRow{"stay_spin", "Ω", "size of the spin of the discs on a stay at the wall",
                        residence_spin()});
        visit(ReportRow{"spin_correlation", "1", "of touching discs: −1 for gears", correlation()});
        visit(ReportRow{"pinned_correlation", "1", "the same of touching discs that are pinned",
                        pinned_correlation()});
        visit(ReportRow{"stay_correlation", "1",
                        "the same of a disc on a stay at the wall and any that it touches",
                        residence_correlation()});
        visit(ReportRow{"along_wall", "1", "the same of touching discs that are both on a stay",
                        along_wall()});
        visit(ReportRow{"correlation_by_impulse", "1",
                        "the same over collisions, each counted with its normal impulse",
                        correlation_by_impulse()});
        visit(ReportRow{"triangles", "1", "share of the touching pairs with a common neighbour",
                        triangles()});
        visit(ReportRow{"coordination", "1", "touching neighbours of a disc", coordination()});
        visit(ReportRow{"disc_sticking", "1",
                        "share of the disc–disc collisions that stop the slip", disc_sticking()});
        visit(ReportRow{"wall_sticking", "1",
                        "share of the disc–wall collisions that stop the slip", wall_sticking()});
    }
    void merge(const SpinFrustration& other) {
        wall_spin_.merge(other.wall_spin_);
        pinned_wall_spin_.merge(other.pinned_wall_spin_);
        residence_spin_.merge(other.residence_spin_);
        correlation_.merge(other.correlation_);
        pinned_correlation_.merge(other.pinned_correlation_);
        residence_correlation_.merge(other.residence_correlation_);
        along_wall_.merge(other.along_wall_);
        by_impulse_.merge(other.by_impulse_);
        triangles_.merge(other.triangles_);
        coordination_.merge(other.coordination_);
        disc_sticking_.merge(other.disc_sticking_);
        wall_sticking_.merge(other.wall_sticking_);
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(samples_);
        for (BlockMean* mean : means()) visit(*mean);
        visit(held_spins_);
        visit(held_pairs_);
        visit(held_at_);
    }

    struct Spin {
        std::size_t disc;
        double spin;
    };
    struct Spins {
        std::size_t i, j;
        double a, b;
    };

  private:
    std::vector<BlockMean*> means() {
        return {&wall_spin_,          &pinned_wall_spin_,      &residence_spin_, &correlation_,
                &pinned_correlation_, &residence_correlation_, &along_wall_,     &by_impulse_,
                &triangles_,          &coordination_,          &disc_sticking_,  &wall_sticking_};
    }
    /// ω_i ω_j over ½ (ω_i² + ω_j²), as a ratio of sums.
    static void add_pair(BlockMean& correlation, double a, double b, double weight = 1.0) {
        const double square = 0.5 * (a * a + b * b);
        if (square > 0.0)
            correlation.add(a * b / square, weight * square);
        else if (!(square == square))
            correlation.add(not_available);
    }

    double gap_;
    int every_;
    std::int64_t samples_ = 0;
    BlockMean wall_spin_, pinned_wall_spin_, residence_spin_, correlation_, triangles_,
        coordination_;
    BlockMean pinned_correlation_, residence_correlation_, along_wall_, by_impulse_, disc_sticking_,
        wall_sticking_;
    TouchingPairs touching_;
    std::vector<std::vector<std::uint32_t>> neighbours_;
    // Of the discs in the wall layer at a moment, until it is known which were on a long stay then.
    std::vector<Spin> held_spins_;
    std::vector<Spins> held_pairs_;
    double held_at_ = 0.0;
};

}  // namespace swirl
