// The torque budget of the cluster: which contacts change its angular momentum. Only collisions do
// so. With s_i = r_i − r_cm, the orbital angular momentum about the centre of mass and the spins
//
//   L = Σ m_i s_i × (v_i − v_cm)          S = Σ I_i ω_i
//
// change in a collision of disc i with the wall, with the impulse J_n n + J_t r on the wall
// (physics/collision_law.hpp, r = (n_y, −n_x)), and in a collision of discs i and j at the distance
// d of their centres, by
//
//   wall     ΔL = −J_n s_i × n            wall_normal
//               − J_t s_i × r             wall_tangential          ΔS =   R_i J_t
//   discs    ΔL = −d J_t                  transfer                 ΔS = (R_i + R_j) J_t
//
// The normal impulse of two discs has no torque. As d = R_i + R_j, friction between discs moves
// angular momentum from the orbital motion to the spins, or back, and changes no sum. In a steady
// state the three torques on L cancel, and so do the two on S.
//
// About the container's centre C, with velocities relative to the container,
//
//   L_C = Σ m_i (r_i − C) × (v_i − V) = L + Q,     Q = M (r_cm − C) × (v_cm − V).
//
// Here the normal impulses of the wall have no torque, and its friction has −J_t (r_i − C) × r.
// Between collisions, Q changes because the container accelerates: at the vertices of its path, or
// all the time on an arc. `container_torque` is this change of Q, from the motion of r_cm and C.
//
// Parts:
//   sticking, sliding   contacts whose friction stops the slip, and the others
//   pinned, loose       discs on a long residence at the wall (long_residence.hpp) at the time of
//                       the collision, and the others; `mixed` is a contact of one with the other.
//                       It is known 0.1 periods late, so these rows omit the last 0.1 periods
//   profile             the three torques on L in slices of the angle θ of the contact about C in
//                       the M-frame
//
// The budget closes: ΔL, ΔS and ΔL_C between the first events of two blocks follow from the
// snapshots, and also from the collisions. `unaccounted_share` is the largest difference of the
// two, relative to the sum of the magnitudes of all torques so far.
//
// Results: torques, angular momentum per time, counter-clockwise. Unit: m v². Errors: from blocks
// of periods. Limits: spheres and coins get torques from the floor, too, so all rows are NaN for
// them; without events NaN.
#pragma once

#include <array>
#include <cstddef>
#include <tuple>
#include <vector>

#include "swirl/measure/cell_averages.hpp"
#include "swirl/measure/long_residence.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

/// The angular momenta of all discs.
struct AngularMomentum {
    double orbital = 0.0;       // L
    double spins = 0.0;         // S
    double about_centre = 0.0;  // L_C
};
AngularMomentum angular_momentum(const Snapshot& snapshot);

/// The changes in one collision; all 0 for other events.
struct AngularImpulse {
    double wall_normal = 0.0, wall_tangential = 0.0, transfer = 0.0;  // torques on L
    double wall_on_spins = 0.0, discs_on_spins = 0.0;                 // torques on S
    double wall_about_centre = 0.0;                                   // torque on L_C
};
AngularImpulse angular_impulse(const Event& event, const Snapshot& after);

class TorqueBudget : public ReportedAverages<TorqueBudget, MergedAverages> {
  public:
    static auto rows(auto& s) {
        const auto row = [&](const Quantity& its_quantity, auto k) {
            return AverageRow{its_quantity, s.series_[k]};
        };
        return std::tuple{row(quantity("torque.wall_normal"), 0),
                          row(quantity("torque.wall_tangential"), 1),
                          row(quantity("torque.transfer"), 2),
                          row(quantity("torque.wall_on_spins"), 3),
                          row(quantity("torque.discs_on_spins"), 4),
                          row(quantity("torque.orbital"), 5),
                          row(quantity("torque.spins"), 6),
                          row(quantity("torque.wall_about_centre"), 7),
                          row(quantity("torque.container_torque"), 8),
                          row(quantity("torque.wall_sticking"), 9),
                          row(quantity("torque.wall_sliding"), 10),
                          row(quantity("torque.transfer_sticking"), 11),
                          row(quantity("torque.transfer_sliding"), 12),
                          row(quantity("torque.wall_normal_pinned"), 13),
                          row(quantity("torque.wall_normal_loose"), 14),
                          row(quantity("torque.wall_tangential_pinned"), 15),
                          row(quantity("torque.wall_tangential_loose"), 16),
                          row(quantity("torque.transfer_pinned"), 17),
                          row(quantity("torque.transfer_mixed"), 18),
                          row(quantity("torque.transfer_loose"), 19)};
    }

    explicit TorqueBudget(std::size_t slices = 36)
        : wall_normal_(slices), wall_tangential_(slices), transfer_(slices) {}

    void sample_event(const Event& event, const Snapshot& after);
    void sample_residences(const LongResidences& residences);
    /// Call this if the next event does not follow directly on the last one.
    void begin_tracks();
    /// `duration`: the time in which the events since the last call happened.
    void close_event_block(double duration);

    double unaccounted_share() const;

    template <class Visitor>
    void report(Visitor&& visit) const {
        ReportedAverages::report(visit);
        visit(number_row(quantity("torque.unaccounted_share"), unaccounted_share()));
        ReportTable table{"profile",
                          "torques about the centre of mass in slices of θ",
                          {{quantity("torque.profile.theta")},
                           {quantity("torque.profile.wall_normal"), with_error_column},
                           {quantity("torque.profile.wall_tangential"), with_error_column},
                           {quantity("torque.profile.transfer"), with_error_column}}};
        const std::size_t slices = wall_normal_.size();
        for (std::size_t k = 0; k < slices; ++k)
            table.add(360.0 * (static_cast<double>(k) + 0.5) / static_cast<double>(slices),
                      wall_normal_.estimate(k), wall_tangential_.estimate(k),
                      transfer_.estimate(k));
        visit(std::move(table));
    }
    void merge(const TorqueBudget& other);
    template <class Visitor>
    void fields(Visitor&& visit) {
        this->visit_averages(visit);
        visit(wall_normal_, wall_tangential_, transfer_, open_, zones_);
        visit(accounted_, magnitude_, at_start_, max_difference_, begun_, compared_);
        visit(orbit_of_cluster_, pending_, known_since_, known_until_, zone_time_);
    }

    /// A collision whose discs are not yet known to be pinned or loose.
    struct Pending {
        double time;
        std::size_t i, j;  // j = i for the wall
        double wall_normal, wall_tangential, transfer;
    };

  private:
    static constexpr std::size_t sums = 13, zone_rows = 7;
    void add(const Event& event, const Snapshot& after);
    void follow_container(const Event& event, const Snapshot& after);
    void compare(const AngularMomentum& now);

    std::array<BlockSeries, sums + zone_rows> series_;
    CellRates wall_normal_, wall_tangential_, transfer_;
    // The open block, in the order of the rows; rows 5 and 6 are sums of others.
    std::array<double, sums> open_{};
    std::array<double, zone_rows> zones_{};

    // Since the beginning, including the open block.
    AngularMomentum accounted_, at_start_, max_difference_;
    double magnitude_ = 0.0;                   // sum of the magnitudes of all changes
    bool begun_ = false, compared_ = false;    // ever, and in this block
    double orbit_of_cluster_ = not_available;  // Q after the last event that changed it

    std::vector<Pending> pending_;  // sorted by time
    // The collisions after `known_since_` up to `known_until_` are counted by zone.
    double known_since_ = not_available, known_until_ = not_available;
    double zone_time_ = 0.0;  // time in the open block
};

}  // namespace swirl
