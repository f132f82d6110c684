// How spheres on a floor roll, how much they slide on it, and how far they prevent each other from
// rolling (floor.hpp, collision_law.hpp).
//
// At every 7th sample:
//
//   rolling share     the share of the spheres that do not slip on the floor (they roll, or rest on
//                     it); also among those at the wall, whose gap to it is below 0.1 R
//   floor slip        ⟨|c|⟩, c = v − u − R ω × ẑ
//   axis correlation  Σ ω_i·ω_j / Σ ½ (ω_i² + ω_j²) of the horizontal spins, over touching pairs: 1
//                     where the spins of neighbours are equal
//   contact rolling   the same for h = ω_x n_y − ω_y n_x, the rolling along the line of centres. It
//                     is −1 for two spheres that roll on each other without slip. It is 1 where
//                     both roll the same way and their surfaces slip with the sum of their speeds;
//                     spheres that roll together over a floor have 1. That is the frustration: the
//                     floor requires 1, the contact −1, and both at once are impossible
//
// At every collision, between spheres and at the wall:
//
//   vertical share     Σ J_z² / Σ (J_t² + J_z²): the vertical part of the impulses of friction
//   vertical friction  Σ |J_z| / Σ J_n: at most μ
//   vertical power     the energy that the vertical components of friction alone dissipate, per
//                      sphere and time, −J_z (s_z + s'_z)/2, including the energy that lifts a
//                      sphere
//
// Touching: gap below 0.1 of the mean radius. Units as stated. Errors: from blocks of periods.
// Limits: NaN for discs, which do not roll; without a floor every sphere slips, and c has no
// meaning. Recorded frames give all results except those that need collisions.
#pragma once

#include <cmath>
#include <cstdint>
#include <tuple>

#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/strided.hpp"
#include "swirl/measure/touching_pairs.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

class Rolling : public ReportedAverages<Rolling>, public Strided {
  public:
    static constexpr bool any_path = true, reads_only_event = true;

    static auto rows(auto& s) {
        return std::tuple{AverageRow{quantity("rolling.rolling_share"), s.rolls_},
                          AverageRow{quantity("rolling.wall_rolling_share"), s.rolls_at_wall_},
                          AverageRow{quantity("rolling.floor_slip"), s.slip_},
                          AverageRow{quantity("rolling.axis_correlation"), s.axes_},
                          AverageRow{quantity("rolling.contact_correlation"), s.contacts_}};
    }

    explicit Rolling(double gap = 0.1, int every = 7) : Strided(every), gap_(gap) {}

    void sample_in_lab(const Snapshot& lab);
    void sample_event(const Event& event, const Snapshot& after);
    /// `duration`: the time in which the events since the last call happened.
    void close_event_block(double duration, std::size_t spheres);

    template <class Visitor>
    void report(Visitor&& visit) const {
        ReportedAverages::report(visit);
        visit(ReportRow{quantity("rolling.vertical_share"), between_.share.estimate()});
        visit(ReportRow{quantity("rolling.vertical_share_at_wall"), at_wall_.share.estimate()});
        visit(ReportRow{quantity("rolling.vertical_friction"), between_.friction.estimate()});
        visit(
            ReportRow{quantity("rolling.vertical_friction_at_wall"), at_wall_.friction.estimate()});
        visit(ReportRow{quantity("rolling.vertical_power"), between_.power.estimate()});
        visit(ReportRow{quantity("rolling.vertical_power_at_wall"), at_wall_.power.estimate()});
    }
    void merge(const Rolling& other) {
        ReportedAverages::merge(other);
        between_.merge(other.between_);
        at_wall_.merge(other.at_wall_);
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(samples_);
        this->visit_averages(visit);
        visit(between_, at_wall_);
    }

  private:
    /// Friction in all collisions of one kind. The sums are those of the open block.
    struct VerticalFriction {
        double vertical_square = 0.0, square = 0.0, vertical = 0.0, normal = 0.0, loss = 0.0;
        BlockSeries share, friction, power;

        void add(const Impulse& J, double vertical_loss);
        void close_block(double weight);
        void merge(const VerticalFriction& other);
        template <class Visitor>
        void fields(Visitor&& visit) {
            visit(vertical_square, square, vertical, normal, loss, share, friction, power);
        }
    };

    double gap_;
    BlockMean rolls_, rolls_at_wall_, slip_, axes_, contacts_;
    VerticalFriction between_, at_wall_;
    MFrameView view_;
    TouchingPairs touching_;
};

}  // namespace swirl
