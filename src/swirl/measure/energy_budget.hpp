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
// Spheres (collision_law.hpp): L_t has the vertical part −J_z (s_z + s'_z)/2 too, of the planar
// motion, so with the energy that lifts one of them; a contact on a floor may give back what
// pressing has stored, so L_n may be below 0 there. Between collisions the floor acts, with the
// velocity u, which is constant on a leg. With P the momentum of all, and ΔP and ΔK what the
// snapshots show from event to event less what the collisions did,
//
//   W_f = u·ΔP                work of the moving floor
//   L_f = W_f − ΔK            what sliding on it takes, Σ μ_f m g ∫|c| dt ≥ 0, and rolling against
//                             a resistance, Σ μ_r m g times the way over the floor
//
// Here the floor is what is left over, so the budget closes by construction and says nothing of
// that; that L_f is never negative does.
//
// Results: power, energy per unit time, averaged over blocks of periods. Units: disc mass × speed²
// / time. In a steady state work = losses. Elastic frictionless collisions lose nothing
// (round-off). Limits: no time: NaN; needs spins.
#pragma once

#include "swirl/measure/measurement_report.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

/// What one collision did to the energy.
struct EnergyChange {
    double work = 0.0;            // of the wall
    double friction_loss = 0.0;   // tangential
    double inelastic_loss = 0.0;  // normal
    Vec2 push{0.0, 0.0};          // on all bodies together: minus the impulse on the wall
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
    /// Of the floor, and lost in sliding and rolling on it; of spheres on a floor.
    Estimate floor_power() const { return floor_work_.estimate(); }
    Estimate floor_friction_power() const { return floor_friction_.estimate(); }

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
        visit(ReportRow{"floor_power", "m v³/r", "work of the floor on spheres per time",
                        floor_power()});
        visit(ReportRow{"floor_friction_power", "m v³/r",
                        "lost on the floor in sliding and to rolling resistance",
                        floor_friction_power()});
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
        for (BlockSeries* s : {&work_, &disc_friction_, &wall_friction_, &inelastic_, &floor_work_,
                               &floor_friction_})
            visit(*s);
        for (double* sum : {&floor_.work, &floor_.friction_loss, &last_.energy}) visit(*sum);
        visit(last_.momentum);
        visit(last_.floor_velocity);
        visit(last_.known);
        visit(begun_);
        visit(compared_);
        visit(at_start_);
        visit(worst_);
    }

  private:
    /// All bodies together, after the last event.
    struct Bodies {
        bool known = false;
        double energy = 0.0;
        Vec2 momentum{0.0, 0.0}, floor_velocity{0.0, 0.0};
    };
    void compare(double energy);
    void follow_floor(const EnergyChange& collision, const Snapshot& after);

    EnergyChange disc_, wall_, floor_;  // the open block
    Bodies last_;
    EnergyChange total_;
    bool begun_ = false, compared_ = false;  // ever, and in this block
    double at_start_ = 0.0, worst_ = 0.0;    // K less what is accounted for, and its largest change
    BlockSeries work_, disc_friction_, wall_friction_, inelastic_, floor_work_, floor_friction_;
};

}  // namespace swirl
