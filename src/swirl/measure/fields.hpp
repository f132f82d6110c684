// Continuous fields from the exact events, for continuum theories: density, momentum, velocity,
// temperature, spin, vorticity, stress, couple stress and dissipation. Kernel and contributions of
// flights and collisions: coarse_graining.hpp. Definition of each field: field_grid.hpp.
//
//   m_frame_2, m_frame_4   in the M-frame, with kernels of the width 2 and 4 mean radii, at 20 × 20
//                          points of the container's bounding square. Velocities are relative to
//                          the container and rotated, as in the flow map; spins are those of the
//                          lab. In the M-frame itself they are u − Ω ẑ × p and ω − Ω, and the
//                          vorticity is smaller by 2Ω. (Their fluctuations would contain Ω w.)
//   lab_2                  in the lab frame, with the width 2, at 20 × 20 points of the square
//                          about the swirl centre that the container sweeps. The container's motion
//                          counts as fluctuation there: an average over time is one over the phases
//   balances               residuals of the balances of mass, momentum and spin (field_balance.hpp)
//                          at three points of the lab frame in each period, relative to the scale
//                          of rounding errors; the largest is reported
//
// The torque of the stress is σ_yx − σ_xy, twice its antisymmetric part. It drives the spin; see
// docs/results/continuum.md. The dissipation is the loss of kinetic energy in collisions,
// spread along the branch vector as the stress is.
//
// Discs are sampled 73 times per period, collisions are all counted. Units: those of the snapshot.
// Errors: field_grid.hpp. Limits: without events (recordings, tracks) everything that collisions
// contribute is NaN, the pressure included, and so is the force of a floor. Unknown spins (NaN)
// make all fields of spins NaN.
#pragma once

#include <array>
#include <cstdint>

#include "swirl/measure/field_balance.hpp"
#include "swirl/measure/field_grid.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"

namespace swirl {

class Fields {
  public:
    /// Not the first sample of a period: that is at an event, where the floor's force jumps.
    static constexpr int samples_per_use = 7, sample_in_use = 3;
    void use_every_sample() { uses_every_sample_ = true; }

    explicit Fields(double container_radius, std::size_t side = 20)
        : container_radius_(container_radius), side_(side) {}

    void sample_in_lab(const Snapshot& lab);
    void sample_event(const Event& event, const Snapshot& after);
    void close_block();
    void close_event_block(double duration);

    /// In the order of the report: M-frame, narrow and wide; lab.
    const std::array<FieldGrid, 3>& grids() const { return grids_; }

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(number_row(quantity("fields.mass_residual"), residuals_[0]));
        visit(number_row(quantity("fields.momentum_residual"), residuals_[1]));
        visit(number_row(quantity("fields.spin_residual"), residuals_[2]));
        visit(table("m_frame_2", "fields in the M-frame, kernel of 2 mean radii", 0));
        visit(table("m_frame_4", "fields in the M-frame, kernel of 4 mean radii", 1));
        visit(table("lab_2", "fields in the lab frame, kernel of 2 mean radii", 2));
    }
    void merge(const Fields& other);
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(known_, samples_, grids_, balances_, residuals_);
    }
    bool is_consistent() const {
        for (const FieldGrid& grid : grids_)
            if (known_ && grid.grid().side != side_) return false;
        return true;
    }

  private:
    /// The widths and the lab frame's square follow from the first state that is seen.
    void begin(const Snapshot& first);
    ReportTable table(const char* name, const char* description, std::size_t grid) const;

    double container_radius_;
    std::size_t side_;
    bool uses_every_sample_ = false, known_ = false;
    std::int64_t samples_ = 0;
    std::array<FieldGrid, 3> grids_;
    std::array<FieldBalance, 3> balances_;
    std::array<double, 3> residuals_{not_available, not_available, not_available};
};

}  // namespace swirl
