// The energy gained and lost in every collision. Only collisions change the kinetic energy in the
// lab frame, K = Σ ½ m v² + ½ I ω². Each changes it by
//   ΔK = W − L
//   W = −J·V              work of the moving wall, J = J_n n + J_t r the impulse on the wall, V its
//                         velocity (it does not turn, so every point of it has this velocity)
//   L = L_n + L_t         loss inside the contact: minus the impulse times the mean of the
//                         contact's relative velocity g before and after, for the normal and for
//                         the tangential part:
//                         L_n = −J_n (g_n + g'_n)/2 = (1 − e²) · ½ m* u²
//                         L_t = −J_t (g_t + g'_t)/2
//
// (the change of ½ m* g² under an impulse J with m* = J/(g' − g)). Velocities after the collision
// are those of the snapshot; those before follow from the impulse and the effective masses of
// physics/collision_law.hpp. So W and L depend on the impulses alone, and Σ (W − L) equals the
// change of K between snapshots up to rounding. The budget closes, and it would not if a collision
// law gained energy.
//
// Spheres (collision_law.hpp): L_t also has the vertical part −J_z (s_z + s'_z)/2, of the planar
// motion, so it includes the energy that lifts one of them. A contact on a floor may return energy
// that was stored by pressing, so L_n may be negative there. Between collisions the floor acts,
// with the velocity u, which is constant on a segment of the path. With P the momentum of all
// spheres, and ΔP and ΔK their changes from event to event without those in the collision,
//
//   W_f = u·ΔP                work of the moving floor
//   L_f = W_f − ΔK            loss by sliding on the floor, Σ μ_f m g ∫|c| dt ≥ 0, and by rolling
//                             resistance, Σ μ_r m g times the distance over the floor
//
// L_f is the difference of the others, so on a floor the budget closes by construction and checks
// nothing. The sign of L_f is a check: it is never negative.
//
// Results: power, energy per unit time, averaged over blocks of periods. Units: disc mass × speed²
// / time. In a steady state, work = losses. Elastic frictionless collisions lose nothing, up to
// rounding. Errors: from blocks of periods. Limits: no time: NaN; needs spins.
#pragma once

#include <tuple>

#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

/// The change of energy in one collision.
struct EnergyChange {
    double work = 0.0;            // work done by the wall
    double friction_loss = 0.0;   // tangential
    double inelastic_loss = 0.0;  // normal
    Vec2 push{0.0, 0.0};          // impulse on all bodies: minus that on the wall
};

EnergyChange energy_change(const Event& event, const Snapshot& after);

/// K of a snapshot, lab frame.
double kinetic_energy(const Snapshot& snapshot);

class EnergyBudget : public ReportedAverages<EnergyBudget, MergedAverages> {
  public:
    static constexpr bool any_path = true;

    static auto rows(auto& s) {
        return std::tuple{AverageRow{quantity("energy.wall_power"), s.work_},
                          AverageRow{quantity("energy.disc_friction_power"), s.disc_friction_},
                          AverageRow{quantity("energy.wall_friction_power"), s.wall_friction_},
                          AverageRow{quantity("energy.inelastic_power"), s.inelastic_},
                          AverageRow{quantity("energy.floor_power"), s.floor_work_},
                          AverageRow{quantity("energy.floor_friction_power"), s.floor_friction_}};
    }

    void sample_event(const Event& event, const Snapshot& after);
    /// `duration`: the time in which the events since the last call happened.
    void close_event_block(double duration);

    /// Since the beginning, including the open block.
    double total_work() const { return total_.work; }
    double total_loss() const { return total_.friction_loss + total_.inelastic_loss; }
    /// The change of K that the collisions account for.
    double accounted() const { return total_work() - total_loss(); }

    /// How far the budget is from closing. Between the first events of any two blocks, the change
    /// of K follows from the snapshots, and also from the collisions. This is the largest
    /// difference of the two, relative to the total work or loss. Rounding makes it some 10⁻¹⁴ in
    /// 10⁵ events.
    double unaccounted_share() const;

    template <class Visitor>
    void report(Visitor&& visit) const {
        ReportedAverages::report(visit);
        visit(number_row(quantity("energy.unaccounted_share"), unaccounted_share()));
    }
    void merge(const EnergyBudget& other);
    template <class Visitor>
    void fields(Visitor&& visit) {
        for (EnergyChange* change : {&disc_, &wall_, &total_}) {
            visit(change->work, change->friction_loss, change->inelastic_loss);
        }
        this->visit_averages(visit);
        visit(floor_.work, floor_.friction_loss, last_.energy, last_.momentum);
        visit(last_.floor_velocity, last_.known, begun_, compared_, at_start_, max_difference_);
    }

  private:
    /// All bodies together, after the last event.
    struct Totals {
        bool known = false;
        double energy = 0.0;
        Vec2 momentum{0.0, 0.0}, floor_velocity{0.0, 0.0};
    };
    void compare(double energy);
    void follow_floor(const EnergyChange& collision, const Snapshot& after);

    EnergyChange disc_, wall_, floor_;  // the open block
    Totals last_;
    EnergyChange total_;
    bool begun_ = false, compared_ = false;  // ever, and in this block
    // K minus what is accounted for, at the start, and its maximum change since.
    double at_start_ = 0.0, max_difference_ = 0.0;
    BlockSeries work_, disc_friction_, wall_friction_, inelastic_, floor_work_, floor_friction_;
};

}  // namespace swirl
