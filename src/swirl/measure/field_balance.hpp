// Checks the balances of mass, momentum and spin at one point of the lab frame: the equations of
// coarse_graining.hpp, with every flight and every collision of an interval of time.
//
//     FieldBalance balance({0.0, 0.0}, {2.0});
//     balance.begin(snapshot);                  the state after an event
//     balance.add(event, after);                for every later event
//     balance.residual();                       up to the last event
//
// The densities at both ends follow from the states of the discs. The terms of the balance follow
// from the velocities and impulses in between. The residual is the difference; it is a rounding
// error.
//
// Flights of spheres on a floor are parabolas. There |x − r|² − w² is a quartic of time. Its roots
// cut the flight, and five Gauss–Legendre nodes integrate W, of degree 8, exactly. A snapshot does
// not contain the force of the floor. It follows from the change of the velocity between two
// events, without the part due to a collision. On a floor, the balance of momentum therefore closes
// by construction, and only the positions check the force.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "swirl/measure/coarse_graining.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

/// Mass, momentum and spin per area, or their changes.
struct FieldDensities {
    double mass = 0.0;
    Vec2 momentum{0.0, 0.0};
    double spin = 0.0;

    friend FieldDensities operator+(const FieldDensities& a, const FieldDensities& b) {
        return {a.mass + b.mass, a.momentum + b.momentum, a.spin + b.spin};
    }
    friend FieldDensities operator-(const FieldDensities& a, const FieldDensities& b) {
        return {a.mass - b.mass, a.momentum - b.momentum, a.spin - b.spin};
    }
};

/// The terms of the balance, summed over time.
struct BalanceTerms {
    FieldDensities transport;    // minus the divergence of the flux of the discs
    Vec2 stress{0.0, 0.0};       // divergence of the collisional stress
    double couple_stress = 0.0;  // divergence of the collisional couple stress
    double torque = 0.0;         // torque of the stress: σ_yx − σ_xy
    Vec2 wall{0.0, 0.0};         // force at the contacts with the wall
    Vec2 floor{0.0, 0.0};        // force of the floor on spheres
    // Scales of the rounding errors: the sum of all transfers of discs, flights and collisions near
    // the point, times W(0). (The terms themselves are no scale: near the edge of the kernel W
    // loses its digits.)
    double scale_of_mass = 0.0, scale_of_momentum = 0.0, scale_of_spin = 0.0;

    FieldDensities total() const {
        return {transport.mass, transport.momentum + stress + wall + floor,
                transport.spin + couple_stress + torque};
    }
};

class FieldBalance {
  public:
    FieldBalance() = default;
    FieldBalance(const Vec2& point, const CoarseKernel& kernel) : point_(point), kernel_(kernel) {}

    /// A new balance with the same point and kernel, which has not begun.
    FieldBalance at_the_same_point() const { return {point_, kernel_}; }
    void begin(const Snapshot& state);
    bool has_begun() const { return begun_; }
    const Vec2& point() const { return point_; }
    /// The state after the event. All discs of the last state are needed, in the same order.
    void add(const Event& event, const Snapshot& after);
    /// Moves all discs to the time of the last event, the end of the interval. After that, begin().
    void finish();
    /// The force of the floor on disc i at a time between the last event and the next; NaN if no
    /// time has passed since, or no event is known.
    Vec2 floor_force(const Snapshot& now, std::size_t i) const;

    /// Densities now and at the beginning. After finish(), now is the time of the last event.
    FieldDensities densities() const;
    const FieldDensities& at_begin() const { return at_begin_; }
    const BalanceTerms& terms() const { return terms_; }
    /// Change of the densities minus all terms.
    FieldDensities residual() const { return densities() - at_begin_ - terms_.total(); }
    /// The residuals divided by the scale of rounding errors; 0 if no disc was ever near.
    std::array<double, 3> relative_residuals() const;

    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(point_, kernel_, at_begin_, terms_, held_, begun_, start_periods_, last_periods_);
        visit(now_, last_clock_);
    }

  private:
    struct Held {
        FieldDisc disc;
        double time;  // time since the start of the period in which the balance began
    };
    void add(const Transfer& t);
    void fly(Held& held, double until);
    void take_time(const Snapshot& s) {
        now_ = time_of(s);
        last_periods_ = s.periods;
        last_clock_ = s.clock;
    }
    void count(const FieldDisc& disc);
    void carry(const Held& held, double from, double weight);
    double time_of(const Snapshot& s) const {
        return static_cast<double>(s.periods - start_periods_) * s.period + s.clock;
    }

    Vec2 point_{0.0, 0.0};
    CoarseKernel kernel_;
    FieldDensities at_begin_;
    BalanceTerms terms_;
    std::vector<Held> held_;
    bool begun_ = false;
    std::int64_t start_periods_ = 0,
                 last_periods_ = 0;        // value at the beginning, at the last event
    double now_ = 0.0, last_clock_ = 0.0;  // time and clock of the last event
};

}  // namespace swirl
