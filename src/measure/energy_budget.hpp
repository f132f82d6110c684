// Where the energy comes from and where it goes, collision by collision. Only collisions change the
// kinetic energy K = Σ ½ m v² + ½ I ω² (lab frame), and each does so by
//
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
// physics/collision_law.hpp. So W and L rest on nothing but the impulses, and Σ (W − L) equals the
// change of K that the snapshots show up to rounding: the budget closes, and a law that leaked
// would show.
//
// Results: power, energy per unit time, averaged over blocks of periods. Units: disc mass × speed²
// / time. In a steady state work = losses. Elastic frictionless collisions lose nothing
// (round-off). Limits: no time: NaN; needs spins.
#pragma once

#include "swirl/measure/report.hpp"
#include "swirl/measure/statistics.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

/// What one collision did to the energy.
struct EnergyChange {
    double work = 0.0;            // of the wall
    double friction_loss = 0.0;   // tangential
    double inelastic_loss = 0.0;  // normal
};

EnergyChange energy_change(const Event& event, const Snapshot& after);

/// K of a snapshot, lab frame.
double kinetic_energy(const Snapshot& snapshot);

class EnergyBudget {
  public:
    /// Every event, with the state after it.
    void sample(const Event& event, const Snapshot& after);
    /// `duration`: the time the events since the last call took.
    void close_block(double duration);

    /// Power: of the wall; lost in friction between discs, and at the wall; lost in inelastic
    /// collisions.
    Estimate wall_power() const { return work_.estimate(); }
    Estimate disc_friction_power() const { return disc_friction_.estimate(); }
    Estimate wall_friction_power() const { return wall_friction_.estimate(); }
    Estimate inelastic_power() const { return inelastic_.estimate(); }

    /// Everything since the beginning, open block included.
    double total_work() const { return total_.work; }
    double total_loss() const { return total_.friction_loss + total_.inelastic_loss; }
    /// The change of K that the collisions account for.
    double accounted() const { return total_work() - total_loss(); }

    /// How far the budget is from closing: the largest difference between the change of K that the
    /// snapshots show from the first event of a block to that of another, and the change the
    /// collisions account for, over the energy that went through. Round-off: some 10⁻¹⁴ in 10⁵
    /// events.
    double unaccounted_share() const;

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(ReportRow{"wall_power", "m v³/r", "work of the wall per time", wall_power()});
        visit(ReportRow{"disc_friction_power", "m v³/r", "lost in friction between discs",
                        disc_friction_power()});
        visit(ReportRow{"wall_friction_power", "m v³/r", "lost in friction at the wall",
                        wall_friction_power()});
        visit(ReportRow{"inelastic_power", "m v³/r", "lost in inelastic collisions",
                        inelastic_power()});
        visit(ReportRow{.name = "unaccounted_share",
                        .unit = "1",
                        .description = "of the energy that went through",
                        .estimate = {.mean = unaccounted_share()},
                        .has_error = false});
    }
    void merge(const EnergyBudget& other);
    template <class Visitor>
    void fields(Visitor&& visit) {
        for (EnergyChange* change : {&disc_, &wall_, &total_}) {
            visit(change->work);
            visit(change->friction_loss);
            visit(change->inelastic_loss);
        }
        for (BlockSeries* s : {&work_, &disc_friction_, &wall_friction_, &inelastic_})
            s->fields(visit);
        visit(begun_);
        visit(compared_);
        visit(at_start_);
        visit(worst_);
    }

  private:
    void compare(double energy);

    EnergyChange disc_, wall_;  // the open block
    EnergyChange total_;
    bool begun_ = false, compared_ = false;  // ever, and in this block
    double at_start_ = 0.0, worst_ = 0.0;    // K less what is accounted for, and its largest change
    BlockSeries work_, disc_friction_, wall_friction_, inelastic_;
};

}  // namespace swirl
