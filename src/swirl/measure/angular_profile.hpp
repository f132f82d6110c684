// The angular velocity of the discs about the cluster's centre of mass as a function of θ: the
// paper's Fig. 3.
//
//   plain (3a)       ⟨ϖ_M,i⟩ over the discs found in a slice of θ, ϖ_M,i = ϖ_i − Ω, in units of Ω
//   of the wall      ⟨ϖ_wall(θ_i)⟩ over the same discs, in units of Ω. At θ the wall's point
//                    p = R (cos θ, sin θ) passes the centre of mass at the rate
//                    (p − r_cm) × (v_wall − v_cm) / |p − r_cm|², everything in the M-frame,
//                    v_wall = −Ω ẑ × p
//   normalised (3b)  the first divided by the second: 1 where the discs move with the wall
//   distance, speed  of the same discs: their distance from the centre of mass and their speed
//                    relative to it, in the frame that rotates with Ω. Where the cluster is long,
//                    ϖ_M falls though the speed does not (caption of Fig. 3a)
//
// A cluster that moves rigidly with the wall has −1, −1 and 1 in every slice. The paper normalises
// because the centre of mass is not at C, so even the wall passes it at a rate that depends on θ.
//
// Units: Ω. Slices are equal; the first begins at θ = 0 (m_frame.hpp: +x; M is at 3π/2).
// Normalisation: every disc found in a slice counts the same at every sample. Errors: from blocks
// of periods. Limits: a slice never visited: NaN. A disc closer to the centre of mass than its own
// radius is omitted: ϖ_i is a speed divided by that distance. Without the cut-off its variance has
// no bound, and a single disc could determine the mean of a slice.
#pragma once

#include <cstddef>
#include <vector>

#include "swirl/measure/cell_averages.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"

namespace swirl {

class AngularProfile {
  public:
    explicit AngularProfile(std::size_t slices = 72) : cells_(slices) {}

    void sample(const MFrameView& view);
    void close_block() { cells_.close_block(); }

    std::size_t slices() const { return cells_.size(); }
    /// The middle of a slice, in radians.
    double theta(std::size_t slice) const {
        return 2.0 * pi * (static_cast<double>(slice) + 0.5) / static_cast<double>(cells_.size());
    }
    double visits(std::size_t slice) const { return cells_.visits(slice); }
    Estimate plain(std::size_t slice) const { return cells_.estimate(slice, 0); }
    Estimate wall(std::size_t slice) const { return cells_.estimate(slice, 1); }
    Estimate distance(std::size_t slice) const { return cells_.estimate(slice, 2); }
    Estimate speed(std::size_t slice) const { return cells_.estimate(slice, 3); }
    Estimate normalised(std::size_t slice) const {
        const double wall_mean = cells_.mean(slice, 1);
        return scaled(cells_.estimate(slice, 0), 1.0 / wall_mean);
    }

    template <class Visitor>
    void report(Visitor&& visit) const {
        ReportTable table{"",
                          "angular velocity about the centre of mass, in slices of θ",
                          {{quantity("profile.theta")},
                           {quantity("profile.visits")},
                           {quantity("profile.varpi_m"), with_error_column},
                           {quantity("profile.wall")},
                           {quantity("profile.normalised"), with_error_column},
                           {quantity("profile.distance"), with_error_column},
                           {quantity("profile.speed"), with_error_column}}};
        for (std::size_t s = 0; s < slices(); ++s)
            table.add(theta(s) * degrees_per_radian, visits(s), plain(s), wall(s).mean,
                      normalised(s), distance(s), speed(s));
        visit(std::move(table));
    }
    void merge(const AngularProfile& other) { cells_.merge(other.cells_); }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(cells_);
    }

  private:
    CellMeans<4> cells_;
    std::vector<double> own_, wall_, slice_;  // sums of one sample
};

}  // namespace swirl
