// How fast the discs turn about the cluster's centre of mass, against where they are: the paper's
// Fig. 3.
//
//   plain (3a)       ⟨ϖ_M,i⟩ over the discs found in a slice of θ, ϖ_M,i = ϖ_i − Ω, in units of Ω
//   of the wall      ⟨ϖ_wall(θ_i)⟩ over the same discs: the wall's point p = R (cos θ, sin θ)
//   passes the
//                    centre of mass at the rate (p − r_cm) × (v_wall − v_cm) / |p − r_cm|²,
//                    everything in the M-frame, v_wall = −Ω ẑ × p; in units of Ω
//   normalised (3b)  the first divided by the second: 1 where the discs move with the wall
//
// A cluster that moves rigidly with the wall has −1, −1 and 1 in every slice. The paper normalises
// because the centre of mass is not at C, so even the wall passes it at a rate that depends on θ.
//
// Units: Ω. Slices are equal, the first begins at θ = 0 (m_frame.hpp: +x; M is at 3π/2).
// Normalisation: every disc found in a slice counts the same at every look. Error from blocks of
// periods. Limits: a slice never visited: NaN. A disc on the centre of mass is left out.
#pragma once

#include <algorithm>

#include "measure/cell_averages.hpp"
#include "measure/m_frame.hpp"

namespace swirl {

class AngularProfile {
  public:
    explicit AngularProfile(std::size_t slices = 72) : cells_(slices) {}

    void look(const MFrameView& view) {
        const double per_omega = 1.0 / view.frame.omega;
        const double slices_per_radian = static_cast<double>(cells_.size()) / (2.0 * pi);
        const double R = view.container_radius;
        for (std::size_t i = 0; i < view.size(); ++i) {
            if (!(view.varpi[i] == view.varpi[i])) continue;
            const double own = view.varpi[i] * per_omega - 1.0;
            // A disc at C has no θ; turns_of puts it at 0, and so does this.
            const Vec2 p = view.position(i);
            const double distance = square_root(dot(p, p));
            const Vec2 at_wall = distance > 0.0 ? (R / distance) * p : Vec2{R, 0.0};
            const Vec2 arm = at_wall - view.centre_of_mass;
            // Relative to the container, v_wall = 0 and so v_wall − v_cm = −u_cm; the turning of
            // the frame takes Ω off, exactly as for ϖ_i.
            const double wall =
                -cross(arm, view.centre_of_mass_velocity) / dot(arm, arm) * per_omega - 1.0;
            const std::size_t slice = std::min(
                static_cast<std::size_t>(view.theta[i] * slices_per_radian), cells_.size() - 1);
            cells_.add(slice, {own, wall});
        }
    }
    void close_block() { cells_.close_block(); }

    std::size_t slices() const { return cells_.size(); }
    /// The middle of a slice, in radians.
    double theta(std::size_t slice) const {
        return 2.0 * pi * (static_cast<double>(slice) + 0.5) / static_cast<double>(cells_.size());
    }
    double visits(std::size_t slice) const { return cells_.visits(slice); }
    Estimate plain(std::size_t slice) const { return cells_.estimate(slice, 0); }
    Estimate wall(std::size_t slice) const { return cells_.estimate(slice, 1); }
    Estimate normalised(std::size_t slice) const {
        const double wall_mean = cells_.mean(slice, 1);
        return scaled(cells_.estimate(slice, 0), 1.0 / wall_mean);
    }

    void merge(const AngularProfile& other) { cells_.merge(other.cells_); }
    template <class Visitor>
    void fields(Visitor&& visit) {
        cells_.fields(visit);
    }

  private:
    CellMeans<2> cells_;
};

}  // namespace swirl
