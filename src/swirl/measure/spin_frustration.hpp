// How far the discs prevent each other from spinning (paper, main text and Fig. 4b). Two discs that
// roll on each other like gears spin in opposite directions; three that touch mutually cannot all
// do so.
//
//   wall spin         ⟨|ω_i|⟩/Ω in the lab, over the discs at the wall, over the pinned ones among
//                     them (SI's criterion, pinned_loose.hpp), and over the resident discs
//                     (long_residence.hpp). 0 for a disc stuck to the wall, as the container does
//                     not turn
//   spin correlation  Σ ω_i ω_j / Σ ½ (ω_i² + ω_j²) over touching pairs: −1 for gears, 0 for
//                     independent spins, 1 for a body that turns as a whole. Over all pairs; over
//                     pairs of pinned discs; over pairs with at least one resident disc; over pairs
//                     of two resident discs, neighbours along the wall; over the pairs in a
//                     triangle (below) and over those in none, which frustration does not hinder;
//                     and over all disc–disc collisions, each weighted with its normal impulse:
//                     strong contacts
//   triangles         share of the touching pairs that have a common neighbour touching both: the
//                     contacts that are geometrically frustrated. 0 in a chain, 1 in a close
//                     packing
//   sticking          share of the collisions in which friction stopped the slip, for disc–disc
//                     and for disc–wall collisions
//
// By default only every 64th sample of the discs is used: a search for neighbours costs more than
// most measurements. Every collision counts.
//
// At the wall: gap below 0.1 r. Touching: gap below 0.1 of the mean radius. Units: none. The ratios
// are of sums over samples. Errors: from blocks of periods. Limits: missing spins (NaN) make wall
// spin and correlation NaN; without touching discs the correlations are NaN.
#pragma once

#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

#include "swirl/measure/long_residence.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/pinned_loose.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/strided.hpp"
#include "swirl/measure/touching_pairs.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

class SpinFrustration : public ReportedAverages<SpinFrustration>, public Strided {
  public:
    static auto rows(auto& s) {
        return std::tuple{
            AverageRow{quantity("frustration.wall_spin"), s.wall_spin_},
            AverageRow{quantity("frustration.pinned_wall_spin"), s.pinned_wall_spin_},
            AverageRow{quantity("frustration.resident_spin"), s.resident_spin_},
            AverageRow{quantity("frustration.spin_correlation"), s.correlation_},
            AverageRow{quantity("frustration.pinned_correlation"), s.pinned_correlation_},
            AverageRow{quantity("frustration.resident_correlation"), s.resident_correlation_},
            AverageRow{quantity("frustration.along_wall"), s.along_wall_},
            AverageRow{quantity("frustration.triangle_correlation"), s.in_triangle_},
            AverageRow{quantity("frustration.chain_correlation"), s.in_chain_},
            AverageRow{quantity("frustration.correlation_by_impulse"), s.by_impulse_},
            AverageRow{quantity("frustration.triangles"), s.triangles_},
            AverageRow{quantity("frustration.coordination"), s.coordination_},
            AverageRow{quantity("frustration.disc_sticking"), s.disc_sticking_},
            AverageRow{quantity("frustration.wall_sticking"), s.wall_sticking_}};
    }

    static constexpr bool reads_only_event = true;
    explicit SpinFrustration(double gap = 0.1, int every = 64) : Strided(every), gap_(gap) {}

    /// `pinned`: for each disc whether it is pinned; empty if that is unknown.
    void sample(const MFrameView& view, PinnedFlags pinned = {});
    void sample_residences(const LongResidences& residences);
    /// A collision, for the share that sticks and the spins of strong contacts.
    void sample_event(const Event& event, const Snapshot& after) {
        if (event.kind != EventKind::disc_disc && event.kind != EventKind::disc_wall) return;
        if (event.kind == EventKind::disc_disc)
            add_pair(by_impulse_, after.spin[event.i], after.spin[event.j],
                     std::abs(event.impulse.normal));
        BlockMean& share = event.kind == EventKind::disc_disc ? disc_sticking_ : wall_sticking_;
        share.add(event.impulse.sticks ? 1.0 : 0.0);
    }

    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(samples_);
        this->visit_averages(visit);
        visit(pending_spins_, pending_pairs_, pending_time_);
    }

    struct Spin {
        std::size_t disc;
        double spin;
    };
    struct SpinPair {
        std::size_t i, j;
        double spin_i, spin_j;
    };

  private:
    /// ω_i ω_j over ½ (ω_i² + ω_j²), as a ratio of sums.
    static void add_pair(BlockMean& correlation, double a, double b, double weight = 1.0) {
        const double square = 0.5 * (a * a + b * b);
        if (square > 0.0)
            correlation.add(a * b / square, weight * square);
        else if (!(square == square))
            correlation.add(not_available);
    }

    double gap_;
    BlockMean wall_spin_, pinned_wall_spin_, resident_spin_, correlation_, pinned_correlation_,
        resident_correlation_, along_wall_, in_triangle_, in_chain_, by_impulse_, triangles_,
        coordination_, disc_sticking_, wall_sticking_;
    TouchingPairs touching_;
    std::vector<std::vector<std::uint32_t>> neighbours_;
    // Samples of discs in the wall layer, until it is known which of them were resident then.
    std::vector<Spin> pending_spins_;
    std::vector<SpinPair> pending_pairs_;
    double pending_time_ = 0.0;
};

}  // namespace swirl
